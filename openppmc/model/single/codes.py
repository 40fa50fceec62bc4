"""Command codes, status bits and error numbers of the PPMC-104.

Rules: P104-CMD-01..03, P104-ERR-00, P104-STA-01.
"""

from __future__ import annotations

from enum import IntEnum

from ..motion.codes import BUSY, ERR, IBF, OBF, RAMP_OPERATIONS, Command, Kind, operation_command

__all__ = ["BUSY", "ERR", "IBF", "OBF", "Command", "Error", "Kind", "decode"]


class Error(IntEnum):
    """Error numbers of P104-ERR-00."""

    UNDEFINED = 0
    NOT_WHILE_BUSY = 1
    NOT_INITIALISED = 2
    UNASKED_DATA = 3
    PA_TOO_LARGE = 4
    BAD_RAMP = 5
    UNASKED_DATA_BUSY = 6
    ALREADY_DECELERATING = 7


_EXPANSION = {0: Kind.EXCITATION_OFF, 1: Kind.AUX_ON, 2: Kind.AUX_OFF}


def decode(code: int) -> Command:
    """Decode one of the 256 command bytes. Raises ValueError outside 0..255."""
    if not 0 <= code <= 255:
        raise ValueError(f"command byte {code}")
    group, low = code >> 6, code & 7
    if group == 0:
        return Command(Kind.INITIALISE, code, 4) if code & 3 else Command(Kind.UNDEFINED, code)
    if group == 2:
        return _decode_register(code)
    if group == 1:
        if low < 2:
            return Command(Kind.SLOW_STOP if low else Kind.STOP, code)
        return operation_command(code)
    if low in _EXPANSION:
        return Command(_EXPANSION[low], code)
    return operation_command(code) if low in RAMP_OPERATIONS else Command(Kind.UNDEFINED, code)


def _decode_register(code: int) -> Command:
    if code > 0x86:
        return Command(Kind.UNDEFINED, code)
    if code == 0x84:
        return Command(Kind.SWITCHING, code, 2)
    if code == 0x86:
        return Command(Kind.AUX_OUTPUT, code, 1)
    return Command(Kind.READ, code)
