"""Motion of one axis: one operation from its start edge to its end.

This module contains the behaviour that the PPMC family shares.

Intervals: P104-BCK-01..03, P104-INT-01..03, P104-PRO-04..06 (P2104-BCK, -INTV, -PRO). Forced deceleration:
P104-FDC-01..05. Pulse shape: P104-TIM-02..06. Ends: P104-END-01..08. Inputs: P104-LIM-01..09 (`codes` defines
the effect of each input). The `motion` module of a part defines when an operation may start, the effect of a
stop, and the DATASHEET times.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from ..chip import Context, Phase
from ..clock import Event
from .codes import (
    ENDLESS,
    FINISH_NEW,
    FINISH_SLOW,
    FINISH_STOP,
    RAMP_OPERATIONS,
    SINGLE_STEP,
    ActiveCauses,
    Command,
    GuardPins,
    inspect,
)
from .excitation import Chopper, Excitation
from .external import ExternalInterval
from .ramp import BaseClock, Ramp, natural_deceleration, next_index

OnEnd = Callable[[int, bool], None]


class Setup(NamedTuple):
    """Settings of an accepted initialisation that operations use."""

    ramp: Ramp
    external: bool
    chopping: bool


@dataclass(slots=True)
class Interval:
    """Interval that begins with pulse `number`.

    Attributes:
        index: ramp index, `None` at constant speed.
        quanta: length of the interval in quanta, `None` with the external clock.
    """

    number: int
    index: int | None
    rate: int
    quanta: int | None


class Motion:
    """Operation of an axis. The attributes busy, index, done, intervals, finish and remaining are public.

    Args:
        guard: pin names of the switches in context.levels.
        on_end: on_end(t, masked) is called when BUSY falls; `masked` is True if the operation masks its
            interrupt.

    Attributes:
        hold_cycles: crystal cycles from the falling edge of BUSY to HOLD.
    """

    hold_cycles: int
    # True if a deceleration request at the start-up rate ends the operation immediately (P2104-FDC-02,
    # STMC-DEC-03).
    ends_at_start_rate: ClassVar[bool] = False

    def __init__(
        self, context: Context, excitation: Excitation, chopper: Chopper, guard: GuardPins, on_end: OnEnd
    ) -> None:
        self._context = context
        self._excitation = excitation
        self._chopper = chopper
        self._guard = guard
        self._on_end = on_end
        self.busy = self.finishing = self.low = self._natural = False
        self.hold, self.direction, self.finish, self.remaining = 1, 0, 0, 0
        self.intervals: list[Interval] = []
        self.index: int | None = None
        self.operation = self.done = self._total = 0
        self._flag_edge: int | None = None
        self._external: ExternalInterval | None = None
        self._armed_from: int | None = None
        self._last_rise: int | None = None
        self._cut_at, self._cut_on_fall, self._cut_from, self._low_ended = 0, False, 0, -1
        self._events: dict[str, Event] = {}

    # ------------------------------------------------------------------ start

    def _latch_settings(
        self, command: Command, data: list[int], setup: Setup, csel: int, plain: bool
    ) -> None:
        """Latch an operation when its last byte is consumed (P104-OPR-01, P104-BCK-02).

        Args:
            data: data bytes of the operation: rate, then count.
            csel: level of the pin csel.
            plain: True if the pin vsel selects intervals without extra time.
        """
        self.operation = command.operation
        self._command = command
        self._setup = setup
        count_bytes = data[-3:] if len(data) >= 3 else None
        self._total = int.from_bytes(bytes(count_bytes), "little") + 1 if count_bytes else ENDLESS
        if self.operation == SINGLE_STEP:
            self._total = 1
        self._rate = 0 if self.is_ramp or not data else data[0]
        self._csel, self._plain = bool(csel), plain
        self._clock = BaseClock.of_pins(csel, int(plain))
        counts_clock = setup.external and self.operation != SINGLE_STEP
        self._external = ExternalInterval(self._context.timebase, plain) if counts_clock else None

    def _begin(self, t: int) -> None:
        """Process the start edge: BUSY rises, the pin hold is deasserted, and the pin dir is set."""
        self.busy, self.finishing = True, False
        self.hold, self.direction = 0, self._command.direction
        self.done, self.index = 0, None
        self.intervals = []
        self._flag_edge, self._natural = None, False
        self._flag_bits, self._stop_bits, self._stop_requested = 0, 0, False
        self._began, self._end_after = t, 0
        self._chopper.stop()
        self._cancel("hold")
        self._context.queue.at(t + 1, Phase.GUARD, self.check_stops)

    def _arm(self, first: int) -> None:
        """Schedule pulse 1 at edge `first`.

        With the external clock, pulse 1 is scheduled at the first base edge at or after `first`.
        """
        if self._external:
            self._armed_from = first
        else:
            self._plan_pulse(first)

    def _plan_pulse(self, edge: int) -> None:
        self._events["pulse"] = self._context.queue.at(edge, Phase.PULSE, self._pulse)

    def _cancel(self, name: str) -> None:
        event = self._events.pop(name, None)
        if event:
            event.cancel()

    @property
    def is_ramp(self) -> bool:
        """True for the operation types 011 and 110, which have a ramp."""
        return self.operation in RAMP_OPERATIONS

    @property
    def external(self) -> bool:
        """True while an operation that counts edges of the external clock is running."""
        return self.busy and self._external is not None

    @property
    def decelerating(self) -> bool:
        """State DEC: forced deceleration, or natural deceleration at the end of a move."""
        return self.busy and not self.finishing and (self._flag_edge is not None or self._natural)

    @property
    def high(self) -> bool:
        """State HIGH: the running interval has index PA, and no deceleration is flagged (P104-PRO-06)."""
        return self.is_ramp and self.index == self._setup.ramp.pa and not self.decelerating

    # ------------------------------------------------------------------ stop commands and inputs

    def stop(self, t: int) -> None:
        """Process an accepted immediate stop (P104-STP-01, -05, -08)."""
        if not self.finishing:
            self._stop_requested = True
            self._context.queue.at(t, Phase.GUARD, self.check_stops)

    def check_stops(self, t: int) -> None:
        """Check the stop causes at edge t (P104-LIM-01..09).

        Causes of an immediate end are checked first, then the slow-down limit.
        """
        if not self.busy or self.finishing or t <= self._began:
            return
        causes = self._active_causes(t)
        if causes.ends or self._stop_requested:
            self._end_now(t, causes.bits | (FINISH_STOP if self._stop_requested else 0))
        elif causes.slow and self.is_ramp and self._slow_limit_effective():
            self._request(self._slow_limit_edge(t), "slow", FINISH_SLOW)

    def _active_causes(self, t: int) -> ActiveCauses:
        """Return the causes that the switches indicate at edge t."""
        return inspect(self._guard, self._context.levels, self.operation, self.direction)

    def _slow_limit_effective(self) -> bool:
        """Return True if an active slow-down limit must request a forced deceleration.

        This is not the case if it has already requested one, or if the flag is set.
        """
        return self._flag_edge is None and "slow" not in self._events

    def _slow_limit_edge(self, t: int) -> int:
        """Return the edge at which a slow-down limit that was sampled at edge t is effective."""
        return t

    def _request(self, at: int, name: str, bit: int) -> None:
        """Schedule for edge `at` the forced deceleration that the cause `name` requests."""
        self._events[name] = self._context.queue.at(at, Phase.FLAG, lambda now: self._flag(now, bit))

    def _flag(self, t: int, bit: int) -> None:
        """Set the forced-deceleration flag.

        Two requests at the same edge both set their bits in the finish status (P104-LIM-09).
        """
        # Another request at this edge was processed first, and it may have ended the motion.
        if self._flag_edge == t:
            self._flag_bits |= bit
            return
        if self.finishing or not self.busy or self._natural or self._flag_edge is not None:
            return
        self._flag_edge = t
        self._flag_bits |= bit
        if self.ends_at_start_rate and self._at_start_rate:
            self._end_now(t, 0)

    @property
    def _at_start_rate(self) -> bool:
        """True if the running interval has the start-up rate, at any index of the ramp."""
        ramp = self._setup.ramp
        return self.index is not None and ramp.rate(self.index) == ramp.rl

    def _end_now(self, t: int, bits: int) -> None:
        """Process an immediate end decided at edge t (P104-END-02, -04)."""
        self.finishing = True
        self._stop_bits = bits
        self._cancel("pulse")
        self._end_decided(t)

    def _end_decided(self, t: int) -> None:
        """Schedule the end of a motion whose immediate end was decided at edge t.

        With FAST timing, the motion ends after the low time of the pulse.
        """
        self._end_after = t + self._context.latency.imm_end
        if not self.low:
            self._plan_end(self._low_ended)

    # ------------------------------------------------------------------ pulses

    def base_rise(self, t: int) -> None:
        """Process an effective rising edge of the external clock (P104-TIM-03, P104-BCK-04)."""
        gap = None if self._last_rise is None else t - self._last_rise
        self._last_rise = t
        external = self._external
        if not self.busy or external is None:
            return
        if self.finishing:  # a low time that has already begun keeps its length (P104-TIM-05)
            if self.low and self._cut_at:
                external.rise(t, gap, self.low)
                if external.edges == self._cut_at:
                    self._cut_low(t)
            return
        if self.done == 0:
            if self._armed_from is not None and t >= self._armed_from:
                self._pulse(t, gap, on_edge=True)
            return
        delay = external.rise(t, gap, self.low)
        if delay == 0:
            self._pulse(t, gap, on_edge=True)
        elif delay is not None:
            self._plan_pulse(t + delay)
        elif self.low and self._cut_at and external.edges == self._cut_at:
            self._cut_low(t)

    def base_fall(self, t: int) -> None:
        """Process an effective falling edge of the external clock (P104-TIM-05 c).

        The low time lasts at least 2 cycles, even if the clock was sampled high for only one cycle.
        """
        if self.low and self._cut_on_fall:
            self._cut_low(max(t, self._cut_from))

    def _pulse(self, t: int, gap: int | None = None, on_edge: bool = False) -> None:
        """Process the pulse event at edge t (P104-TIM-04, P104-PRO-04)."""
        context = self._context
        if not self.busy or self.finishing:
            return
        self.done += 1
        if self.done == 1:
            context.counter.restart(t)
            self._quanta = 0
        rate = self._next_rate(t)
        self._output_pulse(t, rate, gap)
        if rate is None:
            self.finishing = True
            self._last_pulse_output(t)
            return
        quanta = None if self._external else self._clock.quanta(rate)
        self.intervals.append(Interval(self.done, self.index, rate, quanta))
        if self._external:
            self._external.begin(t, rate, on_edge)
        else:
            assert quanta is not None
            self._quanta += quanta
            self._plan_pulse(context.counter.edge_of(self._quanta))
        self._interval_begun(t)

    def _output_pulse(self, t: int, rate: int | None, gap: int | None) -> None:
        """Set the pins for a pulse: the phases to the next pattern, pout_n to 0."""
        if not self._command.pulse_only:
            self._excitation.step(self.direction)
        self._begin_low(t, rate, gap)

    def _interval_begun(self, t: int) -> None:
        """Process the beginning of an interval; its pulse event is at edge t."""

    def _next_rate(self, t: int) -> int | None:
        """Return the rate of the interval that begins with pulse `done`, `None` after the last pulse."""
        pulses_left = self._total - self.done
        if not self.is_ramp:
            return self._rate if pulses_left else None
        ramp = self._setup.ramp
        kp = -1 if self.index is None else self.index
        forced = self._flag_edge is not None and t - self._flag_edge >= self._context.latency.flag_lead
        index = next_index(kp, pulses_left, ramp.pa, forced)
        self._natural = self._natural or natural_deceleration(kp, pulses_left, ramp.pa)
        self.index = index
        return None if index is None else ramp.rate(index)

    def _begin_low(self, t: int, rate: int | None, gap: int | None) -> None:
        """Set pout_n low and determine the length of the low time (P104-TIM-05)."""
        timebase = self._context.timebase
        length, self._cut_at, self._cut_on_fall, self._cut_from = timebase.w, 0, False, t + 2
        if rate is not None and self._plain:
            if not self._external:
                if self._csel and rate <= 2:
                    length = timebase.cyc(16 * (rate + 1))
            elif rate >= 1:
                self._cut_at = (rate + 1) // 2
            else:
                self._cut_on_fall = gap is not None and gap < timebase.cyc(128)
        self.low = True
        self._events["low"] = self._context.queue.at(t + length, Phase.LOW_END, self._low_end)

    def _cut_low(self, t: int) -> None:
        self._cut_at, self._cut_on_fall = 0, False
        self._cancel("low")
        self._events["low"] = self._context.queue.at(t, Phase.LOW_END, self._low_end)

    def _low_end(self, t: int) -> None:
        self.low = False
        self._low_ended = t
        if self.finishing and self._ends_with_low():
            self._plan_end(t)

    # ------------------------------------------------------------------ end

    def _last_pulse_output(self, t: int) -> None:
        """Process the edge of the last pulse, also after a forced deceleration."""

    def _ends_with_low(self) -> bool:
        """Return True if BUSY falls at the end of the last low time (FAST timing)."""
        return True

    def _plan_end(self, low_ended: int) -> None:
        latency = self._context.latency
        edge = max(low_ended + latency.motor_pins + latency.end_extra, self._end_after)
        self._context.queue.at(edge, Phase.END, self._finish)

    def _finish(self, t: int) -> None:
        """Process the end of the operation; all its actions occur at the same edge (P104-END-01..08)."""
        context = self._context
        self._cancel("flag")
        self._cancel("slow")
        pulses_left = self._total - self.done
        bits = self._stop_bits | self._flag_bits if pulses_left else 0
        self.finish = FINISH_NEW | bits | self.operation
        self.remaining = max(pulses_left - 1, 0)
        self.busy = self.finishing = False
        self.index, self._armed_from = None, None
        self._on_end(t, self._command.masked)
        context.counter.restart(t)
        if self._setup.chopping:
            self._chopper.start(t)
        self._plan_hold(t + context.timebase.cyc(self.hold_cycles))

    def _plan_hold(self, edge: int) -> None:
        self._events["hold"] = self._context.queue.at(edge, Phase.CHOPPER, self._set_hold)

    def _set_hold(self, t: int) -> None:
        self.hold = 1
