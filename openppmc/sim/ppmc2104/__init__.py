"""What is around a PPMC-2104: its machine."""
