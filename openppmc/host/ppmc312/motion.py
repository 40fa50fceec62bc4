"""A motion of a PPMC-312 under way: the part reports its end by itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ...model.ppmc312.codes import Cause as Bit
from ..axis import device
from ..axis.motion import PROGRESS_POLL, SAFETY_POLL, Progress
from ..basis.arguments import Checked
from ..basis.ending import Cause, End
from ..basis.errors import ProtocolError, Timeout
from ..bridge.answer import Identity
from .answers import Stopped, signed
from .registers import Status

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
    """The way to the part: a bridge's link, or a line."""

    @property
    def identity(self) -> Identity: ...
    def wait_event(self, timeout: float) -> int | None: ...
    def forget_events(self) -> None: ...


class Collecting(Protocol):
    """The way of reports to the part's object."""

    def collect(self) -> None: ...


class Moving(Protocol):
    """What a motion needs of its part, which is a `core.Core`."""

    @property
    def link(self) -> Way: ...
    @property
    def window(self) -> Collecting: ...
    @property
    def position(self) -> int: ...
    def status(self) -> Status: ...
    def told(self, end: End) -> End: ...


class Motion(Checked):
    """Handle of an operation that was started; `end` is its End once it is known.

    asked: pulses, None for endless ones. direction: 0 CW, 1 CCW. begin: position before, None if another
    program started it. held: it waited for RUN when it was started; shape: what the part said of a move with
    ramps. stop_ordered: a stop was sent, so that an end below the stop speed is its work.
    """

    def __init__(self, part: Moving, asked: int | None, direction: int, begin: int | None) -> None:
        self._part = part
        self._link = part.link
        self.asked = asked
        self.direction = direction
        self.begin = begin
        self.held = False
        self.shape = ""
        self.stop_ordered = False
        self.end: End | None = None
        self._started = self._link.clock()

    def accepted(self, status: int | None) -> None:
        """The part has answered the start; status: its status byte, None if it gave none."""
        if status is not None:
            self.held, self.shape = bool(status & 1), SHAPES.get(status & 0xF0, "")

    def stopped(self, report: Stopped) -> None:
        """The part says that the pulses have ended."""
        cause = _CAUSES[report.cause]
        if report.cause is Bit.LOW and not self.stop_ordered:
            cause = Cause.SLOW_LIMIT
        made = None if self.begin is None else signed((report.position - self.begin) % (1 << 32))
        if made is not None and self.asked and cause is Cause.COMPLETE:
            made = -self.asked if self.direction else self.asked  # it may be more than half the counter
        left = 0 if made is None or self.asked is None else self.asked - abs(made)
        end = End(cause, made, left, report.position, int(report.cause))
        self.end = self._part.told(end)

    def poll(self) -> Progress | None:
        """Where the motor is now; None when it has come to rest (then `end` is set)."""
        position = self._part.position
        if self.end is not None:
            return None
        made = 0 if self.begin is None else abs(signed((position - self.begin) % (1 << 32)))
        return Progress(position, made, self.asked, self._link.clock() - self._started)

    def wait(self, timeout: float | None = None, progress: Callable[[Progress], None] | None = None) -> End:
        """Wait for the end, without judging it.

        timeout: s, None for ever; Timeout leaves the motion running. progress: called about ten times a
        second; what it raises ends the wait, and the motion goes on.
        """
        limit = None if timeout is None else self._link.clock() + timeout
        pause = PROGRESS_POLL if progress else SAFETY_POLL
        while self.end is None:
            left = pause if limit is None else min(pause, limit - self._link.clock())
            if self._link.wait_event(max(0.0, left)) is None:
                self._look(progress)
            else:
                self._part.window.collect()
            if self.end is None and limit is not None and self._link.clock() >= limit:
                raise Timeout(f"the motion is not over after {timeout:g} s: wait longer or stop it")
        return self.end

    def _look(self, progress: Callable[[Progress], None] | None) -> None:
        """Nothing has come for a while."""
        if progress is not None:
            now = self.poll()
            if now is not None:
                progress(now)
        elif not self._part.status().busy:
            self._part.window.collect()
            if self.end is None:
                raise ProtocolError(
                    f"{self._link.name}: the motion is over, but the part did not say how: was it reset?"
                )
