"""Motion of a PPMC-312. The part reports the end of a motion without a request."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ...model.ppmc312.codes import SHAPES
from ...model.ppmc312.codes import Cause as Bit
from .. import motion as homing
from .. import part as device
from ..errors import Timeout
from ..motion import PROGRESS_POLL, SAFETY_POLL, AnyMotion, Handle, Progress
from ..motion_result import COUNTS, Cause, EndUnknown, MotionResult, OriginNotFound
from ..script import Identity
from ..speeds import Number
from .answers import Status, Stopped, signed

_CAUSES = {
    Bit.NORMAL: Cause.COMPLETE,
    Bit.STOP: Cause.STOP,
    Bit.SLOW: Cause.STOP,
    Bit.LOW: Cause.STOP,
    Bit.LIMIT: Cause.LIMIT,
    Bit.LIMIT_SLOW: Cause.SLOW_LIMIT,
    Bit.ORIGIN: Cause.ORIGIN,
    Bit.ALARM: Cause.ALARM,
}


class Transport(device.Transport, Protocol):
    """The transport to the part: the link of a bridge, or the master of a line."""

    @property
    def identity(self) -> Identity: ...
    def wait_event(self, timeout: float) -> int | None: ...
    def forget_events(self) -> None: ...


class ReportSource(Protocol):
    """The transport of reports from the part to its driver."""

    def collect(self) -> None: ...


class MotionAxis(Protocol):
    """Members of a part (`core.Core`) that a motion needs."""

    @property
    def _message_prefix(self) -> str: ...
    @property
    def link(self) -> Transport: ...
    @property
    def window(self) -> ReportSource: ...
    @property
    def position(self) -> int: ...

    _known_position: int

    def _may_poll(self) -> bool: ...
    def _position(self, encoder: bool) -> int: ...
    def status(self) -> Status: ...
    def _annotate(self, end: MotionResult) -> MotionResult: ...


class Motion(Handle):
    """Handle of a motion that was started; `result` is its result when it is known.

    Attributes:
        requested: pulses, `None` for endless motions.
        direction: 0 = CW, 1 = CCW.
        begin: position before the motion, `None` if another program started the motion.
        waited_for_run: True if the motion waited for RUN when it was started.
        shape: shape that the part reported for a move with ramps.
        stop_ordered: True if a stop was sent. If the part then reports that the motion ended by deceleration,
            the cause is this stop, not a slow-down limit.
    """

    requested: int | None
    direction: int
    begin: int | None
    waited_for_run = False
    shape = ""
    stop_ordered = False

    def __init__(self, part: MotionAxis, requested: int | None, direction: int, begin: int | None) -> None:
        self._part = part
        self._link = part.link
        self.requested = requested
        self.direction = direction
        self.begin = begin
        self._started = self._link.clock()

    def _on_start_response(self, status: int | None) -> None:
        """Process the response to the start.

        Args:
            status: status byte of the response, `None` if the response contains no status byte.
        """
        if status is not None:
            self.waited_for_run, self.shape = bool(status & 1), SHAPES.get(status & 0xF0, "")

    def _on_stop_report(self, report: Stopped) -> None:
        """Process the report that the motion has ended.

        The end is confirmed only if the position matches the number of requested pulses.
        """
        cause = _CAUSES[report.cause]
        if report.cause is Bit.LOW and not self.stop_ordered:
            cause = Cause.SLOW_LIMIT
        done, remaining = None, 0
        if self.begin is not None:
            done = signed((report.position - self.begin) % COUNTS)
        if done is not None and self.requested:
            ahead = (-done if self.direction else done) % COUNTS  # 0 to 2^32 - 1
            remaining = self.requested - ahead
            if remaining < 0 or (remaining and cause is Cause.COMPLETE):
                self._not_confirmed(
                    f"the part reports '{self._part._annotate(MotionResult(cause, 0, 0, 0, 0)).cause_text}'",
                    report,
                )
                return
            done = -ahead if self.direction else ahead
        elif self.begin is not None and cause is Cause.COMPLETE:
            self._not_confirmed("the part reports 'complete' for a motion without end", report)
            return
        self.result = self._part._annotate(
            MotionResult(cause, done, remaining, report.position, int(report.cause))
        )
        self._part._known_position = report.position

    def _not_confirmed(self, reason: str, report: Stopped | None = None) -> None:
        """Store that the motion is over, but that the report of its end is wrong or missing."""
        position = self._part._position(False) if report is None else report.position
        self._part._known_position = position
        done = None if self.begin is None else signed((position - self.begin) % COUNTS)
        where = f"{self._link.name}: {self._part._message_prefix}"
        finish = None if report is None else int(report.cause)
        self.result_error = EndUnknown(where, reason, finish, done, self.requested, position)

    def _update(self) -> None:
        """Poll the part; set `result` or `result_error` if the motion is over."""
        if self.over:
            return
        if not self._part._may_poll():
            self._part.window.collect()
            return
        busy = self._part.status().busy
        if not busy and not self.over:
            self._part.window.collect()
            if not self.over:
                self._not_confirmed("the part is at standstill and reported no end")

    def poll(self) -> Progress | None:
        """Return the current progress; `None` if the motor has stopped (then `result` is set).

        On a bus, the part misses an override or event that is triggered during this call, and stops with an
        alarm. `wait` has no such risk.

        Raises:
            EndUnknown: the motor has stopped, but the part does not confirm how the motion ended.
        """
        self._update()
        position = self._part._position(False)
        if self._confirmed_result() is not None:
            return None
        done = 0 if self.begin is None else abs(signed((position - self.begin) % COUNTS))
        return Progress(position, done, self.requested, self._link.clock() - self._started)

    def wait(
        self, timeout: float | None = None, progress: Callable[[Progress], None] | None = None
    ) -> MotionResult:
        """Wait for the end of the motion and return the result, also if the motion ended early.

        Args:
            timeout: longest wait in s, `None` for no limit.
            progress: called about ten times a second, but on a bus not while overrides or event buffers
                wait. An exception that it raises ends the wait; the motion continues.

        Raises:
            Timeout: the time limit is exceeded; the motion continues.
            EndUnknown: the part does not confirm how the motion ended.
        """
        limit = None if timeout is None else self._link.clock() + timeout
        pause = PROGRESS_POLL if progress else SAFETY_POLL
        while (end := self._confirmed_result()) is None:
            remaining = pause if limit is None else min(pause, limit - self._link.clock())
            if self._link.wait_event(max(0.0, remaining)) is not None:
                self._part.window.collect()
            elif progress is None or not self._part._may_poll():
                self._update()
            elif (now := self.poll()) is not None:
                progress(now)
            if not self.over and limit is not None and self._link.clock() >= limit:
                raise Timeout(
                    f"motion still in progress after {timeout:g} s; increase timeout or stop the motion"
                )
        return end


# Homing with a PPMC-312: an optional zero return, and then a search. The search always approaches the same
# edge of the switch from the same side.


class HomingAxis(homing.HomingAxis, Protocol):
    """Members of an axis that homing with a PPMC-312 needs."""

    def search(self, direction: int, pps: Number | None = None, index: bool = False) -> AnyMotion: ...
    def zero_return(self, direction: int, pps: Number | None = None, index: bool = False) -> AnyMotion: ...


class Homing(homing.Homing):
    """Homing run; see `Axis.home`.

    Args:
        index: True if a search ends at an index pulse of the encoder.
    """

    def __init__(
        self,
        axis: HomingAxis,
        direction: int,
        search_pps: Number | None,
        back_off: int,
        progress: Callable[[Progress], None] | None,
        index: bool,
    ) -> None:
        super().__init__(axis, direction, search_pps, back_off, progress)
        self._part = axis
        self._index = index

    def _search(self, direction: int) -> MotionResult:
        motion = self._part.search(direction, self._pps, self._index)
        return self._check_search(motion.wait(progress=self._progress))

    def _check_search(self, end: MotionResult) -> MotionResult:
        if end.cause & (Cause.LIMIT | Cause.SLOW_LIMIT):
            raise OriginNotFound(
                "a limit switch was reached before the origin"
                + (" with an index" if self._index else "")
                + ": home in the other direction, or check the switches",
                end,
            )
        return self._check_found(end)

    def _approach(self, to_limit: bool) -> None:
        if to_limit:
            super()._approach(True)
        else:
            self._check_search(self._part.zero_return(self._towards).wait(progress=self._progress))
