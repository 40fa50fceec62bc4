"""Commands that all parts share, and functions that commands use."""
