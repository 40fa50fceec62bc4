"""The STMC's virtual board."""
