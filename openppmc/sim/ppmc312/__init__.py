"""A virtual line of PPMC-312."""
