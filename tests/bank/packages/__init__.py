"""Tests of the C driver of the bank."""
