"""The virtual board with a bank."""
