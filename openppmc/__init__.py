"""OpenPPMC in Python: golden models of the parts, a move predictor and the host software."""

__version__ = "1.0.0"
