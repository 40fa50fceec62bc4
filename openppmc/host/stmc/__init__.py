"""Driver of the STMC."""
