"""Motion of a PMC006B4. The driver detects its end from the status."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from .. import motion_result
from ..line import wait_all
from ..motion import Handle, Progress
from ..motion_result import AlarmStop, Cause, EndUnknown, LimitReached, MotionError, StoppedByCommand
from .settings import Settings
from .station_link import Line
from .wire import Code, Flags


class MotionResult(motion_result.MotionResult):
    """Result of a motion. LIMIT means EXT1 or EXT2, ALARM means a stall.

    `finish` is status 1 at the end.
    """

    unit = "steps"

    def with_position(self, position: int) -> MotionResult:
        """Return the same result with another position."""
        return replace(self, position=position)

    @property
    def cause_text(self) -> str:
        flags = Flags.parse(self.finish)
        words = [f"EXT{number}" for number in flags.stops] if Cause.LIMIT in self.cause else []
        words += ["stall"] if Cause.ALARM in self.cause else []
        words += ["stop command"] if Cause.STOP in self.cause else []
        return " and ".join(words) or "complete"

    def error_and_advice(self) -> tuple[type[MotionError], str]:
        if Cause.LIMIT in self.cause:
            return LimitReached, "clear the flag (clear_stops, reset-flags), then move off the switch"
        if Cause.ALARM in self.cause:
            return AlarmStop, "remove what blocks the motor, then home again: steps are lost"
        return StoppedByCommand, "start again with the steps that are left"


class Motion(Handle):
    """Handle of a motion that was started; `result` is its result when it is known.

    Attributes:
        requested: steps, `None` for free runs.
        direction: 1 = forward, -1 = backward.
        begin: position before the motion.
        stop_ordered: True if a stop was sent.
    """

    result: MotionResult | None = None
    requested: int | None
    direction: int
    begin: int | None
    stop_ordered = False

    def __init__(self, part: Settings, requested: int | None, direction: int, begin: int | None) -> None:
        self._part = part
        self.requested, self.direction, self.begin = requested, direction, begin
        self._started = part.line.clock()
        self._abort: tuple[float, int] | None = None

    @property
    def line(self) -> Line:
        """Line of the controller."""
        return self._part.line

    @property
    def station(self) -> int:
        """Address of the controller."""
        return self._part.address

    def _abort_after(self, seconds: float, top: int) -> None:
        """Let `_update` abort the motion after some seconds, and then set the maximum speed to `top`.

        The caller has lowered the maximum speed from `top`, so that the motor decelerates before the motion
        is aborted.
        """
        self._abort = self.line.clock() + seconds, top

    def _update(self) -> None:
        """Poll the controller; set `result` or `result_error` if the motion is over."""
        flags = self._part.flags()
        if flags.busy and self._abort is not None and self.line.clock() >= self._abort[0]:
            self._part.execute(Code.ABORT, good=lambda value: value == 0)
            flags = self._part.flags()
        if not flags.busy:
            self._finish(flags)

    def _finish(self, flags: Flags) -> None:
        if self._abort is not None:
            self._part.max_speed = self._abort[1]
            self._abort = None
        position = self._part._known_position = self._part._read_position()
        done = None if self.begin is None else _signed(position - self.begin)
        remaining = 0 if self.requested is None or done is None else self.requested - self.direction * done
        whole = self.requested is not None and done is not None and remaining == 0
        cause = Cause.COMPLETE if whole else self._cause(flags)
        raw = flags.ext1 << 1 | flags.ext2 << 2 | flags.auto_decay << 3 | flags.stall << 4
        possible = self.requested is None or done is None or 0 <= remaining <= self.requested
        if cause is None or not possible or (position == 0 and self._part.was_reset()):
            reason = f"status 1 is 0x{raw:02X}"
            where = f"{self._part.line.name}: {self._part._message_prefix}"
            self.result_error = EndUnknown(
                where, reason, raw, done, self.requested, position, MotionResult.unit
            )
        else:
            self.result = MotionResult(cause, done, remaining, position, raw, self._part._message_prefix)

    def _cause(self, flags: Flags) -> Cause | None:
        """Return the cause of an early end, `None` if no known cause applies."""
        if flags.stops:
            return Cause.LIMIT
        if flags.stall and not self.stop_ordered:
            return Cause.ALARM
        return Cause.STOP if self.stop_ordered else None

    def _current_progress(self) -> Progress:
        """Return the current progress; after the end of the motion, the progress at its end."""
        position = self._part.position if self.result is None else self.result.position or 0
        done = 0 if self.begin is None else abs(_signed(position - self.begin))
        return Progress(position, done, self.requested, self.line.clock() - self._started)

    def poll(self) -> Progress | None:
        """Return the current progress; `None` if the motor has stopped (then `result` is set).

        Raises:
            EndUnknown: the motor has stopped, but the controller does not confirm how the motion ended.
        """
        if not self.over:
            self._update()
        return self._current_progress() if self._confirmed_result() is None else None

    def wait(
        self, timeout: float | None = None, progress: Callable[[Progress], None] | None = None
    ) -> MotionResult:
        """Wait for the end of the motion and return the result; see `host.line.wait_all`."""
        wait_all([self], timeout, progress)
        assert self.result is not None
        return self.result


def _signed(steps: int) -> int:
    """Return the signed difference of two positions; positions are numbers modulo 2^32."""
    return (steps + (1 << 31)) % (1 << 32) - (1 << 31)
