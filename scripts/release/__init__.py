"""`make release`: what people can take of a version, in dist/; the same bytes from the same commit (D-83)."""
