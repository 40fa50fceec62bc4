"""Packages for users: sources, cores, wheels."""
