"""Commands of the PPMC-312 with the bridge."""
