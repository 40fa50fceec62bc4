"""The STMC's driver."""
