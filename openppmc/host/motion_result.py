"""Result of a motion, decoded from finish status and remaining pulses, and its exceptions. Pure."""

# ruff: noqa: N818

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Flag
from typing import TYPE_CHECKING

from ..lazy import Renamed, renamed
from ..model.motion.codes import (
    ENDLESS,
    FINISH_ALARM,
    FINISH_LIMIT,
    FINISH_NEW,
    FINISH_SLOW,
    FINISH_STOP,
    ORIGIN,
    SINGLE_STEP,
)
from .errors import PpmcError, ProtocolError

COUNTS = 1 << 32
"""Number of different values of a pulse counter."""
ALARM_INPUT = ("alarm input", "clear the drive's alarm")
"""Name of the alarm input on parts that have one, and the advice in its message."""


class MotionError(PpmcError):
    """A motion did not end as requested; `result` holds position and cause."""

    end = Renamed("result")

    def __init__(self, message: str, result: MotionResult) -> None:
        super().__init__(message)
        self.result = result


class LimitReached(MotionError):
    """A hard limit or slow-down limit switch ended the motion."""


class AlarmStop(MotionError):
    """The alarm input ended the motion."""


class StoppedByCommand(MotionError):
    """A stop command ended a motion before all its pulses were output."""


class OriginNotFound(MotionError):
    """Homing did not find the origin."""


class EndUnknown(ProtocolError):
    """A motion is over, but the part does not confirm how it ended.

    The part was reset or replaced, or another program moved the motor. The position is not reliable until the
    next homing.

    Attributes:
        finish: finish status that was read, `None` if the part has no such status or did not report it.
        pulses: pulses counted since the start of the motion, CW positive, `None` if unknown.
        requested: pulses of the move, `None` for endless motions and for motions of another program.
        position: current value of the pulse counter, `None` without a counter.
    """

    asked = Renamed("requested")

    def __init__(
        self,
        where: str,
        reason: str,
        finish: int | None = None,
        pulses: int | None = None,
        requested: int | None = None,
        position: int | None = None,
        unit: str = "pulses",
    ) -> None:
        self.finish, self.pulses, self.requested, self.position = finish, pulses, requested, position
        known = [reason]
        if pulses is not None:
            of = "" if requested is None else f" of {requested}"
            known.append(f"{abs(pulses)}{of} {unit} counted")
        if position is not None:
            known.append(f"position {position}")
        super().__init__(
            f"{where}the end of the motion is not confirmed ({', '.join(known)}); the part was reset, "
            "replaced or moved by something else: initialise it and home again"
        )


def position_lost(where: str, known: int | None) -> ProtocolError:
    """Return the exception for a part whose position a reset has set to 0.

    Args:
        where: prefix of the message.
        known: last known position.
    """
    return ProtocolError(
        f"{where}the position was {known} and now reads 0, because the part was reset or lost its power: "
        "initialise it and home again"
    )


class Cause(Flag):
    """Causes of the end of a motion; several may apply.

    Attributes:
        COMPLETE: all pulses were output.
    """

    COMPLETE = 0
    STOP = FINISH_STOP
    ALARM = FINISH_ALARM
    LIMIT = FINISH_LIMIT
    SLOW_LIMIT = FINISH_SLOW
    ORIGIN = 0x01

    def __str__(self) -> str:
        return self.describe(ALARM_INPUT[0])

    def describe(self, alarm: str) -> str:
        """Return the cause as text.

        Args:
            alarm: name of the alarm input of the part.
        """
        words = [alarm if cause is Cause.ALARM else text for cause, text in _WORDS.items() if cause in self]
        return " and ".join(words) or "complete"


_WORDS = {
    Cause.STOP: "stop command",
    Cause.ALARM: ALARM_INPUT[0],
    Cause.LIMIT: "limit switch",
    Cause.SLOW_LIMIT: "slow-down limit",
    Cause.ORIGIN: "origin switch",
}
_CAUSE_BITS = FINISH_STOP | FINISH_ALARM | FINISH_LIMIT | FINISH_SLOW


