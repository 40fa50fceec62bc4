"""Responses of the PPMC-312, decoded. Pure.

>>> Response(bytes.fromhex("23 06 E0 40 00 00 13 88")).report()
Stopped(cause=<Cause.NORMAL: 64>, position=5000)
>>> Response(bytes.fromhex("1B 01 80")).report()
Executed(by=<Source.OVERRIDE: 27>, code=128, data=b'')
>>> Response(bytes.fromhex("03 02 40 12")).error is None
True
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from ...model.ppmc312.codes import Answer, Cause, Source
from ..basis.refusals import CommandRefused
from .errors import refused

_SPONTANEOUS, _WHO, _HAS_CODE, _LAST = 0x20, 0x18, 0x02, 0x01


def signed(position: int) -> int:
    """A 32-bit position, CW positive.

    >>> signed(0xFFFFFFF9)
    -7
    """
    return position - (position >> 31 << 32)


# ---------------------------------------------------------------------- reports


@dataclass(frozen=True)
class Stopped:
    """E0: the pulses have ended. position: signed pulses."""

    cause: Cause
    position: int


@dataclass(frozen=True)
class InterlockEnded:
    """E1: the interlock position was reached."""


@dataclass(frozen=True)
class HoldExecuted:
    """E2: a start that waited for RUN began."""


@dataclass(frozen=True)
class EncoderChange:
    """E3: the encoder left its range, or came back."""

    outside: bool


@dataclass(frozen=True)
class InPositionChange:
    """E4: the same, for the in-position monitor."""

    outside: bool


@dataclass(frozen=True)
class InputChange:
    """E9: inputs that have changed; lost: there was a change before that could not be reported."""

    changed: int
    lost: bool


@dataclass(frozen=True)
class Alarm:
    """F4: 0 alarm input, 1 to 3 reports that were not read in time."""

    status: int

    @property
    def error(self) -> CommandRefused:
        """As an exception."""
        error = refused(Answer.ALARM, bytes([self.status]))
        assert error is not None
        return error


@dataclass(frozen=True)
class Executed:
    """An override or an event has carried an instruction out. code: which one, None in serial mode, where
    nobody says it. data: what it answered."""

    by: Source
    code: int | None
    data: bytes = b""


@dataclass(frozen=True)
class Failed:
    """F8, F9 or a refusal with the header of an event: an instruction of override or event was not carried
    out."""

    by: Source
    error: CommandRefused


Report: TypeAlias = (
    Stopped
    | InterlockEnded
    | HoldExecuted
    | EncoderChange
    | InPositionChange
    | InputChange
    | Alarm
    | Executed
    | Failed
)


class BadResponse(ValueError):  # noqa: N818 - the noun says it
    """A response that the part never makes."""


@dataclass(frozen=True)
class Response:
    """One block in logical order, at least header, length and a byte. Raises BadResponse."""

    raw: bytes

    def __post_init__(self) -> None:
        if len(self.raw) < 3 or self.raw[1] != len(self.raw) - 2:
            raise BadResponse(f"response {self.raw.hex(' ')}: its length byte is wrong")

    @property
    def spontaneous(self) -> bool:
        """Nobody asked."""
        return bool(self.raw[0] & _SPONTANEOUS)

    @property
    def by(self) -> Source:
        """Who gave the instruction that this is an answer to."""
        return Source(self.raw[0] & _WHO | 0x03)

    @property
    def to_host(self) -> bool:
        """The answer to an instruction of the host."""
        return not self.spontaneous and self.by is Source.HOST

    @property
    def last(self) -> bool:
        """No more blocks follow."""
        return bool(self.raw[0] & _LAST)

    @property
    def code(self) -> int:
        """Of the instruction or report."""
        return self.raw[2]

    @property
    def data(self) -> bytes:
        """After the code; of a block of data, all of it."""
        return self.raw[3:] if self.raw[0] & _HAS_CODE else self.raw[2:]

    @property
    def error(self) -> CommandRefused | None:
        """The refusal that it is, if it is one."""
        return refused(self.code, self.data) if self.raw[0] & _HAS_CODE else None

    def report(self) -> Report:
        """What it says, for everything that is not an answer to the host. Raises BadResponse."""
        data = self.data
        try:
            if not self.spontaneous:
                error = self.error
                return Executed(self.by, self.code, data) if error is None else Failed(self.by, error)
            if self.code == Answer.STOPPED and len(data) == 5:
                return Stopped(Cause(data[0]), signed(int.from_bytes(data[1:5], "big")))
            if self.code == Answer.INPUT_CHANGE:
                return InputChange(data[1], bool(data[0]))
            if self.code == Answer.ALARM:
                return Alarm(data[0])
            if self.code == Answer.ENCODE_CHANGE:
                return EncoderChange(bool(data[0]))
            if self.code == Answer.POSITION_CHANGE:
                return InPositionChange(bool(data[0]))
            if self.code == Answer.INTERLOCK_END:
                return InterlockEnded()
            if self.code == Answer.HOLD_EXECUTED:
                return HoldExecuted()
        except (IndexError, ValueError):
            pass
        raise BadResponse(f"response {self.raw.hex(' ')} is not known")
