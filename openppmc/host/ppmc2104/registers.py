"""Capabilities, errors, status register, and chopper and hold times of a PPMC-2104. Pure.

Rules: P2104-ERR-01, P2104-STA-01.

The error numbers of the PPMC-2104 differ from those of the other parts. Times in microseconds are converted
exactly to parameter bytes and back.
"""

# ruff: noqa: N818

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from ...lazy import renamed
from ...model.ppmc2104.codes import BUSY, CMND, ERROR, IBF, OBF, Error
from ...parts import part
from ..capabilities import COILS_OFF, PULSE_ONLY, RateCapabilities
from ..errors import (
    AlreadyDecelerating,
    AxisBusy,
    CommandRefused,
    InvalidRamp,
    NothingToStop,
    NotInitialised,
    OutOfRange,
    RampTooLong,
    StartRefused,
    UnexpectedData,
    UnknownCommand,
)
from ..speeds import Number, exact, nearby


class IncompleteCommand(CommandRefused):
    """Error 3 of the PPMC-2104: a command arrived while the part was waiting for the data of another one."""

    text = (
        "the part was still waiting for the data of another command, and both are dropped: another program "
        "may be using it; send the command again"
    )


class InvalidChopperTimes(CommandRefused):
    """Error 11 of the PPMC-2104: invalid chopper times."""

    text = "the part rejects these chopper times: 32 us or more each at a 16 MHz crystal"


class RateLimitExceeded(CommandRefused):
    """Errors 12 and 13 of the PPMC-2104 with DATASHEET timing: the speed is too high."""

    text = (
        "the part rejects this speed: with DATASHEET timing it is too high for one axis, choose a lower one"
    )


BY_NUMBER: dict[int, tuple[type[CommandRefused], str]] = {
    Error.UNDEFINED: (UnknownCommand, ""),
    Error.UNASKED_DATA: (UnexpectedData, ""),
    Error.DATA_OUTSTANDING: (IncompleteCommand, ""),
    Error.NOT_INITIALISED: (
        NotInitialised,
        "it is not initialised (power-up, reset or excitation off): initialise it first",
    ),
    Error.NOT_WHILE_BUSY: (
        AxisBusy,
        "it is busy with a motion: wait for its end or stop it first",
    ),
    Error.NOTHING_TO_STOP: (NothingToStop, "nothing to stop: it is at standstill"),
    Error.START_REFUSED: (StartRefused, ""),
    Error.CANNOT_DECELERATE: (
        AlreadyDecelerating,
        "the motor is already decelerating, runs at constant speed or waits for RUN: wait for its end, or "
        "stop it immediately",
    ),
    Error.BAD_RATE: (
        InvalidRamp,
        "the part rejects this ramp or speed: use 4 pulses or more, a start rate at least 2 above the "
        "high rate, and no rate 0 with an internal base clock",
    ),
    Error.PA_TOO_LARGE: (RampTooLong, ""),
    Error.BAD_SWITCHING: (InvalidChopperTimes, ""),
    Error.RATE_ONE_AXIS: (RateLimitExceeded, ""),
    Error.RATE_TWO_AXES: (
        RateLimitExceeded,
        "the part rejects this speed while the other axis is in use (DATASHEET timing): choose a lower one, "
        "or wait until the other axis is at standstill",
    ),
}


def command_error(number: int, status: int, axis: int) -> CommandRefused:
    """Return the exception for a value of the error register of an axis, 1 to 13."""
    kind, text = BY_NUMBER[number]
    return kind(status, f"axis {axis}: {text or kind.text}")


# ---------------------------------------------------------------------- status register


@dataclass(frozen=True)
class Status:
    """Status register (P2104-STA-01).

    Attributes:
        busy: BUSY of axis 1 and of axis 2.
        working: CMND of axis 1 and of axis 2: True if a command waits for data or is being processed.
        error: True if an error register is not 0.
    """

    raw: int
    busy: tuple[bool, bool]
    working: tuple[bool, bool]
    error: bool
    input_full: bool
    output_full: bool

    @classmethod
    def parse(cls, raw: int) -> Status:
        """Decode the status byte."""
        return cls(
            raw,
            busy=(bool(raw & BUSY[0]), bool(raw & BUSY[1])),
            working=(bool(raw & CMND[0]), bool(raw & CMND[1])),
            error=bool(raw & ERROR),
            input_full=bool(raw & IBF),
            output_full=bool(raw & OBF),
        )


# ---------------------------------------------------------------------- times


def half_us_byte(xtal_hz: int, microseconds: Number, phase: str) -> tuple[int, Fraction]:
    """Return the chopper byte nearest to a time, and the resulting time in us (P2104-AUX-04).

    The unit is 0.5 us at 16 MHz, the range 64 to 255 units.

    Raises:
        OutOfRange: the time is out of range; the message states the range.
    """
    unit = Fraction(8_000_000, xtal_hz)
    requested = exact(microseconds, f"{phase} time")
    low, high = 64 * unit, 255 * unit
    if not low <= requested <= high:
        raise OutOfRange(
            f"{phase} time {nearby(microseconds)} us is outside {nearby(low)} to {nearby(high)} us"
        )
    byte = int(requested / unit + Fraction(1, 2))
    return byte, byte * unit


def hold_byte(xtal_hz: int, microseconds: Number) -> tuple[int, Fraction]:
    """Return the hold delay byte nearest to a time, and the resulting time in us (P2104-AUX-05).

    Raises:
        OutOfRange: the time is out of range, 128 to 32 768 us at 16 MHz; the message states the range.
    """
    unit = Fraction(2048_000_000, xtal_hz)
    requested = exact(microseconds, "hold delay")
    if not unit <= requested <= 256 * unit:
        raise OutOfRange(
            f"hold delay {nearby(microseconds)} us is outside {nearby(unit)} to {nearby(256 * unit)} us"
        )
    byte = int(requested / unit + Fraction(1, 2)) - 1
    return byte, (byte + 1) * unit


# ---------------------------------------------------------------------- capabilities

CAPABILITIES = RateCapabilities(
    part("ppmc2104"),
    axes=2,
    has=frozenset((PULSE_ONLY, COILS_OFF)),
    outputs=3,
    least_rate=1,
    rate_gap=2,
)


if not TYPE_CHECKING:
    __getattr__ = renamed(
        __name__,
        {
            "BadSwitching": "InvalidChopperTimes",
            "CutCommand": "IncompleteCommand",
            "TooFast": "RateLimitExceeded",
        },
    )
