"""Golden model of the PMC006B4. `Pmc006` is the part at pin level.

Its layers are, from the bottom up: line, motion, memory, drive, instructions. `bench` contains a model of the
motor, and `program` converts user programs to text and back.
"""

from .part import Pmc006

__all__ = ["Pmc006"]
