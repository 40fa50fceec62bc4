"""What the command line knows about the PPMC-2104."""
