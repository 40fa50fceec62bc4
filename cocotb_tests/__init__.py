"""Simulations: one folder a part, and the shared harness in `common`."""
