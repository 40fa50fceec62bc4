"""Instruction codes, status bits and error numbers of the PPMC-2104.

Rules: P2104-CMD-01..03, -STA-01, -ERR.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum, IntEnum

from ..chip import Context, Phase
from ..motion.codes import ORIGIN, RAMP_OPERATIONS, SINGLE_STEP, Command, GuardPins, Kind, operation_command
from ..motion.motion import Setup

# Registers, written by `make packages` from packages/registers/ppmc2104.rdl.
DATA = 0x0  # read: byte of a response; write: data byte
STATUS = 0x1  # state of axes and buffers
COMMAND = 0x1  # command byte
ERROR = 0x80  # an error register is not 0, of axis 1 or axis 2
CMND2 = 0x20  # as CMND1, for axis 2
# an instruction for axis 1 is incomplete (data bytes awaited), or its ramp table is queued or being computed;
# in DATASHEET also while the instruction is processed
CMND1 = 0x10
BUSY2 = 0x08  # an operation of axis 2 is running or waits for RUN
BUSY1 = 0x04  # an operation of axis 1 is running or waits for RUN
IBF = 0x02  # the input buffer is full: do not write
OBF = 0x01  # the data register holds an unread byte
# End of the registers.
BUSY, CMND = (BUSY1, BUSY2), (CMND1, CMND2)

END_STATUS, CONTROL_INPUT, OUTPUT_SIGNAL, REMAINING, ERROR_CODE = 0, 1, 2, 3, 6
SWITCH_MIN = 0x40


class Error(IntEnum):
    """Content of an error register."""

    NONE = 0
    UNDEFINED = 1
    UNASKED_DATA = 2
    DATA_OUTSTANDING = 3
    NOT_INITIALISED = 4
    NOT_WHILE_BUSY = 5
    NOTHING_TO_STOP = 6
    START_REFUSED = 7
    CANNOT_DECELERATE = 8
    BAD_RATE = 9
    PA_TOO_LARGE = 10
    BAD_SWITCHING = 11
    RATE_ONE_AXIS = 12
    RATE_TWO_AXES = 13


STOPS = (Kind.STOP, Kind.SLOW_STOP)
NEEDS_TABLE = (Kind.INITIALISE, Kind.OPERATION, Kind.EXCITATION_OFF)


def is_error_read(command: Command) -> bool:
    """Return True for the read of the error code. It is the only register read that every state accepts."""
    return command.kind is Kind.READ and command.code & 7 == ERROR_CODE


def _register(code: int, axis: int) -> Command:
    """Decode a code of group 10: reads, chopper times, hold delay."""
    if code & 0x18 or code & 7 == 7:
        return Command(Kind.UNDEFINED, code, axis=axis)
    if code & 7 == 4:
        return Command(Kind.SWITCHING, code, 2, axis=axis)
    if code & 7 == 5:
        return Command(Kind.HOLD_DELAY, code, 1, axis=axis)
    return Command(Kind.READ, code, axis=axis)


def _expansion(code: int, axis: int) -> Command:
    """Decode a code of group 11: pulse-only moves, excitation off, auxiliary pins."""
    if code & 7 in RAMP_OPERATIONS:
        return operation_command(code, axis)
    if code in (0xC0, 0xE0):
        return Command(Kind.EXCITATION_OFF, code, axis=axis)
    if code in (0xC1, 0xD1, 0xE1, 0xF1):
        return Command(Kind.AUX_OUTPUT, code)
    if code == 0xC2:
        return Command(Kind.AUX_INPUT, code)
    return Command(Kind.UNDEFINED, code, axis=axis)


def decode(code: int) -> Command:
    """Decode one of the 256 instruction codes. Raises ValueError outside 0..255."""
    if not 0 <= code <= 255:
        raise ValueError(f"instruction code {code}")
    axis = code >> 5 & 1
    group = code >> 6
    if group == 0:
        kind = Kind.INITIALISE if code & 3 else Kind.UNDEFINED
        return Command(kind, code, 4 if code & 3 else 0, axis=axis)
    if group == 2:
        return _register(code, axis)
    if group == 3:
        return _expansion(code, axis)
    if code & 7 < 2:
        return Command(STOPS[code & 1], code, axis=axis)
    return operation_command(code, axis)


# Rate limits with DATASHEET timing: P2104-DS-30..35.

# Smallest accepted rates by csel: if only one axis operates, and if both axes operate.
_PULSES = {1: (0x0C, 0x19), 0: (0x03, 0x06)}
_PHASES = {1: (0x12, 0x23), 0: (0x04, 0x08)}
_ORIGIN = {1: (0x14, 0x25), 0: (0x05, 0x09)}


def rate_error(command: Command, rate: int, setup: Setup, csel: int, other_operating: bool) -> Error:
    """Return the error for the fastest rate of an operation: NONE, RATE_ONE_AXIS or RATE_TWO_AXES."""
    if command.operation == SINGLE_STEP or setup.external:
        return Error.NONE
    table = _PULSES if command.pulse_only else _ORIGIN if command.operation == ORIGIN else _PHASES
    alone, together = table[csel]
    if rate < alone:
        return Error.RATE_ONE_AXIS
    return Error.RATE_TWO_AXES if other_operating and rate < together else Error.NONE


# Pins of the PPMC-2104 with idle and reset levels (P2104-PORT-01), and their assignment to the axes. A port
# of both axes is one number, bit 0 = axis 1. `clk_o` is not modelled, because it never stops and depends on
# no state.

AXES = (0, 1)
INPUTS: dict[str, int] = {
    "rst_n": 1,
    "cs_n": 1,
    "a0": 0,
    "busc": 0,
    "ds_wrs_n": 1,
    "rw_rds_n": 1,
    "d_i": 0,
    "errint_n": 1,
    "run": 0b11,
    "extck": 0,
    "csel": 0b11,
    "fl_n": 0b11,
    "bl_n": 0b11,
    "fhl_n": 0b11,
    "bhl_n": 0b11,
    "org_n": 0b11,
    "alm_n": 0b11,
    "auxi": 0,
}
OUTPUTS: dict[str, int] = {
    "d_o": 0,
    "d_oe": 0,
    "int_n": 1,
    "pout_n": 0b11,
    "dir": 0,
    "hold": 0b11,
    "s1_n": 0b11111,
    "s2_n": 0b11111,
    "auxo": 0b11,
}
HOST_PINS = ("a0", "cs_n", "busc", "ds_wrs_n", "rw_rds_n", "d_i")
GUARD = GuardPins(limits=("fl_n", "bl_n"), slow_limits=("fhl_n", "bhl_n"), alarm="alm_n", origin="org_n")
AXIS_INPUTS = ("run", "extck", "csel", *GUARD.all)
AXIS_OUTPUTS = ("pout_n", "dir", "hold")
WIDTHS: dict[str, int] = {
    **{"d_i": 8, "auxi": 2, "d_o": 8, "s1_n": 5, "s2_n": 5, "auxo": 2},
    **dict.fromkeys((*AXIS_INPUTS, *AXIS_OUTPUTS), 2),
}
# Bits of the control input read (P2104-RD-04).
CONTROL_INPUT_BITS = {7: "org_n", 6: "alm_n", 3: "fl_n", 2: "fhl_n", 1: "bl_n", 0: "bhl_n"}
MOTOR_AT_REST = {"s": 0b11111, "pout_n": 1, "hold": 1, "dir": 0}


def axis_levels(levels: Mapping[str, int], axis: int) -> dict[str, int]:
    """Return the levels of the inputs of one axis (0 or 1)."""
    return {pin: levels[pin] >> axis & 1 for pin in AXIS_INPUTS}


def strobes(pins: Mapping[str, int]) -> tuple[bool, bool]:
    """Return (write strobe, read strobe) in the bus style that busc selects (P2104-BUS-01, -02)."""
    if pins["cs_n"]:
        return False, False
    first, second = not pins["ds_wrs_n"], bool(pins["rw_rds_n"])
    if pins["busc"]:
        return first and not second, first and second
    return first and second, not first and not second


# INT* of the PPMC-2104: four cause latches and the release window (P2104-INT-01..05).


class Cause(Enum):
    """Kinds of interrupt causes; each axis has one latch of each kind."""

    END = "end"
    ERROR = "error"


class Interrupt:
    """The interrupt latches. After edge t, the register of the pin int_n is loaded with `level(t)`."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._set: set[tuple[Cause, int]] = set()
        self._quiet_until = -1

    def raise_(self, cause: Cause, axis: int) -> None:
        """Set a latch."""
        self._set.add((cause, axis))

    def release(self, t: int, cause: Cause, axis: int) -> None:
        """Clear a latch when it is read at edge t.

        If the latch was set, INT* is high for the time W from edge t on, even if other latches are set
        (P2104-INT-03, -04).
        """
        if (cause, axis) not in self._set:
            return
        self._set.remove((cause, axis))
        self._quiet_until = t + self._context.timebase.w
        # This event makes the model update the pins at the end of W.
        self._context.queue.at(self._quiet_until, Phase.END, lambda now: None)

    def level(self, t: int) -> int:
        """Return the level of int_n for the state of the latches after edge t."""
        return 0 if self._set and t >= self._quiet_until else 1

    @property
    def pending(self) -> frozenset[tuple[Cause, int]]:
        """Latches that are set."""
        return frozenset(self._set)
