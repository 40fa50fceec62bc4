"""Tests of the C driver of the PPMC-2104, compiled and run."""
