"""Acceleration tables of the PPMC-312, free curves, plans of operations."""
