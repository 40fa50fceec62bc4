"""Errors and alarms of the PPMC-312 as exceptions, with one class for each reason.

`host.errors` has the base class.

`CommandRefused.status` is the byte of the response that holds the reason.
"""

# ruff: noqa: N818

from __future__ import annotations

from typing import TYPE_CHECKING

from ...lazy import renamed
from ...model.ppmc312.codes import Answer, State
from ..errors import AxisBusy, CommandRefused, NothingToStop, NotInitialised, StartRefused, UnknownCommand


class ParameterRefused(CommandRefused):
    """Error F0: the part does not accept a value.

    Attributes:
        number: number of the error, which identifies the rejected value.
        echo: instruction as the part received it.
    """

    echo = b""


class RateRefused(ParameterRefused):
    """Errors F0 01 and F0 20: a rate is out of range."""


class TableRefused(ParameterRefused):
    """Errors F0 02 to 05: the speeds are too close or in the wrong order, or the ramp has too few pulses."""


class CurveRefused(ParameterRefused):
    """Errors F0 10 to 1A: a free curve is invalid. After this error, the part has no table."""


class UnexpectedInstruction(CommandRefused):
    """Errors F1 01 and F1 02: a data block without a free curve, or another instruction before its end."""

    text = "the part did not expect this block: another program may be using it; send the command again"


class InAlarm(CommandRefused):
    """Error F1 in state ABN: the part is in the alarm state."""

    text = "the part is in alarm: remove the cause, then clear the alarm (or reset)"


class HeldByRun(CommandRefused):
    """Error F1 in state WRN: a start waits for RUN."""

    text = "a start waits for RUN: activate RUN, switch its monitor off, or reset the part"


class InvalidBlockLength(CommandRefused):
    """Error F6: the length byte does not match the block."""

    text = "the length of the block is wrong for the part: send the command again"


class RegistrationRefused(CommandRefused):
    """Error F7: an override could not be registered."""


class OverrideFailed(CommandRefused):
    """Report F9: a registered override was not executed. All other overrides are discarded."""


class EventFailed(CommandRefused):
    """Report F8: an instruction of an event buffer was not executed. The buffer is now empty."""


class AlarmRaised(CommandRefused):
    """Report F4: the part stopped the pulses and entered the alarm state."""


