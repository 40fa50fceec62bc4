"""Golden model of the PMC006B4. `Pmc006` is the part at pin level.

Rooms, from the ground up: front, motion, memory, drive, instructions; `bench` has the motor around it and
`program` the text form of its user programs.
"""

from .part import Pmc006

__all__ = ["Pmc006"]
