"""Errors of ports and lines, and refusals of a part, as exceptions. Ends of motions: `ending`.

Each message says what is wrong and what to do about it. Names say what happened, as in
`except LimitReached`; the common base is an Error. What only one part refuses is in its module or folder.
"""

# ruff: noqa: N818

from __future__ import annotations

from ..errors import PpmcError as PpmcError
from ..model.single.codes import Error


class OutOfRange(PpmcError, ValueError):
    """An argument outside its range; the message gives range and unit."""


class NoSuchName(PpmcError, AttributeError):
    """A name was set that the object does not have: a mistyped setting, most likely."""


class Misused(PpmcError, TypeError, AttributeError):
    """A method without its parentheses was used as a number, or as the object that it returns."""


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


# Names say what happened, as in `except LimitReached`; the common base is an Error.


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


class UnknownCode(CommandRefused):
    """Error 1 of the PPMC-2104."""

    text = "the part does not know this code: check the script"


class StartRefused(CommandRefused):
    """Error 7 of the PPMC-2104; other parts have reasons of their own."""

    text = (
        "it may not start: its limit switch of this direction, its alarm or, for a search, its origin "
        "switch is active: move the other way, or clear the alarm"
    )


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
