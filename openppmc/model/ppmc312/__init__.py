"""Golden model of the PPMC-312. `Ppmc312` is the part at pin level.

Its layers are, from the bottom up: stages, front, motion, instructions. `core` connects all blocks.
"""

from .part import Ppmc312

__all__ = ["Ppmc312"]
