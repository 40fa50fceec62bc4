"""Exceptions for ports, lines and rejected commands.

The exceptions for the ends of motions are in `motion_result`.

Each message states what is wrong and what to do. The name of an exception states the event, as in `except
LimitReached`. An exception that only one part raises is in the module or folder of that part.
"""

# ruff: noqa: N818

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import PpmcError as PpmcError
from ..lazy import renamed
from ..model.single.codes import Error


class OutOfRange(PpmcError, ValueError):
    """An argument is outside its range; the message states range and unit."""


class UnknownAttributeError(PpmcError, AttributeError):
    """An attribute was set that does not exist, for example because of a typing error."""


class NotCalledError(PpmcError, TypeError, AttributeError):
    """A method was used in place of its result, because the parentheses of the call are missing."""


class Timeout(PpmcError, TimeoutError):
    """A wait exceeded the time limit that the caller has set."""


# ---------------------------------------------------------------------- port and line


class LinkError(PpmcError):
    """Error on the path to the board: port, cable or protocol."""


class PortError(LinkError):
    """The port cannot be opened.

    The port does not exist, is in use, may not be opened by this user, or is not a serial port.
    """


class NoAnswer(LinkError):
    """No valid response was received."""


class WrongDevice(LinkError):
    """A device responds, but it is not the requested bridge or part."""


class ProtocolError(LinkError):
    """The bridge violated its protocol."""


class Disconnected(LinkError):
    """The port disappeared while it was open."""


# ---------------------------------------------------------------------- rejected commands


class CommandRefused(PpmcError):
    """The part rejected a byte. Each reason has a subclass.

    Args:
        status: status byte of the part.

    Attributes:
        number: error number of the PPMC-104 and the STMC; the numbers of the PPMC-2104 differ.
    """

    number: int
    text = ""

    def __init__(self, status: int, text: str = "") -> None:
        super().__init__(text or self.text)
        self.status = status


class NothingToStop(CommandRefused):
    """Error 0 (PPMC-2104: 6): a stop command while the motor is stopped.

    The part also reports this error for an undefined code, but the driver sends only defined codes.
    """

    number = Error.UNDEFINED
    text = "nothing to stop: the motor is at standstill (or the code is unknown)"


class AxisBusy(CommandRefused):
    """Error 1 (PPMC-2104: 5): the part is busy with a motion."""

    number = Error.NOT_WHILE_BUSY
    text = "the part is busy with a motion: wait for its end or stop it first"


class NotInitialised(CommandRefused):
    """Error 2 (PPMC-2104: 4): the part is not initialised."""

    number = Error.NOT_INITIALISED
    text = "the part is not initialised (power-up, reset or excitation off): initialise it first"


class UnexpectedData(CommandRefused):
    """Error 3 (PPMC-2104: 2): a data byte arrived that no command requested."""

    number = Error.UNASKED_DATA
    text = (
        "the part did not request this data byte: another program may be using the part; "
        "send the command again"
    )


class RampTooLong(CommandRefused):
    """Error 4 (PPMC-2104: 10): the ramp is too long."""

    number = Error.PA_TOO_LARGE
    text = "the part rejects a ramp of more than 11220 pulses: choose a shorter one"


class InvalidRamp(CommandRefused):
    """Error 5 (PPMC-2104: 9): the ramp is invalid."""

    number = Error.BAD_RAMP
    text = "the part rejects this ramp: use 4 pulses or more, and a high speed not below the start speed"


class UnexpectedDataBusy(CommandRefused):
    """Error 6: a data byte that no command requested arrived during a motion."""

    number = Error.UNASKED_DATA_BUSY
    text = "the part did not request this data byte during the motion: another program may be using the part"


class AlreadyDecelerating(CommandRefused):
    """Error 7 (PPMC-2104: 8): a deceleration stop while the motor is decelerating."""

    number = Error.ALREADY_DECELERATING
    text = "the motor is already decelerating: wait for the end of the motion, or stop it immediately"


class UnknownCommand(CommandRefused):
    """Error 1 of the PPMC-2104: the code is undefined."""

    text = "the part does not know this code: check the script"


class StartRefused(CommandRefused):
    """Error 7 of the PPMC-2104: an active switch prevents the start.

    Other parts reject a start for other reasons.
    """

    text = (
        "the motor cannot start: the limit switch of this direction, the alarm or, for a search, the origin "
        "switch is active: move in the other direction, or clear the alarm"
    )


BY_NUMBER: dict[int, type[CommandRefused]] = {
    kind.number: kind
    for kind in (
        NothingToStop,
        AxisBusy,
        NotInitialised,
        UnexpectedData,
        RampTooLong,
        InvalidRamp,
        UnexpectedDataBusy,
        AlreadyDecelerating,
    )
}


def command_error(status: int) -> CommandRefused:
    """Return the exception for a status byte with ERR = 1."""
    return BY_NUMBER[status >> 4 & 7](status)


if not TYPE_CHECKING:
    __getattr__ = renamed(
        __name__,
        {
            "BadRamp": "InvalidRamp",
            "Misused": "NotCalledError",
            "NoSuchName": "UnknownAttributeError",
            "NotWhileBusy": "AxisBusy",
            "UnknownCode": "UnknownCommand",
        },
    )
