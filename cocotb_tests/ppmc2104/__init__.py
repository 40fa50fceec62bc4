"""Simulations of the PPMC-2104AFP."""
