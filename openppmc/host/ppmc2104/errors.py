"""What a PPMC-2104 refuses: its error registers have a table of their own (P2104-ERR-01)."""

# ruff: noqa: N818

from __future__ import annotations

from ...model.ppmc2104.codes import Error
from ..basis.refusals import (
    AlreadyDecelerating,
    BadRamp,
    CommandRefused,
    NothingToStop,
    NotInitialised,
    NotWhileBusy,
    RampTooLong,
    StartRefused,
    UnexpectedData,
    UnknownCode,
)


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
