"""Driver of the PMC006B4, alone and with others on a line."""
