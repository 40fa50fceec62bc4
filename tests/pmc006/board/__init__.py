"""The PMC006B4's virtual board."""
