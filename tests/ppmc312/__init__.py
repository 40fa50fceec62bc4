"""Tests of the PPMC-312: golden model, host on both fronts, command line, virtual boards."""
