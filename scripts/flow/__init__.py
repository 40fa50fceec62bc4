"""Synthesis, place and route, and the accounting of their results."""
