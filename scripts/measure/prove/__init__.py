"""`make prove`: properties of the shared blocks, proved with yosys and its ABC (docs/proofs.md)."""
