"""End of a motion, decoded from finish status and remaining pulses, and its exceptions. Pure."""

# ruff: noqa: N818

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Flag

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
"""Number of values of a pulse counter."""
ALARM_INPUT = ("alarm input", "clear the drive's alarm")
"""Name of the alarm input on parts that have one, and the advice for it."""


class MotionError(PpmcError):
    """A motion ended in another way than requested; `end` holds position and cause."""

    def __init__(self, message: str, end: End) -> None:
        super().__init__(message)
        self.end = end


class LimitReached(MotionError):
    """A hard limit or slow-down limit switch ended the motion."""


class AlarmStop(MotionError):
    """The alarm input ended the motion."""


class StoppedEarly(MotionError):
    """A stop command ended a motion before all its pulses were output."""


class OriginNotFound(MotionError):
    """Homing ended without the origin switch."""


class EndUnknown(ProtocolError):
    """A motion is over, but the part does not confirm how it ended.

    The part was reset, replaced, or moved by something else. The position is not reliable until the next
    homing.

    Attributes:
        finish: finish status that was read, `None` if the part has none or did not report one.
        pulses: counted since the start of the motion, CW positive, `None` if unknown.
        asked: pulses of the move, `None` for endless motions and for those of another program.
        position: current pulse counter, `None` without one.
    """

    def __init__(
        self,
        where: str,
        reason: str,
        finish: int | None = None,
        pulses: int | None = None,
        asked: int | None = None,
        position: int | None = None,
        unit: str = "pulses",
    ) -> None:
        self.finish, self.pulses, self.asked, self.position = finish, pulses, asked, position
        known = [reason]
        if pulses is not None:
            of = "" if asked is None else f" of {asked}"
            known.append(f"{abs(pulses)}{of} {unit} counted")
        if position is not None:
            known.append(f"position {position}")
        super().__init__(
            f"{where}the end of the motion is not confirmed ({', '.join(known)}); the part was reset, "
            "replaced or moved by something else: initialise it and home again"
        )


class Cause(Flag):
    """Cause of the end of a motion; several may coincide.

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
        return self.words(ALARM_INPUT[0])

    def words(self, alarm: str) -> str:
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
class End:
    """End of a motion.

    Attributes:
        pulses: pulses output, CW positive; `None` for a motion that another program started.
        left: pulses not output (of endless operations: of 2^24).
        position: pulse counter after the motion, `None` if the bridge has none.
        finish: finish status byte.
        who: message prefix, which names the axis if the part has several.
        alarm: name of the alarm input of the part, and the advice for it.
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
        """Cause as text."""
        return self.cause.words(self.alarm[0])

    @property
    def complete(self) -> bool:
        """True if all pulses were output: no other cause, and no pulse is left."""
        return self.cause is Cause.COMPLETE and self.left == 0

    def check(self, asked: int | None = None) -> End:
        """Return the end itself if the motion is complete.

        Args:
            asked: pulses of the move, without a sign.

        Raises:
            LimitReached, AlarmStop, StoppedEarly: something ended the motion.
            EndUnknown: nothing ended the motion, but the pulses are not those of the move.
        """
        if self.cause is Cause.COMPLETE:
            wrong = asked is not None and self.pulses is not None and abs(self.pulses) != asked
            if self.left or wrong:
                reason = f"no cause, {self.left} {self.unit} left"
                raise EndUnknown(self.who, reason, self.finish, self.pulses, asked, self.position, self.unit)
            return self
        where = "" if self.position is None else f" at position {self.position}"
        of = "" if asked is None else f" of {asked}"
        kind, advice = self.trouble()
        made = "" if self.pulses is None else f" after {abs(self.pulses)}{of} {self.unit}"
        raise kind(f"{self.who}{self.why} ended the motion{where}{made}: {advice}", self)

    def trouble(self) -> tuple[type[MotionError], str]:
        """Return exception class and advice for an end that is not complete."""
        if Cause.ALARM in self.cause:
            return AlarmStop, f"{self.alarm[1]}, then home again if steps may be lost"
        if self.cause & (Cause.LIMIT | Cause.SLOW_LIMIT):
            return LimitReached, "move away from the switch in the other direction"
        return StoppedEarly, "start again with the pulses that are left"


def decode_end(
    finish: int,
    remaining: int,
    total: int | None,
    direction: int,
    position: int | None,
    operation: int | None = None,
    moved: int | None = None,
    where: str = "",
) -> End:
    """Decode finish status and remaining pulses if they confirm each other.

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
        EndUnknown: bit 7 is 0, the operation does not exist or is another one, or the remaining pulses or the
            pulse counter contradict the status.
    """

    def unknown(reason: str) -> EndUnknown:
        asked = None if total == ENDLESS else total
        return EndUnknown(where, reason, finish, moved, asked, position)

    number = finish & 7
    if (
        not finish & FINISH_NEW
        or number < SINGLE_STEP
        or number != (number if operation is None else operation)
    ):
        raise unknown(f"finish status 0x{finish:02X}")
    cause = Cause(finish & _CAUSE_BITS)
    if not cause and number == ORIGIN:
        # The origin switch sets no bit. A search through all 2^24 pulses reads the same as one that ended a
        # pulse earlier.
        searched_all = remaining == 0 and moved is not None and abs(moved) == total
        cause = Cause.COMPLETE if searched_all else Cause.ORIGIN
    left = remaining + 1 if cause else 0
    if (not cause and remaining) or (total is not None and left > total):
        raise unknown(f"finish status 0x{finish:02X} with {remaining} remaining pulses")
    made = None if total is None else (left - total if direction else total - left)
    if made is not None and moved is not None and (made - moved) % COUNTS:
        raise unknown(f"finish status 0x{finish:02X} says {abs(made)} pulses")
    return End(cause, made, left, position, finish)
