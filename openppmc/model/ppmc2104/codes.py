"""Instruction codes, status bits and error numbers of the PPMC-2104 (P2104-CMD-01..03, -STA-01, -ERR)."""

from __future__ import annotations

from enum import IntEnum

from ..motion.codes import RAMP_OPERATIONS, Command, Kind, operation_command

ERROR = 0x80
BUSY, CMND = (0x04, 0x08), (0x10, 0x20)

END_STATUS, CONTROL_INPUT, OUTPUT_SIGNAL, REMAINING, ERROR_CODE = 0, 1, 2, 3, 6
SWITCH_MIN = 0x40


class Error(IntEnum):
    """Contents of an error register."""

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
    """Error code read, the one register read that is allowed in every state."""
    return command.kind is Kind.READ and command.code & 7 == ERROR_CODE


def _register(code: int, axis: int) -> Command:
    """Group 10: reads, switching times, hold delay."""
    if code & 0x18 or code & 7 == 7:
        return Command(Kind.UNDEFINED, code, axis=axis)
    if code & 7 == 4:
        return Command(Kind.SWITCHING, code, 2, axis=axis)
    if code & 7 == 5:
        return Command(Kind.HOLD_DELAY, code, 1, axis=axis)
    return Command(Kind.READ, code, axis=axis)


def _expansion(code: int, axis: int) -> Command:
    """Group 11: pulse-only moves, excitation off, auxiliary pins."""
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
