"""What a line of PPMC-312 and its stations can refuse or get wrong, as exceptions."""

# ruff: noqa: N818

from __future__ import annotations

from enum import IntEnum

from ....model.ppmc312.codes import Code, Source, State
from ...basis.refusals import CommandRefused, NotWhileBusy, StartRefused, UnknownCode
from ..errors import (
    LIMIT,
    STATES,
    BadBlock,
    EventFailed,
    OverrideFailed,
    ParameterRefused,
    RateRefused,
    RegistrationRefused,
    TableRefused,
)


class Error(IntEnum):
    """Error codes of replies."""

    CHECKSUM = 0x41
    PARAMETER = 0x42
    STATUS = 0x43
    LIMIT = 0x44
    ALARM = 0x46
    COMMAND = 0x47
    SIZE = 0x48
    REGISTRATION = 0x49
    EVENT_FAILED = 0x4A
    OVERRIDE_FAILED = 0x4B


_SERIAL_PARAMETERS: dict[int, tuple[type[ParameterRefused], str]] = {
    Code.INITIAL: (
        TableRefused,
        "the part refuses this table: its speeds are too close, or its ramp too short",
    ),
    **dict.fromkeys(
        (Code.RAMP, Code.CONSTANT),
        (RateRefused, "the speed is outside those of the table, or there are no pulses"),
    ),
    **dict.fromkeys(
        (Code.FOREVER_RAMP, Code.FOREVER_CONSTANT, Code.ORIGIN_SEARCH, Code.ZERO_RETURN, Code.RAMP_CHANGE),
        (RateRefused, "the speed is outside those of the table"),
    ),
    Code.CHANGE: (RateRefused, "the speed is outside those of the table"),
}
_STOPPING = (Code.STOP, Code.SLOW_STOP, Code.RAMP_CHANGE, Code.CHANGE)


def refused_serial(who: str, code: int, error: int, state: int | None = None) -> CommandRefused:
    """The exception for error code `error` of a reply. code: of the instruction on the parallel bus. state:
    condition of the part as read afterwards, for 43.

    >>> str(refused_serial("station 3: ", 0x82, 0x43, 0x10))
    'station 3: the part is in alarm: remove the cause, then clear the alarm (or reset)'
    >>> str(refused_serial("", 0x82, 0x43, 0x02))
    'the part was busy with a motion: try again'
    """
    kind: type[CommandRefused]
    if error == Error.PARAMETER:
        kind, text = _SERIAL_PARAMETERS.get(code, (ParameterRefused, "the part refuses a value of this"))
    elif error == Error.STATUS:
        if state == State.NOR and code not in _STOPPING:
            kind, text = NotWhileBusy, "the part was busy with a motion: try again"
        else:
            kind, text = STATES.get(state or 0, (NotWhileBusy, ""))
    elif error == Error.LIMIT:
        kind, text = StartRefused, LIMIT
    elif error == Error.COMMAND:
        kind, text = UnknownCode, ""
    elif error == Error.SIZE:
        kind, text = BadBlock, "an event buffer takes instructions of up to 10 bytes in serial mode"
    elif error == Error.REGISTRATION:
        kind, text = (
            RegistrationRefused,
            "all places are taken, or the event is in use by an override or buffer",
        )
    else:
        kind, text = CommandRefused, f"the part refuses this (error {error:02X})"
    return kind(error, who + (text or kind.text))


def failed_serial(who: str, by: Source) -> CommandRefused:
    """What an override or event interruption (4B, 4A) means."""
    if by is Source.OVERRIDE:
        return OverrideFailed(0, f"{who}an override was not carried out; the others are dropped")
    return EventFailed(0, f"{who}an event's instruction was not carried out; its buffer is empty now")
