"""The PPMC-312 in motion: operation, pulses, positions, monitors, pins."""
