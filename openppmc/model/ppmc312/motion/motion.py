"""Pulse output of the PPMC-312 in time: t0, intervals, pulse shape, immediate ends.

Rules: P312-MOT-01..07, -34. `sequence` has the rate of each pulse, `operation` the rest of an operation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from ...chip import Context, Phase
from ...clock import Event
from ..codes import IMMEDIATE, Cause
from ..stages import DIVIDERS, Plan
from ..timing import Pace
from .sequence import Change, Sequence

LIMITS, SLOW_LIMITS = ("fl_n", "bl_n"), ("fhl_n", "bhl_n")


@dataclass(slots=True)
class Order:
    """Order of an operation.

    Attributes:
        target: rate that the start check compares with the high-speed limit.
        origin: True if the operation ends at the origin.
        turns: True in phase 1 of a zero return.
        index: True if the origin also requires an index (index_n).
    """

    plan: Plan
    direction: int
    target: int
    origin: bool = False
    turns: bool = False
    index: bool = False


class Motion:
    """Pulse output.

    Args:
        pins: levels of the guarded inputs for decisions.
        speed_limit: returns HSL.
        on_count: on_count(t, direction) is called when POS counts a pulse.
        on_compare: on_compare(t, direction) is called when POS is compared; True means a stop at this
            position (P312-OVR-12).
        settled: settled() returns True if everything that such a stop waits for is done.
        on_end: on_end(t, cause) is called when the pulse output has ended, or with Cause.RETURN after phase 1
            of a zero return.
    """

    def __init__(
        self,
        context: Context,
        pace: Pace,
        pins: Mapping[str, int],
        speed_limit: Callable[[], int],
        on_count: Callable[[int, int], None],
        on_compare: Callable[[int, int], bool],
        settled: Callable[[], bool],
        on_end: Callable[[int, Cause], None],
    ) -> None:
        self._context, self._pace, self._pins = context, pace, pins
        self._speed_limit, self._on_count, self._on_compare = speed_limit, on_count, on_compare
        self._settled, self._on_end = settled, on_end
        self.active = False
        self.direction = self.pout = 0
        self._ended: Cause | None = None
        self._rest_from = 0
        self._at_position = False
        self._wants: set[Cause] = set()
        self._events: dict[str, Event] = {}
        self._changes: list[tuple[int, Event]] = []

    # ------------------------------------------------------------------ start

    def start(self, t: int, order: Order) -> None:
        """Process t0 (P312-MOT-01)."""
        self.active, self.direction, self.order = True, order.direction, order
        self.sequence = Sequence(order.plan)
        self._wants.clear()
        self._changes.clear()
        self._ended, self._at_position = None, False
        self._slow_from: int | None = None
        self._limit, self._limit_before, self._limit_at = False, False, t
        self._began = self._flat_from = t
        clk = order.plan.table.clk
        self._divider = DIVIDERS.get(clk)
        first = t + self._context.timebase.w
        self._armed_from = first
        if self._divider is not None:
            self._due = first
            self._events["pulse"] = self._context.queue.at(first, Phase.PULSE, self._pulse)
        self.look(t + 1)
        self.look(t + self._pace.young)

    @property
    def due(self) -> int | None:
        """Edge of the next boundary, `None` if it is unknown."""
        return self._due if self.active and self._divider is not None else None

    @property
    def busy(self) -> bool:
        """True while the pulse output is active: pulses may follow, or the last one is not over."""
        return self.active or self._ended is not None

    @property
    def in_table(self) -> bool:
        """True in state ACC, False in FIX."""
        return self.busy and self.sequence.in_table

    # ------------------------------------------------------------------ requests

    def look(self, t: int) -> None:
        """Schedule a check of the inputs at edge t."""
        self._context.queue.at(t, Phase.GUARD, self._judge)

    def stop(self, t: int, cause: Cause) -> None:
        """Process an immediate stop by 80 or by an alarm (P312-MOT-34)."""
        if self.active:
            self._wants.add(cause)
            self.look(t)
        elif self._ended is Cause.RETURN:
            self._stay(t, cause)
        elif cause is Cause.ALARM and self._at_position and self._ended is Cause.STOP:
            self._stay(t, cause)
        if cause is Cause.ALARM:
            # An alarm does not wait for instructions that the position has released.
            self._context.queue.at(t + 1, Phase.BEGIN, self.look_at_rest)

    def slow_stop(self, t: int) -> None:
        """Process instruction 81 (P312-MOT-30)."""
        if self.active:
            sequence = self.sequence
            self._slow_from = t + 1
            self.look(t + 1)
            self._flag(t + self._pace.slow_lead, lambda at: sequence.request(Cause.SLOW))
        elif self._ended is Cause.RETURN:
            self._stay(t, Cause.LOW)

    def _stay(self, t: int, cause: Cause) -> None:
        """Process a stop between the phases of a zero return, or an alarm after a stop at a position."""
        self._ended = cause
        self._rest_at(t + 1)

    def change(self, t: int, change: Change) -> None:
        """Process instruction 87 or 88."""
        if self.active:
            sequence, lead = self.sequence, self._pace.ramp_lead if change.ramp else self._pace.change_lead
            # A change that is still pending is removed before the new change takes effect.
            self._flag(t + self._pace.drop_lead, lambda at: sequence.drop_change())
            self._changes.append((t, self._flag(t + lead, lambda at: sequence.change(change))))
            if change.ramp:
                held = self._flag(t + self._pace.change_lead, lambda at: sequence.hold())
                self._changes.append((t, held))

    def _flag(self, t: int, action: Callable[[int], None]) -> Event:
        return self._context.queue.at(t, Phase.FLAG, action)

    def _judge(self, t: int) -> None:
        if not self.active or t <= self._began:
            return
        pins, order, direction = self._pins, self.order, self.direction
        at_origin = order.origin and not pins["org_n"] and not (order.index and pins["index_n"])
        causes, self._wants = self._wants, set()
        causes |= {Cause.LIMIT} if not pins[LIMITS[direction]] else set()
        causes |= {Cause.ORIGIN} if at_origin and not order.turns else set()
        if causes:
            self._end(t, next(cause for cause in IMMEDIATE if cause in causes))
            return
        self._look_at_limit(t, not pins[SLOW_LIMITS[direction]])
        turns = at_origin and order.turns
        if self.sequence.running is None:
            slow = self._limit_before or (self._slow_from is not None and self._slow_from <= t)
            if slow or turns:
                self._end(t, Cause.LOW if slow else Cause.RETURN)
        elif turns:
            sequence = self.sequence
            self._flag(t + self._pace.origin_lead, lambda at: sequence.request(Cause.RETURN))

    def _look_at_limit(self, t: int, low: bool) -> None:
        """Process the high-speed limit, which is a level (P312-INP-12).

        The limit counts for boundaries `lead` cycles later.
        """
        if t > self._limit_at:
            self._limit_before, self._limit_at = self._limit, t
        limit = low and t >= self._began + self._pace.young
        limit = limit and self.sequence.present.rate <= self._speed_limit()
        if limit != self._limit:
            self._limit = limit
            sequence = self.sequence
            self._flag(t + self._pace.lead, lambda at: sequence.limit_level(limit))
            self.look(t + 1)

    # ------------------------------------------------------------------ end

    def _end(self, t: int, cause: Cause) -> None:
        """Cut the pulses from edge t on (P312-MOT-06, -34)."""
        self._ended = Cause.NORMAL if self.sequence.complete else cause
        self.active = False
        self._cancel("pulse")
        if not self.pout:
            self._rest_at(t + self._pace.rest)

    def _rest_at(self, t: int) -> None:
        self._rest_from = t
        self._context.queue.at(t, Phase.BEGIN, self.look_at_rest)

    def look_at_rest_soon(self, t: int) -> None:
        """Schedule a check at edge t, because a condition of a stop at a position may have become true."""
        if self._at_position and self._ended is not None:
            self._context.queue.at(t + 1, Phase.BEGIN, self.look_at_rest)

    def look_at_rest(self, t: int) -> None:
        """End the motion if the last pulse is over and no condition is pending."""
        cause = self._ended
        if cause is None or self.pout or t < self._rest_from or (self._at_position and not self._settled()):
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
            due = max(t, self._risen + self._pace.least)
            self._events["pulse"] = self._context.queue.at(due, Phase.BASE, self._pulse)

    def _pulse(self, t: int) -> None:
        """Process the boundary at edge t: the next pulse, or the end."""
        if not self.active:
            return
        sequence, constant = self.sequence, not self.sequence.in_table
        flat_for = t - self._flat_from - self._pace.search * sequence.sought
        step = sequence.boundary(flat_for >= self._pace.flat_lead, flat_for >= self._pace.slow_lead)
        if isinstance(step, Cause):
            self._end(t, step)
            return
        # A change that was requested in time for this boundary is discarded with the final deceleration, or
        # dropped.
        lead = 1 if sequence.walk_begins else self._pace.change_lead
        if sequence.walk_begins or sequence.drops:
            for since, event in self._changes:
                if since + lead <= t:
                    event.cancel()
        if step.stage is None and not constant:
            self._flat_from = t
        self.pout = 1
        self._ticks, self._risen = 0, t
        self._low_at(t + self._context.timebase.w)
        if self._divider is not None:
            self._plan_interval(t, step.rate, self._divider)
        self._context.queue.at(t + self._pace.count, Phase.PULSE, self._count)
        self._context.queue.at(t + self._pace.compare, Phase.PULSE, self._compare)
        self.look(t + 1)

    def _count(self, t: int) -> None:
        self._on_count(t, self.direction)

    def _compare(self, t: int) -> None:
        if self._on_compare(t, self.direction):
            self._context.queue.at(t + 1, Phase.RUN - 2, self._stop_at_position)

    def _stop_at_position(self, t: int) -> None:
        """Process the position of a registered 80 (P312-OVR-12)."""
        if not self.busy or self.sequence.complete:
            return
        self._at_position = True
        if self.active:
            self._wants.add(Cause.STOP)
            self._judge(t)

    def _plan_interval(self, t: int, rate: int, divider: int) -> None:
        """Schedule the fall of pout and the next boundary.

        Both follow the prescaler, whose phase pulse 1 cleared.
        """
        timebase = self._context.timebase
        if self.sequence.done == 1:
            self._origin = t
        tick = (t - self._origin) * timebase.xtal_hz // (divider * timebase.clk_hz)

        def edge(number: int) -> int:
            return self._origin + timebase.cyc(divider * number)

        self._low_at(min(t + timebase.w, edge(tick + rate // 2)))
        due = self._due = max(edge(tick + rate), t + self._pace.least)
        self._events["pulse"] = self._context.queue.at(due, Phase.PULSE, self._pulse)

    def _low_at(self, t: int) -> None:
        self._cancel("low")
        self._events["low"] = self._context.queue.at(t, Phase.LOW_END, self._low)

    def _low(self, t: int) -> None:
        self.pout = 0
        if self._ended is not None:
            self._rest_at(t + self._pace.rest)

    def _cancel(self, name: str) -> None:
        event = self._events.pop(name, None)
        if event:
            event.cancel()
