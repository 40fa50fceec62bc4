"""What is packed for users: sources, cores, wheels."""
