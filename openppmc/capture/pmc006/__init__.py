"""Captures of a line with PMC006B4."""
