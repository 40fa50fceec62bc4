"""What is around a PPMC-104: its machine."""
