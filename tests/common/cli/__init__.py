"""The command line, but for what parts add to it."""
