"""Commands that all parts share, and the functions that commands use."""
