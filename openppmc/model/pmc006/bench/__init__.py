"""Around a PMC006B4: a motor with its comparators, measured currents."""
