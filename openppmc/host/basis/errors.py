"""Everything that the host package raises. Each message says what is wrong and what to do about it."""

# Names say what happened, as in `except LimitReached`; the common base is an Error.
# ruff: noqa: N818

from __future__ import annotations

from typing import TYPE_CHECKING

from ...errors import PpmcError
from ...model.ppmc2104.codes import Error as Error2104
from ...model.single.codes import Error

if TYPE_CHECKING:
    from .ending import End


class OutOfRange(PpmcError, ValueError):
    """An argument outside its range; the message gives range and unit."""


class NoSuchName(PpmcError, AttributeError):
    """A name was set that the object does not have: a mistyped setting, most likely."""


class Misused(PpmcError, TypeError, AttributeError):
    """A method without its parentheses was used as a value."""


class Timeout(PpmcError, TimeoutError):
    """A wait with a time limit given by the caller ran out."""


# ---------------------------------------------------------------------- port and line


class LinkError(PpmcError):
    """The way to the board: port, cable, protocol."""


class PortError(LinkError):
    """The port cannot be opened: no such port, taken, not allowed, not a serial port, bad text."""


class NoAnswer(LinkError):
    """Nothing that could be an answer came back."""


class WrongDevice(LinkError):
    """Something answers, but it is not the bridge or the part that was asked for."""


class ProtocolError(LinkError):
    """The bridge did something that its contract does not know."""


class Disconnected(LinkError):
    """The port went away while it was open."""


# ---------------------------------------------------------------------- the part refuses


class CommandRefused(PpmcError):
    """The part refused a byte. `status` is its status byte; one subclass per reason.

    `number` is the error number of PPMC-104 and STMC; those of the PPMC-2104 are in a table of their own.
    """

    number: int
    text = ""

    def __init__(self, status: int, text: str = "") -> None:
        super().__init__(text or self.text)
        self.status = status


class NothingToStop(CommandRefused):
    """Error 0 (PPMC-2104: 6). The driver sends only defined codes, so it is a stop command at rest."""

    number = Error.UNDEFINED
    text = "nothing to stop: the motor is at rest (or the code is unknown)"


class NotWhileBusy(CommandRefused):
    """Error 1 (PPMC-2104: 5)."""

    number = Error.NOT_WHILE_BUSY
    text = "the part is busy with a motion: wait for its end or stop it first"


class NotInitialised(CommandRefused):
    """Error 2 (PPMC-2104: 4)."""

    number = Error.NOT_INITIALISED
    text = "the part is not initialised (power-up, reset or excitation off): initialise it first"


class UnexpectedData(CommandRefused):
    """Error 3 (PPMC-2104: 2)."""

    number = Error.UNASKED_DATA
    text = "the part did not ask for this data byte: another program may be using it; send the command again"


class RampTooLong(CommandRefused):
    """Error 4 (PPMC-2104: 10)."""

    number = Error.PA_TOO_LARGE
    text = "the part refuses a ramp of more than 11220 pulses: choose a shorter one"


class BadRamp(CommandRefused):
    """Error 5 (PPMC-2104: 9)."""

    number = Error.BAD_RAMP
    text = "the part refuses this ramp: it needs 4 pulses or more, and a high speed not below the start speed"


class UnexpectedDataBusy(CommandRefused):
    """Error 6."""

    number = Error.UNASKED_DATA_BUSY
    text = "the part did not ask for this data byte during the motion: another program may be using it"


class AlreadyDecelerating(CommandRefused):
    """Error 7 (PPMC-2104: 8)."""

    number = Error.ALREADY_DECELERATING
    text = "the motor is decelerating already: wait for its end, or halt it at once"


BY_NUMBER: dict[int, type[CommandRefused]] = {
    kind.number: kind
    for kind in (
        NothingToStop,
        NotWhileBusy,
        NotInitialised,
        UnexpectedData,
        RampTooLong,
        BadRamp,
        UnexpectedDataBusy,
        AlreadyDecelerating,
    )
}


def refused(status: int) -> CommandRefused:
    """The exception for a status byte with ERR = 1."""
    return BY_NUMBER[status >> 4 & 7](status)


