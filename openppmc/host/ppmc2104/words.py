"""What a PPMC-2104 allows, refuses (P2104-ERR-01: a table of its own) and tells (P2104-STA-01); times in
microseconds to parameter bytes and back, exactly. Pure."""

# ruff: noqa: N818

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from ...model.motion.codes import IBF, OBF
from ...model.ppmc2104.codes import BUSY, CMND, ERROR, Error
from ...parts import part
from ..errors import (
    AlreadyDecelerating,
    BadRamp,
    CommandRefused,
    NothingToStop,
    NotInitialised,
    NotWhileBusy,
    OutOfRange,
    RampTooLong,
    StartRefused,
    UnexpectedData,
    UnknownCode,
)
from ..kind import COILS_OFF, PULSE_ONLY, RateKind
from ..speeds import Number, exact, nearby


class CutCommand(CommandRefused):
    """Error 3 of the PPMC-2104."""

    text = (
        "the part was still waiting for the data of another command, and both are dropped: another program "
        "may be using it; send the command again"
    )


class BadSwitching(CommandRefused):
    """Error 11 of the PPMC-2104."""

    text = "the part refuses these chopper times: 32 us or more each at a 16 MHz crystal"


class TooFast(CommandRefused):
    """Errors 12 and 13 of the PPMC-2104 with DATASHEET timing."""

    text = (
        "the part refuses this speed: with DATASHEET timing one axis cannot run so fast, choose a lower one"
    )


BY_NUMBER: dict[int, tuple[type[CommandRefused], str]] = {
    Error.UNDEFINED: (UnknownCode, ""),
    Error.UNASKED_DATA: (UnexpectedData, ""),
    Error.DATA_OUTSTANDING: (CutCommand, ""),
    Error.NOT_INITIALISED: (
        NotInitialised,
        "it is not initialised (power-up, reset or excitation off): initialise it first",
    ),
    Error.NOT_WHILE_BUSY: (
        NotWhileBusy,
        "it is busy with a motion: wait for its end or stop it first",
    ),
    Error.NOTHING_TO_STOP: (NothingToStop, "nothing to stop: it is at rest"),
    Error.START_REFUSED: (StartRefused, ""),
    Error.CANNOT_DECELERATE: (
        AlreadyDecelerating,
        "the motor is decelerating already, runs at constant speed or waits for RUN: wait for its end, or "
        "halt it at once",
    ),
    Error.BAD_RATE: (
        BadRamp,
        "the part refuses this ramp or speed: it needs 4 pulses or more, a start rate at least 2 above the "
        "high rate, and no rate 0 with an internal base clock",
    ),
    Error.PA_TOO_LARGE: (RampTooLong, ""),
    Error.BAD_SWITCHING: (BadSwitching, ""),
    Error.RATE_ONE_AXIS: (TooFast, ""),
    Error.RATE_TWO_AXES: (
        TooFast,
        "the part refuses this speed while the other axis is in use (DATASHEET timing): choose a lower one, "
        "or wait until the other axis rests",
    ),
}


def refused(number: int, status: int, axis: int) -> CommandRefused:
    """The exception for the error register of an axis that reads `number`, 1 to 13."""
    kind, text = BY_NUMBER[number]
    return kind(status, f"axis {axis}: {text or kind.text}")


# The PPMC-2104's status register as a dataclass (P2104-STA-01). Pure.


@dataclass(frozen=True)
class Status:
    """Status register. busy, working: of axis 1 and 2; working: data are wanted, or a command is under way.
    error: an error register is not 0."""

    raw: int
    busy: tuple[bool, bool]
    working: tuple[bool, bool]
    error: bool
    input_full: bool
    output_full: bool

    @classmethod
    def parse(cls, raw: int) -> Status:
        """From the byte."""
        return cls(
            raw,
            busy=(bool(raw & BUSY[0]), bool(raw & BUSY[1])),
            working=(bool(raw & CMND[0]), bool(raw & CMND[1])),
            error=bool(raw & ERROR),
            input_full=bool(raw & IBF),
            output_full=bool(raw & OBF),
        )


# Times of a PPMC-2104 in microseconds to parameter bytes and back, exactly. Pure.


def half_us_byte(xtal_hz: int, microseconds: Number, phase: str) -> tuple[int, Fraction]:
    """Parameter byte of the chopper nearest to a time, and the time it makes in us
    (P2104-AUX-04): 0.5 us a unit at 16 MHz, 64 to 255  Raises OutOfRange with the possible range."""
    unit = Fraction(8_000_000, xtal_hz)
    asked = exact(microseconds, f"{phase} time")
    low, high = 64 * unit, 255 * unit
    if not low <= asked <= high:
        raise OutOfRange(
            f"{phase} time {nearby(microseconds)} us is outside {nearby(low)} to {nearby(high)} us"
        )
    byte = int(asked / unit + Fraction(1, 2))
    return byte, byte * unit


def hold_byte(xtal_hz: int, microseconds: Number) -> tuple[int, Fraction]:
    """Parameter byte of the hold delay nearest to a time, and the time it makes in us
    (P2104-AUX-05): 128 to 32 768 us at 16 MHz. Raises OutOfRange with the possible range."""
    unit = Fraction(2048_000_000, xtal_hz)
    asked = exact(microseconds, "hold delay")
    if not unit <= asked <= 256 * unit:
        raise OutOfRange(
            f"hold delay {nearby(microseconds)} us is outside {nearby(unit)} to {nearby(256 * unit)} us"
        )
    byte = int(asked / unit + Fraction(1, 2)) - 1
    return byte, (byte + 1) * unit


# What a PPMC-2104 allows. Pure.

KIND = RateKind(
    part("ppmc2104"),
    axes=2,
    has=frozenset((PULSE_ONLY, COILS_OFF)),
    outputs=3,
    least_rate=1,
    rate_gap=2,
)
