"""Golden model of the PPMC-312. `Ppmc312` is the part at pin level.

Rooms, from the ground up: stages, front, motion, instructions; `core` has all blocks together.
"""

from .part import Ppmc312

__all__ = ["Ppmc312"]
