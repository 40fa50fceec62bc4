"""Virtual boards of the PPMC-312, with the bridge and on a line."""
