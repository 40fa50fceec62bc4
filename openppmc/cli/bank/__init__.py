"""The command line with a bank."""
