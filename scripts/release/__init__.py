"""`make release`: all files of a version, in dist/; the same commit gives the same bytes (D-83)."""
