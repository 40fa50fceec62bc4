"""Tests of the virtual board of the STMC."""
