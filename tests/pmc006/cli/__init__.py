"""The PMC006B4's commands."""
