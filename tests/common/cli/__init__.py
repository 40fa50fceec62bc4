"""The command line, except commands of single devices."""
