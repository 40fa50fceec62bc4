"""Driver of the PPMC-104."""
