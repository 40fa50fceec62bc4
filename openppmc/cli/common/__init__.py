"""Commands that all parts share, and what commands are made of."""
