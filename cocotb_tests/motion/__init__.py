"""Simulations of the blocks in rtl/motion: ramp, rate, excitation, stop monitor."""
