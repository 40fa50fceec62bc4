"""Mutants by hand: small faults of the RTL, and the directed tests that find them."""
