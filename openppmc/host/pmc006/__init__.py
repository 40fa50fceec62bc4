"""Driver of the PMC006B4, for one controller or several on a line."""
