"""Simulations of the blocks in rtl/ppmc312/stages: curves, plans and intervals against the golden model."""
