"""The PPMC-2104's virtual board with both axes."""
