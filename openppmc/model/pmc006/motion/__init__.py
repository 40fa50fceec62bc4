"""Motions of the PMC006B4: plans, speed update by update, position, guard."""
