"""Tests of the C driver of the STMC, compiled and run."""
