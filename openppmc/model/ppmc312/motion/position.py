"""Positions of the PPMC-312, interlock, and monitors that compare positions.

Rules: P312-MON-01..06, P312-OUT-03.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ...chip import Context, Phase
from ..codes import SPONTANEOUS, Answer
from ..front.responses import Responses, block
from ..timing import Pace

_WRAP = (1 << 32) - 1
_LONG, _SHORT = 14, 4
"""Cycles until all comparisons are stable, with a monitor on and off."""


@dataclass
class Counters:
    """POS and ENC, 0 .. 2^32 - 1."""

    pulse: int = 0
    encoder: int = 0

    def count_pulse(self, ccw: int) -> None:
        """Count one pulse: CW adds, CCW subtracts."""
        self.pulse = self.pulse + (-1 if ccw else 1) & _WRAP

    def count_encoder(self, ccw: int) -> None:
        """Count one encoder edge."""
        self.encoder = self.encoder + (-1 if ccw else 1) & _WRAP

    @property
    def distance(self) -> int:
        """Absolute value of POS - ENC, where the difference is a signed 32-bit number."""
        difference = self.pulse - self.encoder & _WRAP
        return min(difference, _WRAP + 1 - difference)


@dataclass
class Interlock:
    """Interlock.

    Attributes:
        on: True if the interlock control is running, so that intlk_n is low.
    """

    position: int = 0
    on: bool = False

    def arrives(self, position: int) -> bool:
        """Process a count to this position; return True if it ends the control."""
        ends = self.on and position == self.position
        self.on = self.on and not ends
        return ends


class Monitor:
    """In-position or encode monitor.

    It sends reports of one class when the distance enters or leaves a range.

    Attributes:
        enabled: bit EN of the status.
        far: True if the distance is out of range.
    """

    def __init__(self, kind: int, code: Answer, responses: Responses) -> None:
        self.kind, self._code, self._responses = kind, code, responses
        self.enabled = self.auto = self.clamps = False
        self.range = 0
        self.far = False
        self._told = self._shown = self._kept = False
        self.known_range = 0
        self._report_from = self._look_from = 0
        responses.fresh[kind] = self._block

    @property
    def outside(self) -> bool:
        """True if the distance is out of range; False while the monitor is off."""
        return self.enabled and self.far

    @property
    def _loaded(self) -> bool:
        loaded = self._responses.loaded
        return loaded is not None and loaded.kind == self.kind

    def _block(self) -> bytes:
        self._shown, self._kept = self.far, False
        return block(SPONTANEOUS, self._code, self._shown)

    def set_up(self, t: int, flags: int, distance: int) -> None:
        """Execute instruction 02 or 03 with legal parameters."""
        self._responses.withdraw(self.kind)
        self.enabled, self.auto, self.clamps = bool(flags & 1), bool(flags & 2), bool(flags & 4)
        self.range, self.far, self._told, self._kept = distance, False, False, False
        self._report_from, self._look_from = t + 1, t + 2

    def clock(self, t: int, inside: bool, evaluate: bool) -> None:
        """Process one cycle (P312-RSP-22, P312-MON-05).

        The reports depend on the state before edge t.
        """
        if t < self._report_from:
            return
        far, enabled = self.far, self.enabled
        if enabled and evaluate and t >= self._look_from:
            self.far = not inside
        if self._loaded:
            return
        news = enabled and far != self._told
        if not (news or self._kept):
            self._responses.withdraw(self.kind)
        elif not self._responses.occupied(self.kind):
            self._responses.post(t, self.kind, [b""])
        if news and not self.auto:
            self.enabled, self._kept = False, True

    def was_read(self, t: int) -> None:
        """Process the read of a report."""
        self._told = self._shown
        self._report_from = t + 1


class Watch:
    """Both monitors on both counters.

    at_rest(): returns True if the pulse output is inactive. clamp(): asserts zclmp_n (low). end_low():
    returns True if end_n is low.
    """

    def __init__(
        self,
        context: Context,
        pace: Pace,
        counters: Counters,
        in_position: Monitor,
        encode: Monitor,
        at_rest: Callable[[], bool],
        clamp: Callable[[], None],
        end_low: Callable[[], bool],
    ) -> None:
        self._queue, self._pace, self._counters = context.queue, pace, counters
        self.in_position, self.encode = in_position, encode
        self._at_rest, self._clamp, self._end_low = at_rest, clamp, end_low
        self._distances = [0] * pace.compare_lag
        self._inside = {in_position.kind: False, encode.kind: False}
        self._clamps, self._resting, self._quiet = False, True, 0
        self._until = -1
        self._awake = False

    def set_up(self, t: int, monitor: Monitor, flags: int, distance: int) -> None:
        """Execute instruction 02 or 03."""
        monitor.set_up(t, flags, distance)
        if monitor is self.in_position:
            self._quiet = -1
        self.look(t)

    def look(self, t: int) -> None:
        """Run the comparison after a change at edge t.

        The change is a count, a position, a setting, the end of the pulse output, or end_n.
        """
        busy = self.in_position.enabled or self.encode.enabled
        self._until = max(self._until, t + (_LONG if busy else _SHORT))
        if not self._awake:
            self._awake = True
            self._queue.at(t, Phase.PIN, self._clock)

    def _clock(self, t: int) -> None:
        """Process one cycle of the comparison, while values change.

        The comparison uses the state before edge t.
        """
        position, encode = self.in_position, self.encode
        quiet = self._quiet >= self._pace.quiet and self._resting
        if quiet and self._clamps and self._at_rest() and (self._inside[position.kind] or self._end_low()):
            self._clamp()
        encode.clock(t, self._inside[encode.kind], True)
        position.clock(t, self._inside[position.kind], quiet)
        self._quiet = min(self._quiet + 1, self._pace.quiet) if self._resting or self._quiet < 0 else 0
        self._clamps = position.enabled and position.clamps
        self._resting = self._at_rest()
        distance = self._distances.pop(0)
        self._distances.append(self._counters.distance)
        for monitor in (position, encode):
            self._inside[monitor.kind] = distance <= monitor.known_range
            monitor.known_range = monitor.range
        self._awake = t < self._until
        if self._awake:
            self._queue.at(t + 1, Phase.PIN, self._clock)

    def was_read(self, t: int, kind: int) -> None:
        """Process the read of E3 or E4."""
        for monitor in (self.in_position, self.encode):
            if monitor.kind == kind:
                monitor.was_read(t)
        self.look(t)
