"""Tests of the virtual board of the PPMC-2104 with both axes."""
