"""Captures of a PPMC-312, on its bus and on its line."""
