"""Simulations of the PPMC-104."""
