"""Driver of a bank of PPMC-104 axes."""
