"""Golden model of the PPMC-104. `Ppmc104` is the part at pin level."""

from .part import Ppmc104

__all__ = ["Ppmc104"]
