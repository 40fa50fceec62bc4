"""Tests of the PMC006B4 C driver, compiled and run."""
