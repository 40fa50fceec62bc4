"""A virtual line of PMC006B4."""
