"""Pictures and tables of the manual of the PMC006B4."""
