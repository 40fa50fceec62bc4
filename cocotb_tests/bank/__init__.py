"""Simulations of the bank and of what is around it."""
