"""Surroundings of a PPMC-312: machine model, virtual line of stations."""
