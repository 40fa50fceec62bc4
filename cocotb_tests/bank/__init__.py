"""Simulations of the bank and of the blocks around it."""
