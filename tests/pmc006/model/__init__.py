"""Golden model of the PMC006B4: acceptance checks, blocks, tables."""
