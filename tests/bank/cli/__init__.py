"""Tests of the command line with a bank."""
