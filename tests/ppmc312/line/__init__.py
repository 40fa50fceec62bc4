"""Tests of the PPMC-312 in serial mode: driver, command line, frames, faults of the line."""
