"""Instruction kinds, operation numbers and end-status bits that the parts of the family share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

OBF, IBF = 0x01, 0x02

SINGLE_STEP, ACC_DEC, CONSTANT = 0b010, 0b011, 0b100
CONTINUOUS, HIGH_SPEED, ORIGIN = 0b101, 0b110, 0b111
RAMP_OPERATIONS = (ACC_DEC, HIGH_SPEED)
OPERATION_BYTES = {SINGLE_STEP: 0, ACC_DEC: 3, CONSTANT: 4, CONTINUOUS: 1, HIGH_SPEED: 0, ORIGIN: 1}
ENDLESS = 1 << 24

PA_MIN, PA_MAX = 4, 11220

FINISH_NEW, FINISH_STOP, FINISH_ALARM, FINISH_LIMIT, FINISH_SLOW = 0x80, 0x40, 0x20, 0x10, 0x08


class Kind(Enum):
    """What a command code asks for."""

    UNDEFINED = "undefined"
    INITIALISE = "initialisation"
    STOP = "immediate stop"
    SLOW_STOP = "decelerating stop"
    OPERATION = "operation"
    READ = "register read"
    SWITCHING = "switching parameters"
    HOLD_DELAY = "hold delay"
    AUX_OUTPUT = "auxiliary output"
    AUX_INPUT = "auxiliary input"
    EXCITATION_OFF = "excitation off"
    AUX_ON = "AUX on"
    AUX_OFF = "AUX off"


@dataclass(frozen=True)
class Command:
    """A decoded command byte. `parameters`: data bytes to follow. operation, pulse_only, masked and
    direction belong to operations; `axis` counts from 0 and stays 0 on a single-axis part."""

    kind: Kind
    code: int
    parameters: int = 0
    operation: int = 0
    pulse_only: bool = False
    masked: bool = False
    direction: int = 0
    axis: int = 0


def operation_command(code: int, axis: int = 0) -> Command:
    """An operation: bit 4 masks the end interrupt, bit 3 is the direction, bit 7 pulses only."""
    low = code & 7
    return Command(
        Kind.OPERATION,
        code,
        OPERATION_BYTES[low],
        operation=low,
        pulse_only=bool(code & 0x80),
        masked=bool(code & 0x10),
        direction=code >> 3 & 1,
        axis=axis,
    )


# What ends or slows which operation: P104-LIM-02..06, P2104-LIM-02..07 and their tables.


class GuardPins(NamedTuple):
    """Names of the active-low switches; pairs are (CW, CCW)."""

    limits: tuple[str, str]
    slow_limits: tuple[str, str]
    alarm: str
    origin: str

    @property
    def all(self) -> tuple[str, ...]:
        """All six names."""
        return (*self.limits, *self.slow_limits, self.alarm, self.origin)


class Seen(NamedTuple):
    """Causes active on an edge: `bits` are end-status bits of limit and alarm, `origin` counts for origin
    searches only, `slow` is the slow-down limit."""

    bits: int = 0
    origin: bool = False
    slow: bool = False

    @property
    def ends(self) -> bool:
        """Whether the motion ends now."""
        return bool(self.bits) or self.origin


def inspect(pins: GuardPins, levels: Mapping[str, int], operation: int, direction: int) -> Seen:
    """Judge the synchronised levels for an operation (low three code bits) and its direction."""
    bits = 0
    if not levels[pins.limits[direction]]:
        bits |= FINISH_LIMIT
    if not levels[pins.alarm]:
        bits |= FINISH_ALARM
    origin = operation == ORIGIN and not levels[pins.origin]
    return Seen(bits, origin, not levels[pins.slow_limits[direction]])


def input_register(levels: Mapping[str, int], bits: Mapping[int, str]) -> int:
    """Byte of the control input read: pin levels by bit number."""
    return sum(levels[pin] << bit for bit, pin in bits.items())
