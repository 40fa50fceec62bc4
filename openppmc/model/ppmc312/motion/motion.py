"""Timing of the pulse output of the PPMC-312: t0, intervals, pulse shape, immediate ends.

Rules: P312-MOT-01..07, -34. `sequence` determines the rate of each pulse; `operation` contains all other
functions of an operation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ...chip import Context, Phase
from ...clock import Event
from ..codes import IMMEDIATE, Cause
from ..stages import DIVIDERS, Plan
from ..timing import CoreTiming
from .sequence import Change, Sequence

LIMITS, SLOW_LIMITS = ("fl_n", "bl_n"), ("fhl_n", "bhl_n")


@dataclass(slots=True)
class MotionRequest:
    """A request of an operation.

    Attributes:
        target: rate that is compared with the high-speed limit before the start.
        origin: True if the operation ends at the origin.
        reverses_at_origin: True in phase 1 of a zero return.
        index: True if the origin also requires an index (index_n).
    """

    plan: Plan
    direction: int
    target: int
    origin: bool = False
    reverses_at_origin: bool = False
    index: bool = False


class Motion:
    """The pulse output of the part.

    Args:
        pins: levels of the guarded inputs for decisions.
        speed_limit: returns HSL.
        on_count: on_count(t, direction) is called when POS counts a pulse.
        on_compare: on_compare(t, direction) is called when POS is compared. It returns True if an override
            stops the pulses at this position (P312-OVR-12).
        overrides_done: see `Operation`.
        on_end: on_end(t, cause) is called when the pulse output has ended, or with Cause.RETURN after phase 1
            of a zero return.
    """

    def __init__(
        self,
        context: Context,
        core_timing: CoreTiming,
        pins: Mapping[str, int],
        speed_limit: Callable[[], int],
        on_count: Callable[[int, int], None],
        on_compare: Callable[[int, int], bool],
        overrides_done: Callable[[], bool],
        on_end: Callable[[int, Cause], None],
    ) -> None:
        self._context, self._core_timing, self._pins = context, core_timing, pins
        self._speed_limit, self._on_count, self._on_compare = speed_limit, on_count, on_compare
        self._overrides_done, self._on_end = overrides_done, on_end
        self.active = False
        self.direction = self.pout = 0
        self._ended: Cause | None = None
        self._standstill_from = 0
        self._at_position = False
        self._requested_causes: set[Cause] = set()
        self._events: dict[str, Event] = {}
        self._changes: list[tuple[int, Event]] = []

    # ------------------------------------------------------------------ start

    def start(self, t: int, request: MotionRequest) -> None:
        """Process t0 (P312-MOT-01)."""
        self.active, self.direction, self.request = True, request.direction, request
        self.sequence = Sequence(request.plan)
        self._requested_causes.clear()
        self._changes.clear()
        self._ended, self._at_position = None, False
        self._slow_from: int | None = None
        self._limit, self._limit_before, self._limit_at = False, False, t
        self._began = self._const_rate_from = t
        clk = request.plan.table.clk
        self._divider = DIVIDERS.get(clk)
        first = t + self._context.timebase.w
        self._armed_from = first
        if self._divider is not None:
            self._next_boundary = first
            self._events["pulse"] = self._context.queue.at(first, Phase.PULSE, self._pulse)
        self.schedule_check(t + 1)
        self.schedule_check(t + self._core_timing.limit_from)

    @property
    def next_boundary(self) -> int | None:
        """Edge of the next boundary between two intervals, `None` if it is unknown."""
        return self._next_boundary if self.active and self._divider is not None else None

    @property
    def busy(self) -> bool:
        """True while the pulse output is active: more pulses may follow, or the last pulse has not ended."""
        return self.active or self._ended is not None

    @property
    def in_table(self) -> bool:
        """True in state ACC, False in FIX."""
        return self.busy and self.sequence.in_table

    # ------------------------------------------------------------------ requests

    def schedule_check(self, t: int) -> None:
        """Schedule a check of the inputs at edge t."""
        self._context.queue.at(t, Phase.GUARD, self._check_causes)

    def stop(self, t: int, cause: Cause) -> None:
        """Process an immediate stop by instruction 80 or by an alarm (P312-MOT-34)."""
        if self.active:
            self._requested_causes.add(cause)
            self.schedule_check(t)
        elif self._ended is Cause.RETURN:
            self._replace_cause(t, cause)
        elif cause is Cause.ALARM and self._at_position and self._ended is Cause.STOP:
            self._replace_cause(t, cause)
        if cause is Cause.ALARM:
            # After an alarm, a stop at a position no longer waits for the released instructions.
            self._context.queue.at(t + 1, Phase.BEGIN, self.check_standstill)

    def slow_stop(self, t: int) -> None:
        """Process instruction 81 (P312-MOT-30)."""
        if self.active:
            sequence = self.sequence
            self._slow_from = t + 1
            self.schedule_check(t + 1)
            self._flag(t + self._core_timing.slow_lead, lambda at: sequence.request(Cause.SLOW))
        elif self._ended is Cause.RETURN:
            self._replace_cause(t, Cause.LOW)

    def _replace_cause(self, t: int, cause: Cause) -> None:
        """Replace the cause of an end.

        The new cause is a stop between the two phases of a zero return, or an alarm that follows a stop at a
        position.
        """
        self._ended = cause
        self._standstill_at(t + 1)

    def change(self, t: int, change: Change) -> None:
        """Process instruction 87 or 88."""
        if self.active:
            sequence, lead = (
                self.sequence,
                self._core_timing.ramp_lead if change.ramp else self._core_timing.change_lead,
            )
            # A pending change is discarded before the new change takes effect.
            self._flag(t + self._core_timing.drop_lead, lambda at: sequence.drop_change())
            self._changes.append((t, self._flag(t + lead, lambda at: sequence.change(change))))
            if change.ramp:
                announced = self._flag(
                    t + self._core_timing.change_lead, lambda at: sequence.announce_change()
                )
                self._changes.append((t, announced))

    def _flag(self, t: int, action: Callable[[int], None]) -> Event:
        return self._context.queue.at(t, Phase.FLAG, action)

    def _check_causes(self, t: int) -> None:
        if not self.active or t <= self._began:
            return
        pins, request, direction = self._pins, self.request, self.direction
        at_origin = request.origin and not pins["org_n"] and not (request.index and pins["index_n"])
        causes, self._requested_causes = self._requested_causes, set()
        causes |= {Cause.LIMIT} if not pins[LIMITS[direction]] else set()
        causes |= {Cause.ORIGIN} if at_origin and not request.reverses_at_origin else set()
        if causes:
            self._end(t, next(cause for cause in IMMEDIATE if cause in causes))
            return
        self._check_slow_limit(t, not pins[SLOW_LIMITS[direction]])
        reverses = at_origin and request.reverses_at_origin
        if self.sequence.running is None:
            slow = self._limit_before or (self._slow_from is not None and self._slow_from <= t)
            if slow or reverses:
                self._end(t, Cause.LOW if slow else Cause.RETURN)
        elif reverses:
            sequence = self.sequence
            self._flag(t + self._core_timing.origin_lead, lambda at: sequence.request(Cause.RETURN))

    def _check_slow_limit(self, t: int, low: bool) -> None:
        """Process the high-speed limit, which is a level (P312-INP-12).

        The limit affects boundaries that are at least `lead` cycles later.
        """
        if t > self._limit_at:
            self._limit_before, self._limit_at = self._limit, t
        limit = low and t >= self._began + self._core_timing.limit_from
        limit = limit and self.sequence.present.rate <= self._speed_limit()
        if limit != self._limit:
            self._limit = limit
            sequence = self.sequence
            self._flag(t + self._core_timing.lead, lambda at: sequence.limit_level(limit))
            self.schedule_check(t + 1)

    # ------------------------------------------------------------------ end

    def _end(self, t: int, cause: Cause) -> None:
        """End the pulse output: no pulse begins from edge t on (P312-MOT-06, -34)."""
        self._ended = Cause.NORMAL if self.sequence.complete else cause
        self.active = False
        self._cancel("pulse")
        if not self.pout:
            self._standstill_at(t + self._core_timing.rest)

    def _standstill_at(self, t: int) -> None:
        self._standstill_from = t
        self._context.queue.at(t, Phase.BEGIN, self.check_standstill)

    def schedule_standstill_check(self, t: int) -> None:
        """Schedule a check, because a stop at a position may be complete at edge t."""
        if self._at_position and self._ended is not None:
            self._context.queue.at(t + 1, Phase.BEGIN, self.check_standstill)

    def check_standstill(self, t: int) -> None:
        """End the motion if the last pulse has ended and a stop at a position is complete."""
        cause = self._ended
        if (
            cause is None
            or self.pout
            or t < self._standstill_from
            or (self._at_position and not self._overrides_done())
        ):
            return
        self._ended = None
        self._on_end(t, cause)

    # ------------------------------------------------------------------ pulses

    def tick(self, t: int) -> None:
        """Process a counted edge of EXTCK (P312-MOT-02)."""
        if self._ended is None and not self.active or self._divider is not None:
            return
        running = self.sequence.running
        if running is None:
            if t >= self._armed_from:
                self._pulse(t)
            return
        self._ticks += 1
        if self.pout and self._ticks == running.rate // 2:
            self._low_at(t)
        if self._ticks == running.rate and self.active:
            boundary = max(t, self._risen + self._core_timing.least)
            self._events["pulse"] = self._context.queue.at(boundary, Phase.BASE, self._pulse)

    def _pulse(self, t: int) -> None:
        """Process the boundary between two intervals at edge t: output the next pulse, or end."""
        if not self.active:
            return
        sequence, constant = self.sequence, not self.sequence.in_table
        const_rate_cycles = t - self._const_rate_from - self._core_timing.search * sequence.was_searched
        step = sequence.boundary(
            const_rate_cycles >= self._core_timing.const_rate_lead,
            const_rate_cycles >= self._core_timing.slow_lead,
        )
        if isinstance(step, Cause):
            self._end(t, step)
            return
        # If the sequence has discarded its waiting change or begins a deceleration, cancel the changes that
        # were requested early enough for this boundary.
        lead = 1 if sequence.decel_begins else self._core_timing.change_lead
        if sequence.decel_begins or sequence.change_dropped:
            for since, event in self._changes:
                if since + lead <= t:
                    event.cancel()
        if step.stage is None and not constant:
            self._const_rate_from = t
        self.pout = 1
        self._ticks, self._risen = 0, t
        self._low_at(t + self._context.timebase.w)
        if self._divider is not None:
            self._plan_interval(t, step.rate, self._divider)
        self._context.queue.at(t + self._core_timing.count, Phase.PULSE, self._count)
        self._context.queue.at(t + self._core_timing.compare, Phase.PULSE, self._compare)
        self.schedule_check(t + 1)

    def _count(self, t: int) -> None:
        self._on_count(t, self.direction)

    def _compare(self, t: int) -> None:
        if self._on_compare(t, self.direction):
            self._context.queue.at(t + 1, Phase.RUN - 2, self._stop_at_position)

    def _stop_at_position(self, t: int) -> None:
        """Process the position at which a registered instruction 80 stops the pulses (P312-OVR-12)."""
        if not self.busy or self.sequence.complete:
            return
        self._at_position = True
        if self.active:
            self._requested_causes.add(Cause.STOP)
            self._check_causes(t)

    def _plan_interval(self, t: int, rate: int, divider: int) -> None:
        """Schedule the falling edge of pout and the next boundary.

        Both are aligned to the prescaler, which pulse 1 has restarted.
        """
        timebase = self._context.timebase
        if self.sequence.done == 1:
            self._origin = t
        tick = (t - self._origin) * timebase.xtal_hz // (divider * timebase.clk_hz)

        def edge(number: int) -> int:
            return self._origin + timebase.cyc(divider * number)

        self._low_at(min(t + timebase.w, edge(tick + rate // 2)))
        boundary = self._next_boundary = max(edge(tick + rate), t + self._core_timing.least)
        self._events["pulse"] = self._context.queue.at(boundary, Phase.PULSE, self._pulse)

    def _low_at(self, t: int) -> None:
        self._cancel("low")
        self._events["low"] = self._context.queue.at(t, Phase.LOW_END, self._low)

    def _low(self, t: int) -> None:
        self.pout = 0
        if self._ended is not None:
            self._standstill_at(t + self._core_timing.rest)

    def _cancel(self, name: str) -> None:
        event = self._events.pop(name, None)
        if event:
            event.cancel()
