"""Instruction kinds, operation numbers and end-status bits of the PPMC family."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple

# Registers, written by `make packages` from packages/registers/mailbox.rdl.
DATA = 0x0  # read: byte of a response; write: data byte
STATUS = 0x1  # result of the last byte, state of part and buffers
COMMAND = 0x1  # command byte
ERR = 0x80  # the most recent byte, command or data, was faulty
NUM = 0x70  # ERR = 0: number of parameter bytes still expected, 0 to 4; ERR = 1: error number
BUSY = 0x04  # an operation is running (not during initialisation)
IBF = 0x02  # the input buffer is full: do not write
OBF = 0x01  # the data register holds an unread byte
# End of the registers.

SINGLE_STEP, ACC_DEC, CONSTANT = 0b010, 0b011, 0b100
CONTINUOUS, HIGH_SPEED, ORIGIN = 0b101, 0b110, 0b111
RAMP_OPERATIONS = (ACC_DEC, HIGH_SPEED)
OPERATION_BYTES = {SINGLE_STEP: 0, ACC_DEC: 3, CONSTANT: 4, CONTINUOUS: 1, HIGH_SPEED: 0, ORIGIN: 1}
ENDLESS = 1 << 24

PA_MIN, PA_MAX = 4, 11220

FINISH_NEW, FINISH_STOP, FINISH_ALARM, FINISH_LIMIT, FINISH_SLOW = 0x80, 0x40, 0x20, 0x10, 0x08


class Kind(Enum):
    """Kind of a command code."""

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
    """Decoded command byte.

    Attributes:
        parameters: number of data bytes that follow.
        operation, pulse_only, masked, direction: fields of an operation code; other codes do not use them.
        axis: number of the axis, counted from 0; 0 on a part with one axis.
    """

    kind: Kind
    code: int
    parameters: int = 0
    operation: int = 0
    pulse_only: bool = False
    masked: bool = False
    direction: int = 0
    axis: int = 0


def operation_command(code: int, axis: int = 0) -> Command:
    """Return the command of an operation code.

    Bit 7 selects pulses without phases, bit 4 masks the end interrupt, and bit 3 is the direction.
    """
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


# Causes that end or decelerate each operation: P104-LIM-02..06, P2104-LIM-02..07 and their tables.


class GuardPins(NamedTuple):
    """Pin names of the active-low switches; a pair contains the switches for CW and CCW."""

    limits: tuple[str, str]
    slow_limits: tuple[str, str]
    alarm: str
    origin: str

    @property
    def all(self) -> tuple[str, ...]:
        """All six pin names."""
        return (*self.limits, *self.slow_limits, self.alarm, self.origin)


class ActiveCauses(NamedTuple):
    """Causes that are active at an edge.

    Attributes:
        bits: end-status bits of the limits and of the alarm that are active.
        origin: True if the origin is active; only origin searches use this cause.
        slow: True if a slow-down limit is active.
    """

    bits: int = 0
    origin: bool = False
    slow: bool = False

    @property
    def ends(self) -> bool:
        """True if a cause ends the motion immediately."""
        return bool(self.bits) or self.origin


def inspect(pins: GuardPins, levels: Mapping[str, int], operation: int, direction: int) -> ActiveCauses:
    """Return the causes that the synchronised levels indicate for an operation and its direction.

    Args:
        operation: lowest three bits of the code.
    """
    bits = 0
    if not levels[pins.limits[direction]]:
        bits |= FINISH_LIMIT
    if not levels[pins.alarm]:
        bits |= FINISH_ALARM
    origin = operation == ORIGIN and not levels[pins.origin]
    return ActiveCauses(bits, origin, not levels[pins.slow_limits[direction]])


def input_register(levels: Mapping[str, int], bits: Mapping[int, str]) -> int:
    """Return the byte with which a read of the control inputs is answered.

    `bits` maps each bit number to its pin.
    """
    return sum(levels[pin] << bit for bit, pin in bits.items())
