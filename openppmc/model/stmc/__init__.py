"""Golden models of the STMC (`Stmc`, pin level) and of the J105 board around it (`J105Stmc`)."""

from .part import Stmc
from .pc104_board import J105Stmc

__all__ = ["J105Stmc", "Stmc"]
