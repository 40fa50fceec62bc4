"""How a motion ended: finish status and remaining pulses, decoded, and what is raised for it. Pure."""

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
"""Values of a pulse counter."""
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


class EndUnknown(ProtocolError):
    """A motion is over, but the part does not confirm how it ended: it was reset, replaced, or moved by
    something else. The position is not reliable until the next homing.

    `finish`: the finish status that was read, None if the part has none or did not report one. `pulses`:
    counted since the start of the motion, CW positive, None if unknown. `asked`: pulses of the move, None for
    endless motions and for those of another program. `position`: the pulse counter now, None without one.
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
        """All pulses were made: no other cause, and no pulse is left."""
        return self.cause is Cause.COMPLETE and self.left == 0

    def check(self, asked: int | None = None) -> End:
        """Return the end itself if it is complete. Raises LimitReached, AlarmStop or StoppedEarly otherwise,
        and EndUnknown if nothing ended the motion, but the pulses are not those of the move.

        asked: pulses of the move, without a sign.
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
        """What to raise if it is not complete, and what to do about it."""
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
    """Decode finish status and remaining pulses (P104-RD-03, P104-END-04..06, P2104-END-04..06, STMC-FIN-01,
    -REM-01), if they confirm each other.

    total: pulses ordered, 2^24 for endless operations, None for a motion of another program. direction: 0 CW,
    1 CCW. operation: low three bits of the command code, None if unknown. moved: difference of the pulse
    counter since the start, None without a counter. where: begins the message of an error. Raises EndUnknown
    if bit 7 is 0, if the operation is none or another one, or if remaining pulses or pulse counter contradict
    the status.
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
        # The origin switch sets no bit; a search through all 2^24 pulses reads the same as one pulse less.
        searched_all = remaining == 0 and moved is not None and abs(moved) == total
        cause = Cause.COMPLETE if searched_all else Cause.ORIGIN
    left = remaining + 1 if cause else 0
    if (not cause and remaining) or (total is not None and left > total):
        raise unknown(f"finish status 0x{finish:02X} with {remaining} remaining pulses")
    made = None if total is None else (left - total if direction else total - left)
    if made is not None and moved is not None and (made - moved) % COUNTS:
        raise unknown(f"finish status 0x{finish:02X} says {abs(made)} pulses")
    return End(cause, made, left, position, finish)
