"""Simulations of what the parts with one axis share, rtl/single."""
