"""Motions of the PPMC-312: operation, pulses, positions, monitors, pins."""
