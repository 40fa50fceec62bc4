"""Virtual board of the PMC006B4."""
