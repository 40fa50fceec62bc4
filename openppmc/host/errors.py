"""Everything that the host package raises. Each message says what is wrong and what to do about it."""

# Names say what happened, as in `except LimitReached`; the common base is an Error.
# ruff: noqa: N818

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.codes104 import Error

if TYPE_CHECKING:
    from .ending import End


class PpmcError(Exception):
    """Base of all errors of this package."""


class OutOfRange(PpmcError, ValueError):
    """An argument outside its range; the message gives range and unit."""


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
    """The part set ERR. `status` is its status byte; one subclass per error number."""

    number: int
    text = ""

    def __init__(self, status: int) -> None:
        super().__init__(self.text)
        self.status = status


class NothingToStop(CommandRefused):
    """Error 0. The driver sends only defined codes, so it is a stop command at rest."""

    number = Error.UNDEFINED
    text = "nothing to stop: the motor is at rest (or the code is unknown)"


class NotWhileBusy(CommandRefused):
    """Error 1."""

    number = Error.NOT_WHILE_BUSY
    text = "the part is busy with a motion: wait for its end or stop it first"


class NotInitialised(CommandRefused):
    """Error 2."""

    number = Error.NOT_INITIALISED
    text = "the part is not initialised (power-up, reset or excitation off): initialise it first"


class UnexpectedData(CommandRefused):
    """Error 3."""

    number = Error.UNASKED_DATA
    text = "the part did not ask for this data byte: another program may be using it; send the command again"


class RampTooLong(CommandRefused):
    """Error 4."""

    number = Error.PA_TOO_LARGE
    text = "the part refuses a ramp of more than 11220 pulses: choose a shorter one"


class BadRamp(CommandRefused):
    """Error 5."""

    number = Error.BAD_RAMP
    text = "the part refuses this ramp: it needs 4 pulses or more, and a high speed not below the start speed"


class UnexpectedDataBusy(CommandRefused):
    """Error 6."""

    number = Error.UNASKED_DATA_BUSY
    text = "the part did not ask for this data byte during the motion: another program may be using it"


class AlreadyDecelerating(CommandRefused):
    """Error 7."""

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
