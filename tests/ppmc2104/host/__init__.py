"""The PPMC-2104's driver."""
