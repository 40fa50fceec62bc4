"""Motion of a PPMC-312, whose end the part reports without a request."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ...model.ppmc312.codes import Cause as Bit
from .. import motion as homing
from .. import part as device
from ..ending import COUNTS, Cause, End, EndUnknown, OriginNotFound
from ..errors import Timeout
from ..motion import PROGRESS_POLL, SAFETY_POLL, AnyMotion, Handle, Progress
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
SHAPES = {0x00: "trapezoid", 0x10: "triangle", 0x20: "deceleration only", 0x40: "acceleration only"}


class Way(device.Way, Protocol):
    """Transport to the part: the link of a bridge, or a line."""

    @property
    def identity(self) -> Identity: ...
    def wait_event(self, timeout: float) -> int | None: ...
    def forget_events(self) -> None: ...


class Collecting(Protocol):
    """Transport of reports to the object of the part."""

    def collect(self) -> None: ...


class Moving(Protocol):
    """Members of a part (`core.Core`) that a motion needs."""

    @property
    def who(self) -> str: ...
    @property
    def link(self) -> Way: ...
    @property
    def window(self) -> Collecting: ...
    @property
    def position(self) -> int: ...
    def status(self) -> Status: ...
    def told(self, end: End) -> End: ...


class Motion(Handle):
    """Handle of a motion that was started; `end` is its End when it is known.

    Attributes:
        asked: pulses, `None` for endless motions.
        direction: 0 = CW, 1 = CCW.
        begin: position before the motion, `None` if another program started it.
        held: the motion waited for RUN when it was started.
        shape: shape that the part reported for a move with ramps.
        stop_ordered: a stop was sent, so it is the cause of an end below the stop speed.
    """

    asked: int | None
    direction: int
    begin: int | None
    held = False
    shape = ""
    stop_ordered = False

    def __init__(self, part: Moving, asked: int | None, direction: int, begin: int | None) -> None:
        self._part = part
        self._link = part.link
        self.asked = asked
        self.direction = direction
        self.begin = begin
        self._started = self._link.clock()

    def accepted(self, status: int | None) -> None:
        """Process the response to the start.

        Args:
            status: its status byte, `None` if the response contains none.
        """
        if status is not None:
            self.held, self.shape = bool(status & 1), SHAPES.get(status & 0xF0, "")

    def stopped(self, report: Stopped) -> None:
        """Process the report that the pulses have ended.

        The end is confirmed if the pulses are those of the order.
        """
        cause = _CAUSES[report.cause]
        if report.cause is Bit.LOW and not self.stop_ordered:
            cause = Cause.SLOW_LIMIT
        made, left = None, 0
        if self.begin is not None:
            made = signed((report.position - self.begin) % COUNTS)
        if made is not None and self.asked:
            ahead = (-made if self.direction else made) % COUNTS  # it may be more than half the counter range
            left = self.asked - ahead
            if left < 0 or (left and cause is Cause.COMPLETE):
                self._not_confirmed(
                    f"the part reports '{self._part.told(End(cause, 0, 0, 0, 0)).why}'", report
                )
                return
            made = -ahead if self.direction else ahead
        elif self.begin is not None and cause is Cause.COMPLETE:
            self._not_confirmed("the part reports 'complete' for a motion without end", report)
            return
        self.end = self._part.told(End(cause, made, left, report.position, int(report.cause)))

    def _not_confirmed(self, reason: str, report: Stopped | None = None) -> None:
        """Record that the motion is over, but its report is wrong or missing."""
        position = self._part.position if report is None else report.position
        made = None if self.begin is None else signed((position - self.begin) % COUNTS)
        where = f"{self._link.name}: {self._part.who}"
        finish = None if report is None else int(report.cause)
        self.unknown = EndUnknown(where, reason, finish, made, self.asked, position)

    def look(self) -> None:
        """Poll the part; set `end` or `unknown` if the motion is over."""
        if self.over:
            return
        busy = self._part.status().busy
        if not busy and not self.over:
            self._part.window.collect()
            if not self.over:
                self._not_confirmed("the part is at standstill and reported no end")

    def poll(self) -> Progress | None:
        """Return the current progress; `None` if the motor has stopped (then `end` is set).

        Raises:
            EndUnknown: the motor has stopped, but the part does not confirm how the motion ended.
        """
        self.look()
        position = self._part.position
        if self._confirmed() is not None:
            return None
        made = 0 if self.begin is None else abs(signed((position - self.begin) % COUNTS))
        return Progress(position, made, self.asked, self._link.clock() - self._started)

    def wait(self, timeout: float | None = None, progress: Callable[[Progress], None] | None = None) -> End:
        """Wait for the end and return it, for any cause.

        Args:
            timeout: longest wait in s, `None` for no limit.
            progress: called about ten times a second. An exception that it raises ends the wait; the motion
                continues.

        Raises:
            Timeout: the time is over; the motion continues.
            EndUnknown: the part does not confirm how the motion ended.
        """
        limit = None if timeout is None else self._link.clock() + timeout
        pause = PROGRESS_POLL if progress else SAFETY_POLL
        while (end := self._confirmed()) is None:
            left = pause if limit is None else min(pause, limit - self._link.clock())
            if self._link.wait_event(max(0.0, left)) is not None:
                self._part.window.collect()
            elif progress is None:
                self.look()
            elif (now := self.poll()) is not None:
                progress(now)
            if not self.over and limit is not None and self._link.clock() >= limit:
                raise Timeout(
                    f"motion still in progress after {timeout:g} s; increase timeout or stop the motion"
                )
        return end


# Homing with a PPMC-312. An optional zero return is followed by a search for the same edge from the same
# side.


class Searching(homing.Searching, Protocol):
    """Members of an axis that homing needs, including those of a PPMC-312 only."""

    def search(self, direction: int, pps: Number | None = None, index: bool = False) -> AnyMotion: ...
    def zero_return(self, direction: int, pps: Number | None = None, index: bool = False) -> AnyMotion: ...


class Homing(homing.Homing):
    """Homing run; see `Axis.home`.

    Args:
        index: True if searches end at an index of the encoder.
    """

    def __init__(
        self,
        axis: Searching,
        direction: int,
        search_pps: Number | None,
        back_off: int,
        progress: Callable[[Progress], None] | None,
        index: bool,
    ) -> None:
        super().__init__(axis, direction, search_pps, back_off, progress)
        self._part = axis
        self._index = index

    def _search(self, direction: int) -> End:
        motion = self._part.search(direction, self._pps, self._index)
        return self._judge(motion.wait(progress=self._progress))

    def _judge(self, end: End) -> End:
        if end.cause & (Cause.LIMIT | Cause.SLOW_LIMIT):
            raise OriginNotFound(
                "a limit switch came before the origin"
                + (" and its index" if self._index else "")
                + ": home in the other direction, or check the switch",
                end,
            )
        return self.found(end)

    def _approach(self, to_limit: bool) -> None:
        if to_limit:
            super()._approach(True)
        else:
            self._judge(self._part.zero_return(self._towards).wait(progress=self._progress))
