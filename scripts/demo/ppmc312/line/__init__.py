"""The demo of the PPMC-312 with sixteen stations on a serial line."""
