"""The PPMC-104's driver."""
