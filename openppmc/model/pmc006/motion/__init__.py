"""Motions of the PMC006B4: plans, speed per update, position, guard."""
