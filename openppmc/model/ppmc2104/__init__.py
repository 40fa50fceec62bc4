"""Golden model of the PPMC-2104. `Ppmc2104` is the part at pin level."""

from .part import Ppmc2104

__all__ = ["Ppmc2104"]
