"""Positions of the PPMC-312, interlock, and monitors that compare positions.

Rules: P312-MON-01..06, P312-OUT-03.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ...chip import Context, Phase
from ..codes import SPONTANEOUS, Answer
from ..front.responses import Responses, block
from ..timing import CoreTiming

_WRAP = (1 << 32) - 1
_LONG, _SHORT = 14, 4
"""Numbers of cycles until all comparisons are stable.

The first applies if at least one monitor is on, the second if both are off.
"""


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
        """Absolute value of POS - ENC; the difference is a signed 32-bit number."""
        difference = self.pulse - self.encoder & _WRAP
        return min(difference, _WRAP + 1 - difference)


@dataclass
class Interlock:
    """Interlock control: intlk_n is low until the pulse position reaches `position`.

    Attributes:
        on: True if the interlock control is active, so that intlk_n is low.
    """

    position: int = 0
    on: bool = False

    def arrives(self, position: int) -> bool:
        """Process the arrival at this position; return True if the interlock control ends here."""
        ends = self.on and position == self.position
        self.on = self.on and not ends
        return ends


class Monitor:
    """In-position or encode monitor.

    It sends reports of one class when the distance between POS and ENC enters or leaves a range.

    Attributes:
        enabled: bit EN of the status.
        out_of_range: True if the distance is out of range.
    """

    def __init__(self, kind: int, code: Answer, responses: Responses) -> None:
        self.kind, self._code, self._responses = kind, code, responses
        self.enabled = self.auto = self.clamps = False
        self.range = 0
        self.out_of_range = False
        self._reported = self._loaded_value = self._report_pending = False
        self.effective_range = 0
        self._report_from = self._evaluate_from = 0
        responses.live_content[kind] = self._block

    @property
    def outside(self) -> bool:
        """True if the distance is out of range; False while the monitor is off."""
        return self.enabled and self.out_of_range

    @property
    def _loaded(self) -> bool:
        loaded = self._responses.loaded
        return loaded is not None and loaded.kind == self.kind

    def _block(self) -> bytes:
        """Return the report of the change, even if the distance has changed again since (P312-RSP-22)."""
        self._loaded_value, self._report_pending = not self._reported, False
        return block(SPONTANEOUS, self._code, self._loaded_value)

    def set_up(self, t: int, flags: int, distance: int) -> None:
        """Execute instruction 02 or 03 with legal parameters."""
        self._responses.discard(self.kind)
        self.enabled, self.auto, self.clamps = bool(flags & 1), bool(flags & 2), bool(flags & 4)
        self.range, self.out_of_range, self._reported, self._report_pending = distance, False, False, False
        self._report_from, self._evaluate_from = t + 1, t + 2

    def clock(self, t: int, inside: bool, evaluate: bool) -> None:
        """Process one cycle (P312-RSP-22, P312-MON-05).

        Reports depend on the state before edge t.
        """
        if t < self._report_from:
            return
        out_of_range, enabled = self.out_of_range, self.enabled
        if enabled and evaluate and t >= self._evaluate_from:
            self.out_of_range = not inside
        if self._loaded:
            return
        changed = enabled and out_of_range != self._reported
        if not (changed or self._report_pending):
            self._responses.discard(self.kind)
        elif not self._responses.occupied(self.kind):
            self._responses.post(t, self.kind, [b""])
        if changed and not self.auto:
            self.enabled, self._report_pending = False, True

    def was_read(self, t: int) -> None:
        """Process the event that the host has read a report of this monitor."""
        self._reported = self._loaded_value
        self._report_from = t + 1


class WindowMonitors:
    """Both monitors, which compare both counters.

    Args:
        at_standstill: at_standstill() returns True if the pulse output is inactive.
        clamp: clamp() asserts zclmp_n (low).
        end_low: end_low() returns True if end_n is low.
    """

    def __init__(
        self,
        context: Context,
        core_timing: CoreTiming,
        counters: Counters,
        in_position: Monitor,
        encode: Monitor,
        at_standstill: Callable[[], bool],
        clamp: Callable[[], None],
        end_low: Callable[[], bool],
    ) -> None:
        self._queue, self._core_timing, self._counters = context.queue, core_timing, counters
        self.in_position, self.encode = in_position, encode
        self._at_standstill, self._clamp, self._end_low = at_standstill, clamp, end_low
        self._distances = [0] * core_timing.compare_lag
        self._inside = {in_position.kind: False, encode.kind: False}
        self._clamps, self._was_at_standstill, self._standstill_cycles = False, True, 0
        self._until = -1
        self._active = False

    def set_up(self, t: int, monitor: Monitor, flags: int, distance: int) -> None:
        """Execute instruction 02 or 03."""
        monitor.set_up(t, flags, distance)
        if monitor is self.in_position:
            self._standstill_cycles = -1
        self.evaluate(t)

    def evaluate(self, t: int) -> None:
        """Run the comparison after a change at edge t.

        The change may be a count, a new position, a setting, the end of the pulse output, or a change of
        end_n.
        """
        busy = self.in_position.enabled or self.encode.enabled
        self._until = max(self._until, t + (_LONG if busy else _SHORT))
        if not self._active:
            self._active = True
            self._queue.at(t, Phase.PIN, self._clock)

    def _clock(self, t: int) -> None:
        """Process one cycle of the comparison, while values change.

        The comparison uses the state before edge t.
        """
        position, encode = self.in_position, self.encode
        is_settled = self._standstill_cycles >= self._core_timing.standstill and self._was_at_standstill
        if (
            is_settled
            and self._clamps
            and self._at_standstill()
            and (self._inside[position.kind] or self._end_low())
        ):
            self._clamp()
        encode.clock(t, self._inside[encode.kind], True)
        position.clock(t, self._inside[position.kind], is_settled)
        self._standstill_cycles = (
            min(self._standstill_cycles + 1, self._core_timing.standstill)
            if self._was_at_standstill or self._standstill_cycles < 0
            else 0
        )
        self._clamps = position.enabled and position.clamps
        self._was_at_standstill = self._at_standstill()
        distance = self._distances.pop(0)
        self._distances.append(self._counters.distance)
        for monitor in (position, encode):
            self._inside[monitor.kind] = distance <= monitor.effective_range
            monitor.effective_range = monitor.range
        self._active = t < self._until
        if self._active:
            self._queue.at(t + 1, Phase.PIN, self._clock)

    def was_read(self, t: int, kind: int) -> None:
        """Process the read of the report E3 or E4."""
        for monitor in (self.in_position, self.encode):
            if monitor.kind == kind:
                monitor.was_read(t)
        self.evaluate(t)
