"""Motion of the PPMC-104 model: one operation from its start edge to its end.

Start and counts: P104-OPR-01..12. Intervals: P104-BCK-01..03, P104-INT-01..03, P104-PRO-04..06.
Forced deceleration: P104-FDC-01..06. Pulse shape: P104-TIM-02..06. Ends: P104-END-01..08.
Inputs: P104-LIM-01..09 (which input does what: guard104). DATASHEET: P104-DS-03..10, -12.
"""

from __future__ import annotations

from typing import NamedTuple

from .chopper104 import Chopper
from .codes104 import (
    ENDLESS,
    FINISH_NEW,
    FINISH_SLOW,
    FINISH_STOP,
    RAMP_OPERATIONS,
    SINGLE_STEP,
    Command,
)
from .excitation import Excitation
from .external104 import ExternalInterval
from .guard104 import inspect
from .hostport104 import HostPort
from .parts104 import Context, Phase
from .ramp import BaseClock, Ramp, natural_deceleration, next_index
from .scheduler import Event

HOLD_CYCLES = 544_000

DS_BUSY_RAMP, DS_BUSY_CONSTANT = 1792, 432
DS_PULSE_CONSTANT, DS_PULSE_RAMP, DS_PULSE_STEP = 3104, 3200, 1376
DS_END, DS_CLOSED, DS_END_RAMP_STOP = 416, 2496, 3200
DS_FLAG_COMMAND, DS_FLAG_LIMIT, DS_FLAG_LIMIT_HIGH = 272, 192, 272
DS_FAST_PULSE, DS_FAST_PHASE = 100, 148


class Setup(NamedTuple):
    """What an accepted initialisation leaves for operations."""

    ramp: Ramp
    external: bool
    chopping: bool


class Interval(NamedTuple):
    """Interval `number` (from pulse `number` on): ramp index (None: constant speed), rate, length in
    quanta (None: external clock)."""

    number: int
    index: int | None
    rate: int
    quanta: int | None


