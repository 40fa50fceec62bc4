"""Verification of the PMC006B4."""
