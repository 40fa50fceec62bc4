"""Commands of the PMC006B4."""