@dataclass(frozen=True)
class MotionResult:
    """Result of a motion.

    Attributes:
        pulses: pulses output, CW positive; `None` for a motion that another program started.
        remaining: pulses not output; an endless operation is treated as 2^24 pulses.
        position: value of the pulse counter after the motion, `None` if the bridge has no counter.
        finish: finish status byte.
        message_prefix: prefix of messages, which names the axis if the part has several.
        alarm: name of the alarm input of the part, and the advice in the message about an alarm.
    """

    cause: Cause
    pulses: int | None
    remaining: int
    position: int | None
    finish: int
    message_prefix: str = field(default="", compare=False)
    alarm: tuple[str, str] = field(default=ALARM_INPUT, compare=False, repr=False)
    unit = "pulses"
    left = Renamed("remaining")

    @property
    def cause_text(self) -> str:
        """Cause of the end as text."""
        return self.cause.describe(self.alarm[0])

    @property
    def complete(self) -> bool:
        """True if all pulses were output: no other cause ended the motion, and no pulses remain."""
        return self.cause is Cause.COMPLETE and self.remaining == 0

    def check(self, requested: int | None = None) -> MotionResult:
        """Return this result if the motion is complete, else raise an exception.

        Args:
            requested: pulses of the move, without a sign.

        Raises:
            LimitReached, AlarmStop, StoppedByCommand: a limit, the alarm or a stop ended the motion.
            EndUnknown: no cause ended the motion, but the number of pulses is not the requested one.
        """
        if self.cause is Cause.COMPLETE:
            wrong = requested is not None and self.pulses is not None and abs(self.pulses) != requested
            if self.remaining or wrong:
                reason = f"no cause, {self.remaining} {self.unit} left"
                raise EndUnknown(
                    self.message_prefix, reason, self.finish, self.pulses, requested, self.position, self.unit
                )
            return self
        where = "" if self.position is None else f" at position {self.position}"
        of = "" if requested is None else f" of {requested}"
        kind, advice = self.error_and_advice()
        moved_pulses = "" if self.pulses is None else f" after {abs(self.pulses)}{of} {self.unit}"
        raise kind(
            f"{self.message_prefix}{self.cause_text} ended the motion{where}{moved_pulses}: {advice}", self
        )

    def error_and_advice(self) -> tuple[type[MotionError], str]:
        """Return exception class and advice for a motion that ended early."""
        if Cause.ALARM in self.cause:
            return AlarmStop, f"{self.alarm[1]}, then home again if steps may be lost"
        if self.cause & (Cause.LIMIT | Cause.SLOW_LIMIT):
            return LimitReached, "move away from the switch in the other direction"
        return StoppedByCommand, "start again with the pulses that are left"


def decode_end(
    finish: int,
    remaining: int,
    total: int | None,
    direction: int,
    position: int | None,
    operation: int | None = None,
    moved: int | None = None,
    where: str = "",
) -> MotionResult:
    """Decode finish status and remaining pulses if they are consistent.

    Rules: P104-RD-03, P104-END-04..06, P2104-END-04..06, STMC-FIN-01, STMC-REM-01.

    Args:
        finish: finish status byte.
        remaining: remaining-pulse register.
        total: requested pulses, 2^24 for endless operations, `None` for a motion of another program.
        direction: 0 = CW, 1 = CCW.
        position: pulse counter after the motion, `None` without a counter.
        operation: lowest three bits of the command code, `None` if unknown.
        moved: difference of the pulse counter since the start, `None` without a counter.
        where: prefix of an error message.

    Raises:
        EndUnknown: bit 7 of the finish status is 0, the finish status names another operation than
            `operation`, or the remaining pulses or the pulse counter contradict the finish status.
    """

    def unknown(reason: str) -> EndUnknown:
        requested = None if total == ENDLESS else total
        return EndUnknown(where, reason, finish, moved, requested, position)

    number = finish & 7
    if (
        not finish & FINISH_NEW
        or number < SINGLE_STEP
        or number != (number if operation is None else operation)
    ):
        raise unknown(f"finish status 0x{finish:02X}")
    cause = Cause(finish & _CAUSE_BITS)
    if not cause and number == ORIGIN:
        # The origin switch sets no bit. The registers have the same values after a search that output all
        # 2^24 pulses and after a search that the switch ended one pulse earlier.
        searched_all = remaining == 0 and moved is not None and abs(moved) == total
        cause = Cause.COMPLETE if searched_all else Cause.ORIGIN
    pulses_left = remaining + 1 if cause else 0
    if (not cause and remaining) or (total is not None and pulses_left > total):
        raise unknown(f"finish status 0x{finish:02X} with {remaining} remaining pulses")
    moved_pulses = None if total is None else (pulses_left - total if direction else total - pulses_left)
    if moved_pulses is not None and moved is not None and (moved_pulses - moved) % COUNTS:
        raise unknown(f"finish status 0x{finish:02X} says {abs(moved_pulses)} pulses")
    return MotionResult(cause, moved_pulses, pulses_left, position, finish)


if not TYPE_CHECKING:
    __getattr__ = renamed(
        __name__,
        {
            "End": "MotionResult",
            "StoppedEarly": "StoppedByCommand",
        },
    )
