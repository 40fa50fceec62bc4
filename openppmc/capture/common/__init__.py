"""What captures of all parts have in common."""
