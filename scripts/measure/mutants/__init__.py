"""Hand-made mutants: small faults of the RTL, and the directed tests that find them."""
