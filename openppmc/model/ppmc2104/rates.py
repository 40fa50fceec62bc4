"""Rate limits of DATASHEET timing: P2104-DS-30..35."""

from __future__ import annotations

from ..motion.codes import ORIGIN, SINGLE_STEP, Command
from ..motion.motion import Setup
from .codes import Error

# (one axis, both axes) by csel; the smallest rates that are accepted.
_PULSES = {1: (0x0C, 0x19), 0: (0x03, 0x06)}
_PHASES = {1: (0x12, 0x23), 0: (0x04, 0x08)}
_ORIGIN = {1: (0x14, 0x25), 0: (0x05, 0x09)}


def rate_error(command: Command, rate: int, setup: Setup, csel: int, other_operating: bool) -> Error:
    """Error.NONE, RATE_ONE_AXIS or RATE_TWO_AXES for the fastest rate of an operation."""
    if command.operation == SINGLE_STEP or setup.external:
        return Error.NONE
    table = _PULSES if command.pulse_only else _ORIGIN if command.operation == ORIGIN else _PHASES
    alone, together = table[csel]
    if rate < alone:
        return Error.RATE_ONE_AXIS
    return Error.RATE_TWO_AXES if other_operating and rate < together else Error.NONE
