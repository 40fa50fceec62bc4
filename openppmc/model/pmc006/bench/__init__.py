"""Surroundings of a PMC006B4: a motor with its comparators, and measured currents."""
