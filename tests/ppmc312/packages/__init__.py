"""Tests of the PPMC-312 C driver, compiled and run."""
