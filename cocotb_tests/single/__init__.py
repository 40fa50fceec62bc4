"""Simulations of rtl/single, the blocks of the parts with one axis."""
