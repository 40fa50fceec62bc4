"""The host side of `make demo`."""
