"""Tests of the PMC006B4: golden model, host, command line, virtual board."""
