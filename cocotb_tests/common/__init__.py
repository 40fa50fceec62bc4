"""Simulations of the blocks in rtl/common: synchronisers, memories, time bases, I2C."""
