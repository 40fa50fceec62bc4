"""PPMC-312 in serial mode: up to sixteen stations on a line."""
