"""Captures of a J105 STMC."""
