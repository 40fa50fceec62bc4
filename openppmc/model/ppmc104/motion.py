"""What is special in the motion of the PPMC-104: P104-OPR, P104-STP, P104-DS-03 (triangles), -10, -12."""

from __future__ import annotations

from ..common.blocks import Context, Phase
from ..motion.chopper import Chopper
from ..motion.codes import FINISH_STOP, Command
from ..motion.excitation import Excitation
from ..motion.motion import Setup
from ..single.hostport import BytePort
from ..single.strobes import SpeedGate
from ..single.timed_motion import TimedMotion
from .pins import GUARD

DS_FLAG_COMMAND, DS_FLAG_LIMIT, DS_FLAG_LIMIT_HIGH = 272, 192, 272
DS_FAST_PULSE, DS_FAST_PHASE = 100, 148


class Motion(TimedMotion):
    """The axis of a PPMC-104."""

    hold_cycles = 544_000

    def __init__(
        self, context: Context, port: BytePort, gate: SpeedGate, excitation: Excitation, chopper: Chopper
    ) -> None:
        super().__init__(context, port, excitation, chopper, GUARD)
        self._gate = gate

    # ------------------------------------------------------------------ start

    def _latch_operation(self, command: Command, data: list[int], setup: Setup) -> None:
        levels = self._context.levels
        self._load(command, data, setup, levels["csel"], bool(levels["vsel"]))

    def _first_pulse_cycles(self) -> int:
        triangle = self.is_ramp and self._total - 1 < 2 * self._setup.ramp.pa
        return super()._first_pulse_cycles() + (123 * self._total // 16 if triangle else 0)

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
        slower = len(self.intervals) > 2 and self._falls(-2)
        look_up = latency.seek_start + latency.seek_per_rate * passed if slower else latency.seek_turn
        return latency.ds12_lag + look_up

    def _falls(self, number: int) -> bool:
        """Whether this interval of a ramp has a lower index than the one before."""
        index, before = self.intervals[number].index, self.intervals[number - 1].index
        return index is not None and before is not None and index < before

    # ------------------------------------------------------------------ end

    def _ending(self, t: int) -> None:
        self._gate.set(t, False)
