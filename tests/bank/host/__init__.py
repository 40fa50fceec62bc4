"""The bank's driver."""
