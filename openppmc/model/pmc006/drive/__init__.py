"""Drive of the PMC006B4: angle, current references, chopper, bridges."""
