"""Tests of the PPMC-2104: golden model, host, command line, virtual board."""
