"""Shared code of the captures of all parts."""
