"""Captures of old chips: files as analysers write them, decoded and compared."""
