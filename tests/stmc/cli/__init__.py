"""The STMC's commands."""
