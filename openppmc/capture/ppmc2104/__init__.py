"""Captures of a PPMC-2104."""
