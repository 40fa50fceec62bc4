"""Tests of the command line with two axes."""
