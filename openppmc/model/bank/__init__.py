"""Golden model of the bank of PPMC-104. `PpmcBank` is the part at pin level."""

from .part import PpmcBank

__all__ = ["PpmcBank"]
