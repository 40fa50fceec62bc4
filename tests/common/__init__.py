"""Tests of what no part owns."""
