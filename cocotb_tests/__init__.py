"""Simulations of the RTL: a folder a part, a room for the blocks and boards that parts share, the harness."""
