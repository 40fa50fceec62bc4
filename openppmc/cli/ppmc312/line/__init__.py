"""Commands for a line of PPMC-312."""
