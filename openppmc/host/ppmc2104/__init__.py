"""Driver of the PPMC-2104."""
