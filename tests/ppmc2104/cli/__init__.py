"""The command line with two axes."""
