"""Command codes, status bits, error numbers of the PPMC-104 (P104-CMD-01..03, P104-ERR-00, P104-STA-01)."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, IntEnum

OBF, IBF, BUSY, ERR = 0x01, 0x02, 0x04, 0x80

SINGLE_STEP, ACC_DEC, CONSTANT = 0b010, 0b011, 0b100
CONTINUOUS, HIGH_SPEED, ORIGIN = 0b101, 0b110, 0b111
RAMP_OPERATIONS = (ACC_DEC, HIGH_SPEED)
ENDLESS = 1 << 24

PA_MIN, PA_MAX = 4, 11220

FINISH_NEW, FINISH_STOP, FINISH_ALARM, FINISH_LIMIT, FINISH_SLOW = 0x80, 0x40, 0x20, 0x10, 0x08


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


class Kind(Enum):
    """What a command code asks for."""

    UNDEFINED = "undefined"
    INITIALISE = "initialisation"
    STOP = "immediate stop"
    SLOW_STOP = "decelerating stop"
    OPERATION = "operation"
    READ = "register read"
    SWITCHING = "switching parameters"
    AUX_OUTPUT = "auxiliary output"
    EXCITATION_OFF = "excitation off"
    AUX_ON = "AUX on"
    AUX_OFF = "AUX off"


@dataclass(frozen=True)
class Command:
    """A decoded command byte. `parameters`: data bytes to follow. The rest belongs to operations."""

    kind: Kind
    code: int
    parameters: int = 0
    operation: int = 0
    pulse_only: bool = False
    masked: bool = False
    direction: int = 0


_OPERATION_BYTES = {SINGLE_STEP: 0, ACC_DEC: 3, CONSTANT: 4, CONTINUOUS: 1, HIGH_SPEED: 0, ORIGIN: 1}
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
    operation = Command(
        Kind.OPERATION,
        code,
        _OPERATION_BYTES.get(low, 0),
        operation=low,
        pulse_only=group == 3,
        masked=bool(code & 0x10),
        direction=code >> 3 & 1,
    )
    if group == 1:
        if low < 2:
            return Command(Kind.SLOW_STOP if low else Kind.STOP, code)
        return operation
    if low in _EXPANSION:
        return Command(_EXPANSION[low], code)
    return operation if low in RAMP_OPERATIONS else Command(Kind.UNDEFINED, code)


def _decode_register(code: int) -> Command:
    if code > 0x86:
        return Command(Kind.UNDEFINED, code)
    if code == 0x84:
        return Command(Kind.SWITCHING, code, 2)
    if code == 0x86:
        return Command(Kind.AUX_OUTPUT, code, 1)
    return Command(Kind.READ, code)
