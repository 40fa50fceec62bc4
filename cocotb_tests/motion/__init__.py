"""Simulations of the blocks in rtl/motion: ramp, rate, excitation, guard."""
