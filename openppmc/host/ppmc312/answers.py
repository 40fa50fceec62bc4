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

from ...model.ppmc312.codes import Answer, Cause, Source, State
from ..errors import CommandRefused
from .errors import command_error

# Registers of a PPMC-312 that can be read at any time (P312-CMD-4D, -27, -47).


@dataclass(frozen=True)
class Status:
    """Response to instruction 4D: state, monitors and registered instructions.

    Attributes:
        raw: condition byte of the response.
        run_monitored: True if starts wait for RUN.
        interlock: True if the interlock control is active.
        encoder_watched, position_watched: True if this monitor is on.
        encoder_outside, position_outside: True if the deviation exceeds the range of this monitor.
        overrides: number of registered overrides, 0 to 8.
        override_events: numbers (1, 2) of the event inputs for which at least one override waits.
        events: numbers (1, 2) of the event buffers that are not empty.
    """

    raw: int
    state: State
    run_monitored: bool
    interlock: bool
    encoder_watched: bool
    position_watched: bool
    end_monitored: bool
    encoder_outside: bool
    position_outside: bool
    overrides: int
    override_events: tuple[int, ...]
    events: tuple[int, ...]

    @classmethod
    def parse(cls, data: bytes) -> Status:
        """Decode the operation byte, the condition byte and the buffer byte.

        >>> Status.parse(bytes.fromhex("00 02 00")).state.name
        'NOR'
        """
        operation, condition, buffers = data
        return cls(
            condition,
            State(condition),
            run_monitored=not operation & 0x80,
            interlock=bool(operation & 0x40),
            encoder_watched=bool(operation & 0x10),
            position_watched=bool(operation & 0x08),
            end_monitored=bool(operation & 0x04),
            encoder_outside=bool(operation & 0x02),
            position_outside=bool(operation & 0x01),
            overrides=buffers & 15,
            override_events=tuple(n for n, bit in ((1, 0x10), (2, 0x20)) if buffers & bit),
            events=tuple(n for n, bit in ((1, 0x40), (2, 0x80)) if buffers & bit),
        )

    @property
    def busy(self) -> bool:
        """True if a motion is running or held."""
        return self.state in (State.ACC, State.FIX, State.WRN)

    @property
    def waiting(self) -> int:
        """Number of overrides and event buffers that wait for a position or an event."""
        return self.overrides + len(self.events)

    @property
    def in_alarm(self) -> bool:
        """True if the part is in the state ABN."""
        return self.state is State.ABN


@dataclass(frozen=True)
class Inputs:
    """Switches and other inputs; True = active (pin low).

    Attributes:
        run: True if the input RUN permits starts.
    """

    limit_cw: bool
    limit_ccw: bool
    slow_cw: bool
    slow_ccw: bool
    origin: bool
    index: bool
    end: bool
    alarm: bool
    run: bool
    event1: bool
    event2: bool

    @classmethod
    def parse(cls, data: bytes) -> Inputs:
        """Decode the two bytes of the response to instruction 27, which contain pin levels.

        >>> Inputs.parse(bytes.fromhex("FD E0")).active
        ['limit cw', 'run']
        """
        levels, other = data
        low = [not levels >> bit & 1 for bit in range(8)]
        return cls(
            limit_cw=low[1],
            limit_ccw=low[0],
            slow_cw=low[3],
            slow_ccw=low[2],
            origin=low[4],
            index=low[5],
            end=low[6],
            alarm=low[7],
            run=bool(other & 0x20),
            event1=not other & 0x40,
            event2=not other & 0x80,
        )

    @property
    def active(self) -> list[str]:
        """Names of the active inputs."""
        return [name.replace("_", " ") for name, on in vars(self).items() if on]


@dataclass(frozen=True)
class EventBuffer:
    """Response to instruction 47: content of an event buffer.

    Attributes:
        following: index, 0 to 3, in `codes` of the instruction that the next event executes.
        codes: codes of the instructions in the buffer.
    """

    following: int
    codes: tuple[int, ...]

    @classmethod
    def parse(cls, data: bytes) -> EventBuffer:
        """Decode the data of the response: count, index of the next instruction, four codes."""
        return cls(data[1], tuple(data[2 : 2 + data[0]]))


