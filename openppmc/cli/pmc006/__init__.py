"""Commands for the PMC006B4."""
