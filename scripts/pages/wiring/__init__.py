"""Wiring that can be ordered: what stands between the headers of a board and machine or old host."""