_SPONTANEOUS, _WHO, _HAS_CODE, _LAST = 0x20, 0x18, 0x02, 0x01


def signed(position: int) -> int:
    """Return a 32-bit position as a signed number, CW positive.

    >>> signed(0xFFFFFFF9)
    -7
    """
    return position - (position >> 31 << 32)


# ---------------------------------------------------------------------- reports


@dataclass(frozen=True)
class Stopped:
    """Report E0: the motion has ended.

    Attributes:
        position: signed position in pulses.
    """

    cause: Cause
    position: int


@dataclass(frozen=True)
class InterlockEnded:
    """Report E1: the interlock position was reached."""


@dataclass(frozen=True)
class HoldExecuted:
    """Report E2: a start that waited for RUN has begun."""


@dataclass(frozen=True)
class EncoderChange:
    """Report E3: the encoder position has left its permitted range (outside is True) or returned to it."""

    outside: bool


@dataclass(frozen=True)
class InPositionChange:
    """Report E4: the deviation has left the in-position range (outside is True) or has returned to it."""

    outside: bool


@dataclass(frozen=True)
class InputChange:
    """Report E9: inputs that have changed.

    Attributes:
        lost: True if an earlier change could not be reported.
    """

    changed: int
    lost: bool


@dataclass(frozen=True)
class Alarm:
    """Report F4: alarm. Status 0: alarm input; status 1 to 3: a report was not read in time."""

    status: int

    @property
    def error(self) -> CommandRefused:
        """Exception for the alarm."""
        error = command_error(Answer.ALARM, bytes([self.status]))
        assert error is not None
        return error


@dataclass(frozen=True)
class Executed:
    """An override or an event has executed an instruction.

    Attributes:
        code: code of the instruction, `None` in serial mode, where it is not reported.
        data: data of the response to this instruction.
    """

    by: Source
    code: int | None
    data: bytes = b""


@dataclass(frozen=True)
class Failed:
    """An override or an event did not execute its instruction.

    The part reports this with response F8 or F9, or with an error response whose header names an event.
    """

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


class BadResponse(ValueError):  # noqa: N818 - names the invalid object
    """Response that the part never sends."""


@dataclass(frozen=True)
class Response:
    """Response block in logical order: header, length and at least one byte. Raises BadResponse."""

    raw: bytes

    def __post_init__(self) -> None:
        if len(self.raw) < 3 or self.raw[1] != len(self.raw) - 2:
            raise BadResponse(f"response {self.raw.hex(' ')}: its length byte is wrong")

    @property
    def spontaneous(self) -> bool:
        """True for an unsolicited report: the block is no response to an instruction."""
        return bool(self.raw[0] & _SPONTANEOUS)

    @property
    def by(self) -> Source:
        """Source of the instruction to which this block is the response."""
        return Source(self.raw[0] & _WHO | 0x03)

    @property
    def to_host(self) -> bool:
        """True for a response to an instruction of the host."""
        return not self.spontaneous and self.by is Source.HOST

    @property
    def last(self) -> bool:
        """True if this is the last block of a response."""
        return bool(self.raw[0] & _LAST)

    @property
    def code(self) -> int:
        """Code of the instruction or report."""
        return self.raw[2]

    @property
    def data(self) -> bytes:
        """Data after the code. A data block has no code, so all its bytes are data."""
        return self.raw[3:] if self.raw[0] & _HAS_CODE else self.raw[2:]

    @property
    def error(self) -> CommandRefused | None:
        """Exception for an error response; `None` for any other response."""
        return command_error(self.code, self.data) if self.raw[0] & _HAS_CODE else None

    def report(self) -> Report:
        """Return the content of an unsolicited report. Raises BadResponse."""
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
