"""Simulations of the blocks in rtl/ppmc312/stages, compared with the golden model."""