class Motion:
    """The one operation there can be; busy, index, done, intervals, finish, remaining are public."""

    def __init__(self, context: Context, port: HostPort, excitation: Excitation, chopper: Chopper) -> None:
        self._context = context
        self._port = port
        self._excitation = excitation
        self._chopper = chopper
        self.reset()

    def reset(self) -> None:
        """Reset values: at rest, nothing to report."""
        self.busy = self.finishing = self.low = False
        self.hold, self.direction = 1, 0
        self.finish, self.remaining = 0, 0
        self.intervals: list[Interval] = []
        self.index: int | None = None
        self.operation = 0
        self.done = 0
        self._total = 0
        self._flag_edge: int | None = None
        self._natural = False
        self._external: ExternalInterval | None = None
        self._armed_from: int | None = None
        self._last_rise: int | None = None
        self._cut_at = 0
        self._cut_on_fall = False
        self._low_ended = -1
        self._events: dict[str, Event] = {}

    # ------------------------------------------------------------------ start

    def start(self, t: int, command: Command, data: list[int], setup: Setup, reference: int) -> None:
        """C-event of an operation's last byte (P104-OPR-01, P104-BCK-02, P104-DS-03..06)."""
        levels, timebase = self._context.levels, self._context.timebase
        self.operation = command.operation
        self._command = command
        self._setup = setup
        counted = data[-3:] if len(data) >= 3 else None
        self._total = int.from_bytes(bytes(counted), "little") + 1 if counted else ENDLESS
        if self.operation == SINGLE_STEP:
            self._total = 1
        self._rate = 0 if self.is_ramp or not data else data[0]
        self._csel, self._plain = bool(levels["csel"]), bool(levels["vsel"])
        self._clock = BaseClock.of_pins(levels["csel"], levels["vsel"])
        waits = setup.external and self.operation != SINGLE_STEP
        self._external = ExternalInterval(timebase, self._plain) if waits else None
        if not self._context.datasheet:
            self._begin(t, t + timebase.w + self._context.latency.start_extra)
            return
        begin = reference + timebase.cyc(DS_BUSY_RAMP if self.is_ramp else DS_BUSY_CONSTANT)
        first = reference + timebase.cyc(self._first_pulse_cycles())
        self._port.close_until(begin)
        self._context.queue.at(begin, Phase.BEGIN, lambda at: self._begin(at, first))

    def _first_pulse_cycles(self) -> int:
        if self.operation == SINGLE_STEP:
            return DS_PULSE_STEP
        if not self.is_ramp:
            return DS_PULSE_CONSTANT
        triangle = self._total - 1 < 2 * self._setup.ramp.pa
        return DS_PULSE_RAMP + (123 * self._total // 16 if triangle else 0)

    def _begin(self, t: int, first: int) -> None:
        """Start edge: BUSY rises, hold and dir follow, pulse 1 is due at `first` or the next base edge."""
        self.busy, self.finishing = True, False
        self.hold, self.direction = 0, self._command.direction
        self.done, self.index = 0, None
        self.intervals = []
        self._flag_edge, self._natural = None, False
        self._flag_bits = self._stop_bits = 0
        self._stop_wanted = False
        self._began, self._end_after = t, 0
        self._chopper.stop()
        self._cancel("hold")
        if self._external:
            self._armed_from = first
        else:
            self._events["pulse"] = self._context.queue.at(first, Phase.PULSE, self._pulse)
        self._context.queue.at(t + 1, Phase.GUARD, self.judge)

    def _cancel(self, name: str) -> None:
        event = self._events.pop(name, None)
        if event:
            event.cancel()

    @property
    def is_ramp(self) -> bool:
        """011 and 110 types."""
        return self.operation in RAMP_OPERATIONS

    @property
    def decelerating(self) -> bool:
        """State DEC: flagged, or slowing down by count."""
        return self.busy and not self.finishing and (self._flag_edge is not None or self._natural)

    @property
    def high(self) -> bool:
        """State HIGH: the running interval has index PA and nothing is flagged (P104-PRO-06)."""
        return self.is_ramp and self.index == self._setup.ramp.pa and not self.decelerating

    # ------------------------------------------------------------------ stop commands and inputs

    def stop(self, t: int) -> None:
        """Immediate Stop taken, or a Decelerating Stop that acts like one (P104-STP-01, -05, -08)."""
        if not self.finishing:
            self._stop_wanted = True
            self._context.queue.at(t, Phase.GUARD, self.judge)

    def slow_stop(self, t: int, reference: int) -> None:
        """Decelerating Stop taken in START, ACC or HIGH of 011/110 (P104-STP-03, P104-DS-10)."""
        at = t
        if self._context.datasheet:
            at = reference + self._context.timebase.cyc(DS_FLAG_COMMAND)
            self._port.close_until(at)
        self._events["flag"] = self._context.queue.at(
            at, Phase.FLAG, lambda now: self._flag(now, FINISH_STOP)
        )

    def judge(self, t: int) -> None:
        """Guard at edge t: immediate ends first, then the slow-down limit (P104-LIM-01..09)."""
        if not self.busy or self.finishing or t <= self._began:
            return
        seen = inspect(self._context.levels, self.operation, self.direction)
        if seen.ends or self._stop_wanted:
            self._end_now(t, seen.bits | (FINISH_STOP if self._stop_wanted else 0))
        elif seen.slow and self.is_ramp and self._slow_counts():
            at = t
            if self._context.datasheet:
                cycles = DS_FLAG_LIMIT_HIGH if self.high else DS_FLAG_LIMIT
                at += self._context.timebase.cyc(cycles) + self._context.latency.ds_motor
            self._events["slow"] = self._context.queue.at(
                at, Phase.FLAG, lambda now: self._flag(now, FINISH_SLOW)
            )

    def _slow_counts(self) -> bool:
        if self._flag_edge is not None or "slow" in self._events:
            return False
        return self.high or not self._command.pulse_only

    def _flag(self, t: int, bit: int) -> None:
        """Set the forced-deceleration flag; two requests on one edge both count (P104-LIM-09)."""
        if self.finishing or not self.busy or self._natural:
            return
        if self._flag_edge is None or self._flag_edge == t:
            self._flag_edge = t
            self._flag_bits |= bit

    def _end_now(self, t: int, bits: int) -> None:
        """Immediate end decided at edge t (P104-END-02, -04, P104-DS-08)."""
        context = self._context
        self.finishing = True
        self._stop_bits = bits
        self._cancel("pulse")
        if context.datasheet:
            open_at = DS_END_RAMP_STOP if self.is_ramp else DS_CLOSED
            end_at = DS_END_RAMP_STOP if self.is_ramp else DS_END
            self._datasheet_end(t, t, end_at, open_at)
            return
        self._end_after = t + context.latency.imm_end
        if not self.low:
            self._plan_end(self._low_ended)

    # ------------------------------------------------------------------ pulses

    def base_rise(self, t: int) -> None:
        """Effective rising edge of the external clock (P104-TIM-03, P104-BCK-04)."""
        gap = None if self._last_rise is None else t - self._last_rise
        self._last_rise = t
        external = self._external
        if not self.busy or external is None:
            return
        if self.finishing:  # the low time that has begun keeps its length (P104-TIM-05)
            if self.low and self._cut_at:
                external.rise(t, gap, self.low)
                if external.edges == self._cut_at:
                    self._cut_low(t)
            return
        if self.done == 0:
            if self._armed_from is not None and t >= self._armed_from:
                self._pulse(t, gap, on_edge=True)
            return
        due = external.rise(t, gap, self.low)
        if due == 0:
            self._pulse(t, gap, on_edge=True)
        elif due is not None:
            self._events["pulse"] = self._context.queue.at(t + due, Phase.PULSE, self._pulse)
        elif self.low and self._cut_at and external.edges == self._cut_at:
            self._cut_low(t)

    def base_fall(self, t: int) -> None:
        """Effective falling edge of the external clock (P104-TIM-05 c)."""
        if self.low and self._cut_on_fall:
            self._cut_low(t)

    def _pulse(self, t: int, gap: int | None = None, on_edge: bool = False) -> None:
        """Pulse event at edge t (P104-TIM-04, P104-PRO-04)."""
        context = self._context
        if not self.busy or self.finishing:
            return
        self.done += 1
        if self.done == 1:
            context.counter.restart(t)
            self._quanta = 0
        if not self._command.pulse_only:
            self._excitation.step(self.direction)
        rate = self._next_rate(t)
        self._begin_low(t, rate, gap)
        if rate is None:
            self._last_pulse(t)
            return
        quanta = None if self._external else self._clock.quanta(rate)
        self.intervals.append(Interval(self.done, self.index, rate, quanta))
        if self._external:
            self._external.begin(t, rate, on_edge)
        else:
            assert quanta is not None
            self._quanta += quanta
            edge = context.counter.edge_of(self._quanta)
            self._events["pulse"] = context.queue.at(edge, Phase.PULSE, self._pulse)
            if context.datasheet:
                limit = DS_FAST_PULSE if self._command.pulse_only else DS_FAST_PHASE
                self._port.set_fast(t + self._fast_lag(rate, limit), quanta < limit)
        if self.high and self._command.pulse_only:
            context.queue.at(t + 1, Phase.GUARD, self.judge)

    def _fast_lag(self, rate: int, limit: int) -> int:
        """Pulse event to the decision about P104-DS-12 (see Latency.ds12_lag)."""
        latency, quanta = self._context.latency, self._clock.quanta
        before = self.intervals[-2].rate if len(self.intervals) > 1 else rate
        passed = 0
        while before + passed < rate and quanta(before + passed) < limit:
            passed += 1
        if not passed:
            return latency.ds12_lag
        turned = len(self.intervals) > 2 and self.intervals[-2].index <= self.intervals[-3].index
        start = latency.seek_start if turned else latency.seek_turn
        return latency.ds12_lag + start + latency.seek_per_rate * passed

    def _next_rate(self, t: int) -> int | None:
        """Rate of the interval that pulse `done` opens, None if it was the last."""
        left = self._total - self.done
        if not self.is_ramp:
            return self._rate if left else None
        ramp = self._setup.ramp
        kp = -1 if self.index is None else self.index
        forced = self._flag_edge is not None and t - self._flag_edge >= self._context.latency.flag_lead
        index = next_index(kp, left, ramp.pa, forced)
        self._natural = self._natural or natural_deceleration(kp, left, ramp.pa)
        self.index = index
        return None if index is None else ramp.rate(index)

    def _begin_low(self, t: int, rate: int | None, gap: int | None) -> None:
        """pout_n goes low; the length is fixed here (P104-TIM-05)."""
        timebase = self._context.timebase
        length, self._cut_at, self._cut_on_fall = timebase.w, 0, False
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
        if self.finishing and not self._context.datasheet:
            self._plan_end(t)

    # ------------------------------------------------------------------ end

    def _last_pulse(self, t: int) -> None:
        """The train is over: all N pulses, or the tail of a forced deceleration."""
        self.finishing = True
        if not self._context.datasheet:
            return
        pin = t + self._context.latency.motor_pins
        if self.done < self._total:
            self._datasheet_end(t, pin, DS_END_RAMP_STOP, DS_END_RAMP_STOP)
        elif self.operation == SINGLE_STEP:
            self._datasheet_end(t, pin, DS_END, DS_END)
        else:
            self._datasheet_end(t, pin, DS_END, DS_CLOSED)

    def _datasheet_end(self, t: int, since: int, end_cycles: int, open_cycles: int) -> None:
        """End and closed mailbox, both counted from `since` (P104-DS-06..08)."""
        context = self._context
        since += context.latency.ds_motor
        self._port.close_until(since + context.timebase.cyc(open_cycles))
        self._port.set_fast(t, False)
        # Before COMMAND: a byte that waited for this very edge is judged with BUSY = 0.
        context.queue.at(since + context.timebase.cyc(end_cycles), Phase.BEGIN, self._finish)

    def _plan_end(self, low_ended: int) -> None:
        latency = self._context.latency
        edge = max(low_ended + latency.motor_pins + latency.end_extra, self._end_after)
        self._context.queue.at(edge, Phase.END, self._finish)

    def _finish(self, t: int) -> None:
        """End actions, all on one edge (P104-END-01..08)."""
        context = self._context
        for name in ("flag", "slow"):
            self._cancel(name)
        left = self._total - self.done
        bits = self._stop_bits | self._flag_bits if left else 0
        self.finish = FINISH_NEW | bits | self.operation
        self.remaining = max(left - 1, 0)
        self.busy = self.finishing = False
        self.index, self._armed_from = None, None
        if not self._command.masked:
            context.drive(t, "int_n", 0)
        context.counter.restart(t)
        if self._setup.chopping:
            self._chopper.start(t)
        at = t + context.timebase.cyc(HOLD_CYCLES)
        self._events["hold"] = context.queue.at(at, Phase.CHOPPER, self._hold_rises)

    def _hold_rises(self, t: int) -> None:
        self.hold = 1