_PARAMETERS: dict[int, tuple[type[ParameterRefused], str]] = {
    0x00: (ParameterRefused, "the part rejects the length of this setting: renew the package"),
    0x01: (
        RateRefused,
        "a rate of the setting is out of range: high rate 2 to 65519, start and stop from 17",
    ),
    0x02: (TableRefused, "start (or stop) and high speed are too close: 128 or more rate steps between"),
    0x03: (TableRefused, "the high speed must be above start and stop speed"),
    0x04: (TableRefused, "start or stop speed is too close to the high speed: 128 rate steps or more"),
    0x05: (TableRefused, "the ramp is too short: each of its stages needs 2 pulses"),
    0x10: (CurveRefused, "a free curve begins with its number of stages"),
    0x11: (CurveRefused, "a free curve has 2 to 127 stages a side"),
    0x15: (CurveRefused, "a block of the free curve is too long"),
    0x16: (CurveRefused, "a block of the free curve holds the wrong number of values"),
    0x17: (CurveRefused, "the free curve ended too early or too late"),
    0x18: (CurveRefused, "the free curve has a rate below 2"),
    0x19: (CurveRefused, "the free curve has a stage with fewer than 2 pulses"),
    0x1A: (CurveRefused, "the free curve has more than 16777215 pulses on a side"),
    0x20: (RateRefused, "the speed is outside those of the table"),
    0x21: (ParameterRefused, "a start cannot wait for a position: use an event"),
    0x23: (ParameterRefused, "an operand is invalid: a number of pulses, or the choice of a position"),
    0x24: (ParameterRefused, "there are event buffers 1 and 2"),
    0x25: (ParameterRefused, "a place in an event buffer holds one instruction of up to 14 bytes"),
    0x26: (ParameterRefused, "the in-position range must be 1 to 65535"),
    0x27: (ParameterRefused, "the encoder range must be 1 to 65535"),
}
STATES: dict[int, tuple[type[CommandRefused], str]] = {
    State.INI: (NotInitialised, "the part has no table (power-up, reset, rejected setting): initialise it"),
    State.NOR: (NothingToStop, "nothing to stop or to change: the motor is at standstill"),
    State.ACC: (AxisBusy, "the part is busy with a motion (speed changing): wait, or stop it first"),
    State.FIX: (AxisBusy, "the part is busy with a motion: wait for its end or stop it first"),
    State.ABN: (InAlarm, ""),
    State.WRN: (HeldByRun, ""),
}
LIMIT = "the motor cannot start: a limit switch of this direction is active: move in the other direction"
_ALARMS = {
    0: "the alarm input is active: clear the drive's alarm, then clear the part's",
    1: "an unread answer prevented an instruction, override or event: read the part's reports more often, "
    "clear the alarm",
    2: "a report of interlock or RUN was unread at the next one: read the part's reports more often, clear "
    "the alarm",
    3: "a stop report was unread at the next one: read the part's reports more often, clear the alarm",
}
MISSED = {
    1: ("an unread answer", "an instruction, override or event was not executed; clear the part's alarm"),
    2: ("an unread report", "clear the part's alarm"),
    3: ("an unread report", "clear the part's alarm"),
}
"""Name and advice of the alarms that the alarm input did not cause, by the status in the report."""
_FAILURES = {
    0: "a parameter was rejected",
    1: "the state did not allow it",
    2: "a limit switch was active",
    5: "its code is unknown",
}


def command_error(code: int, parameters: bytes) -> CommandRefused | None:
    """Return the exception for an error response; `None` for any other response.

    >>> str(command_error(0xF1, bytes([0, 0x10])))
    'the part is in alarm: remove the cause, then clear the alarm (or reset)'
    >>> type(command_error(0xF0, bytes([0x18]))).__name__
    'CurveRefused'
    >>> command_error(0x40, bytes([0x12])) is None
    True
    """
    first = parameters[0] if parameters else 0
    if code == Answer.PARAMETER:
        kind, text = _PARAMETERS.get(
            first, (ParameterRefused, f"the part rejects this instruction (error {first:02X})")
        )
        error = kind(first, text)
        error.number, error.echo = first, parameters[1:]
        return error
    if code == Answer.STATUS:
        if first:
            return UnexpectedInstruction(first)
        state, text = STATES.get(parameters[1], (AxisBusy, ""))
        return state(parameters[1], text)
    if code == Answer.LIMIT:
        return StartRefused(first, LIMIT)
    if code == Answer.COMMAND:
        return UnknownCommand(first)
    if code == Answer.SIZE:
        return InvalidBlockLength(first)
    if code == Answer.REGISTRATION:
        return RegistrationRefused(
            first,
            "this event is in use by its buffer: delete the buffer's instructions first"
            if first
            else "eight overrides are already waiting: wait until some of them are executed",
        )
    if code in (Answer.OVERRIDE_FAILED, Answer.EVENT_FAILED):
        reason = _FAILURES.get(first, f"reason {first:02X}")
        if code == Answer.OVERRIDE_FAILED:
            return OverrideFailed(first, f"an override was not executed ({reason}); the others are discarded")
        return EventFailed(first, f"an event's instruction was not executed ({reason}); its buffer is empty")
    if code == Answer.ALARM:
        return AlarmRaised(first, _ALARMS.get(first, f"alarm {first:02X}"))
    return None


if not TYPE_CHECKING:
    __getattr__ = renamed(
        __name__,
        {
            "BadBlock": "InvalidBlockLength",
            "OutOfTurn": "UnexpectedInstruction",
        },
    )
