"""What the host package raises but for refusals of the part (`refusals`) and ends of motions (`ending`).

Each message says what is wrong and what to do about it.
"""

# Names say what happened, as in `except LimitReached`; the common base is an Error.
# ruff: noqa: N818

from __future__ import annotations

from ...errors import PpmcError as PpmcError


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
