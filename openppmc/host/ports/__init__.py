"""Ports: a serial device, the virtual board (`sim:`), the model (`model:`)."""
