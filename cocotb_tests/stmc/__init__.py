"""Tests of the STMC core and of its board, run in the simulator and under pytest."""
