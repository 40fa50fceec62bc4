"""What is special in the motion of the PPMC-104: P104-OPR, P104-STP, and the times of P104-DS-03..10, -12."""

from __future__ import annotations

from .chopper import Chopper
from .codes import FINISH_STOP, SINGLE_STEP, Command
from .excitation import Excitation
from .hostport import HostPort
from .hostport104 import SpeedGate
from .motion import Motion, Setup
from .parts import Context, Phase
from .parts104 import GUARD

DS_BUSY_RAMP, DS_BUSY_CONSTANT = 1792, 432
DS_PULSE_CONSTANT, DS_PULSE_RAMP, DS_PULSE_STEP = 3104, 3200, 1376
DS_END, DS_CLOSED, DS_END_RAMP_STOP = 416, 2496, 3200
DS_FLAG_COMMAND, DS_FLAG_LIMIT, DS_FLAG_LIMIT_HIGH = 272, 192, 272
DS_FAST_PULSE, DS_FAST_PHASE = 100, 148


class Motion104(Motion):
    """The axis of a PPMC-104."""

    hold_cycles = 544_000

    def __init__(
        self, context: Context, port: HostPort, gate: SpeedGate, excitation: Excitation, chopper: Chopper
    ) -> None:
        super().__init__(context, excitation, chopper, GUARD, self._interrupt)
        self._port = port
        self._gate = gate

    def _interrupt(self, t: int, masked: bool) -> None:
        if not masked:
            self._context.drive(t, "int_n", 0)

    # ------------------------------------------------------------------ start

    def start(self, t: int, command: Command, data: list[int], setup: Setup, reference: int) -> None:
        """C-event of an operation's last byte (P104-OPR-01, P104-BCK-02, P104-DS-03..06)."""
        levels, timebase = self._context.levels, self._context.timebase
        self._load(command, data, setup, levels["csel"], bool(levels["vsel"]))
        if not self._context.datasheet:
            self._start(t, t + timebase.w + self._context.latency.start_extra)
            return
        begin = reference + timebase.cyc(DS_BUSY_RAMP if self.is_ramp else DS_BUSY_CONSTANT)
        first = reference + timebase.cyc(self._first_pulse_cycles())
        self._port.close_until(begin)
        self._context.queue.at(begin, Phase.BEGIN, lambda at: self._start(at, first))

    def _start(self, t: int, first: int) -> None:
        self._begin(t)
        self._arm(first)

    def _first_pulse_cycles(self) -> int:
        if self.operation == SINGLE_STEP:
            return DS_PULSE_STEP
        if not self.is_ramp:
            return DS_PULSE_CONSTANT
        triangle = self._total - 1 < 2 * self._setup.ramp.pa
        return DS_PULSE_RAMP + (123 * self._total // 16 if triangle else 0)

    # ------------------------------------------------------------------ stop commands and inputs

    def slow_stop(self, t: int, reference: int) -> None:
        """Decelerating Stop taken in START, ACC or HIGH of 011/110 (P104-STP-03, P104-DS-10)."""
        at = t
        if self._context.datasheet:
            at = reference + self._context.timebase.cyc(DS_FLAG_COMMAND)
            self._port.close_until(at)
        self._request(at, "flag", FINISH_STOP)

    def _slow_counts(self) -> bool:
        return super()._slow_counts() and (self.high or not self._command.pulse_only)

    def _slow_edge(self, t: int) -> int:
        if not self._context.datasheet:
            return t
        cycles = DS_FLAG_LIMIT_HIGH if self.high else DS_FLAG_LIMIT
        return t + self._context.timebase.cyc(cycles) + self._context.latency.ds_motor

    # ------------------------------------------------------------------ pulses

    def _interval_begun(self, t: int) -> None:
        if self._context.datasheet and not self._external:
            rate, limit = self.intervals[-1].rate, self._fast_limit
            self._gate.set(t + self._fast_lag(rate, limit), self._clock.quanta(rate) < limit)
        if self.high and self._command.pulse_only:
            self._context.queue.at(t + 1, Phase.GUARD, self.judge)

    @property
    def _fast_limit(self) -> int:
        return DS_FAST_PULSE if self._command.pulse_only else DS_FAST_PHASE

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

    # ------------------------------------------------------------------ end

    def _decided(self, t: int) -> None:
        if not self._context.datasheet:
            super()._decided(t)
            return
        closed = DS_END_RAMP_STOP if self.is_ramp else DS_CLOSED
        self._datasheet_end(t, t, DS_END_RAMP_STOP if self.is_ramp else DS_END, closed)

    def _train_over(self, t: int) -> None:
        if not self._context.datasheet:
            return
        pin = t + self._context.latency.motor_pins
        if self.done < self._total:
            self._datasheet_end(t, pin, DS_END_RAMP_STOP, DS_END_RAMP_STOP)
        elif self.operation == SINGLE_STEP:
            self._datasheet_end(t, pin, DS_END, DS_END)
        else:
            self._datasheet_end(t, pin, DS_END, DS_CLOSED)

    def _ends_with_low(self) -> bool:
        return not self._context.datasheet

    def _datasheet_end(self, t: int, since: int, end_cycles: int, open_cycles: int) -> None:
        """End and closed mailbox, both counted from `since` (P104-DS-06..08)."""
        context = self._context
        since += context.latency.ds_motor
        self._port.close_until(since + context.timebase.cyc(open_cycles))
        self._gate.set(t, False)
        # Before COMMAND: a byte that waited for this very edge is judged with BUSY = 0.
        context.queue.at(since + context.timebase.cyc(end_cycles), Phase.BEGIN, self._finish)
