"""OpenPPMC in Python: golden models of the parts, prediction of moves, and host software."""

__version__ = "1.0.0"
