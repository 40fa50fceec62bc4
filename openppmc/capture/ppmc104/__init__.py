"""Captures of a PPMC-104."""