# ---------------------------------------------------------------------- of the STMC: the same numbers

_TEXTS_STMC = {
    Error.NOT_INITIALISED: "the part is not initialised (power-up or reset): initialise it first",
    Error.BAD_RAMP: "the part refuses a divisor: 1 or more, and that of the high speed not above the other",
}


def refused_stmc(status: int) -> CommandRefused:
    """The exception for a status byte of an STMC with ERR = 1."""
    number = status >> 4 & 7
    return BY_NUMBER[number](status, _TEXTS_STMC.get(Error(number), ""))


# ---------------------------------------------------------------------- of the PPMC-2104 only


class UnknownCode(CommandRefused):
    """Error 1 of the PPMC-2104."""

    text = "the part does not know this code: check the script"


class CutCommand(CommandRefused):
    """Error 3 of the PPMC-2104."""

    text = (
        "the part was still waiting for the data of another command, and both are dropped: another program "
        "may be using it; send the command again"
    )


class StartRefused(CommandRefused):
    """Error 7 of the PPMC-2104."""

    text = (
        "it may not start: its limit switch of this direction, its alarm or, for a search, its origin "
        "switch is active: move the other way, or clear the alarm"
    )


class BadSwitching(CommandRefused):
    """Error 11 of the PPMC-2104."""

    text = "the part refuses these chopper times: 32 us or more each at a 16 MHz crystal"


class TooFast(CommandRefused):
    """Errors 12 and 13 of the PPMC-2104 with DATASHEET timing."""

    text = (
        "the part refuses this speed: with DATASHEET timing one axis cannot run so fast, choose a lower one"
    )


BY_NUMBER_2104: dict[int, tuple[type[CommandRefused], str]] = {
    Error2104.UNDEFINED: (UnknownCode, ""),
    Error2104.UNASKED_DATA: (UnexpectedData, ""),
    Error2104.DATA_OUTSTANDING: (CutCommand, ""),
    Error2104.NOT_INITIALISED: (
        NotInitialised,
        "it is not initialised (power-up, reset or excitation off): initialise it first",
    ),
    Error2104.NOT_WHILE_BUSY: (
        NotWhileBusy,
        "it is busy with a motion: wait for its end or stop it first",
    ),
    Error2104.NOTHING_TO_STOP: (NothingToStop, "nothing to stop: it is at rest"),
    Error2104.START_REFUSED: (StartRefused, ""),
    Error2104.CANNOT_DECELERATE: (
        AlreadyDecelerating,
        "the motor is decelerating already, runs at constant speed or waits for RUN: wait for its end, or "
        "halt it at once",
    ),
    Error2104.BAD_RATE: (
        BadRamp,
        "the part refuses this ramp or speed: it needs 4 pulses or more, a start rate at least 2 above the "
        "high rate, and no rate 0 with an internal base clock",
    ),
    Error2104.PA_TOO_LARGE: (RampTooLong, ""),
    Error2104.BAD_SWITCHING: (BadSwitching, ""),
    Error2104.RATE_ONE_AXIS: (TooFast, ""),
    Error2104.RATE_TWO_AXES: (
        TooFast,
        "the part refuses this speed while the other axis is in use (DATASHEET timing): choose a lower one, "
        "or wait until the other axis rests",
    ),
}


def refused2104(number: int, status: int, axis: int) -> CommandRefused:
    """The exception for the error register of an axis that reads `number`, 1 to 13."""
    kind, text = BY_NUMBER_2104[number]
    return kind(status, f"axis {axis}: {text or kind.text}")


# ---------------------------------------------------------------------- motions


class MotionError(PpmcError):
    """A motion ended other than asked for; `end` says where and why."""

    def __init__(self, message: str, end: End) -> None:
        super().__init__(message)
        self.end = end


class LimitReached(MotionError):
    """A hard or slow-down limit switch ended the motion."""


class AlarmStop(MotionError):
    """The alarm input ended the motion."""


class StoppedEarly(MotionError):
    """A stop command ended a motion that was to be complete."""


class OriginNotFound(MotionError):
    """Homing ended without the origin switch."""
