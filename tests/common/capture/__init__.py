"""Captures of the original chips: files as logic analysers write them, decoded and compared."""
