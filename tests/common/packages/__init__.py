"""Tests of the packages for users: sources, cores, wheels."""
