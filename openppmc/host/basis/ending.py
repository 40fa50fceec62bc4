"""How a motion ended: finish status and remaining pulses, decoded, and what is raised for it. Pure."""

# ruff: noqa: N818

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Flag

from ...model.motion.codes import FINISH_ALARM, FINISH_LIMIT, FINISH_SLOW, FINISH_STOP, ORIGIN
from .errors import PpmcError

ALARM_INPUT = ("alarm input", "clear the drive's alarm")
"""What that input is called where it is one, and what to do about it."""


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


class Cause(Flag):
    """Why a motion ended; several may meet. COMPLETE: all pulses were made."""

    COMPLETE = 0
    STOP = FINISH_STOP
    ALARM = FINISH_ALARM
    LIMIT = FINISH_LIMIT
    SLOW_LIMIT = FINISH_SLOW
    ORIGIN = 0x01

    def __str__(self) -> str:
        return self.words(ALARM_INPUT[0])

    def words(self, alarm: str) -> str:
        """What ended it; alarm: what the part calls that input."""
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
class End:
    """End of a motion.

    pulses: made, CW positive; None for a motion that another program started. left: pulses not made (of
    endless operations: of 2^24). position: pulse counter afterwards, None if the bridge has none. finish: the
    finish status byte. who, alarm: for messages, the axis of a part with several, and what the part calls its
    alarm input with what to do about it.
    """

    cause: Cause
    pulses: int | None
    left: int
    position: int | None
    finish: int
    who: str = field(default="", compare=False)
    alarm: tuple[str, str] = field(default=ALARM_INPUT, compare=False, repr=False)
    unit = "pulses"

    @property
    def why(self) -> str:
        """The cause in words."""
        return self.cause.words(self.alarm[0])

    @property
    def complete(self) -> bool:
        """All pulses were made."""
        return self.cause is Cause.COMPLETE

    def check(self, asked: int | None = None) -> End:
        """Itself if it is complete; otherwise raises LimitReached, AlarmStop or StoppedEarly."""
        if self.complete:
            return self
        where = "" if self.position is None else f" at position {self.position}"
        of = "" if asked is None else f" of {asked}"
        kind, advice = self.trouble()
        made = "" if self.pulses is None else f" after {abs(self.pulses)}{of} {self.unit}"
        raise kind(f"{self.who}{self.why} ended the motion{where}{made}: {advice}", self)

    def trouble(self) -> tuple[type[MotionError], str]:
        """What to raise if it is not complete, and what to do about it."""
        if Cause.ALARM in self.cause:
            return AlarmStop, f"{self.alarm[1]}, then home again if steps may be lost"
        if self.cause & (Cause.LIMIT | Cause.SLOW_LIMIT):
            return LimitReached, "move away from the switch in the other direction"
        return StoppedEarly, "start again with the pulses that are left"


def decode_end(finish: int, remaining: int, total: int | None, direction: int, position: int | None) -> End:
    """From finish status and remaining pulses (P104-END-04..06, STMC-FIN-01, -REM-01).

    total: pulses asked for, 2^24 for endless operations, None if nobody knows. direction: 0 CW, 1 CCW.
    """
    cause = Cause(finish & _CAUSE_BITS)
    left = remaining + 1 if cause else 0
    if not cause and finish & 7 == ORIGIN:
        # The origin switch sets no bit; only a search through all 2^24 pulses would read the same.
        cause, left = Cause.ORIGIN, remaining + 1
    made = None if total is None else (left - total if direction else total - left)
    return End(cause, made, left, position, finish)
