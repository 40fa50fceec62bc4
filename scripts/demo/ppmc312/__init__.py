"""Demos of the PPMC-312: blocks on its bus, frames on its serial line."""
