"""Operation of the PPMC-312 from its acceptance to its stop report.

The operation includes RUN, END, zero return and alarms.

Rules: P312-INP-11, -20, -30; P312-MOT-06, -35, -42, -43; P312-STA-01, -02.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ...chip import Context, Phase
from ..codes import Alarm, Answer, Cause, State
from ..front import responses as responses312
from ..front.responses import Responses
from ..stages import constant
from ..timing import CoreTiming
from .inputs import Outputs
from .motion import LIMITS, SLOW_LIMITS, Motion, MotionRequest
from .position import Counters
from .sequence import Change


class Operation:
    """Operation from its acceptance to its stop report.

    Args:
        pins: input levels that decisions use.
        alarm: alarm(t, status) is called when a report is discarded because the store of its class is full
            (P312-RSP-20).
        on_pulses_ended: on_pulses_ended(t) is called after each change of the position, and when the pulse
            output has ended.
        overrides_done: overrides_done() returns True if all overrides whose triggers have occurred are
            processed and no alarm is pending; in state ABN, it always returns True. If an override has ended
            the pulses at its position, the motion ends only when the function returns True.
        abnormal: abnormal() returns True in state ABN.

    Attributes:
        run_level: level of RUN that decisions at this edge use.
        end_monitored: True if a motion waits for END.
        run_ignored: True if RUN is ignored (setting CWS).
        speed_limit: rate HSL, which applies at the high-speed limits.
        last_cause: cause of the last stop report.
    """

    def __init__(
        self,
        context: Context,
        core_timing: CoreTiming,
        pins: Mapping[str, int],
        outputs: Outputs,
        counters: Counters,
        responses: Responses,
        on_pulse: Callable[[int, int], bool],
        alarm: Callable[[int, Alarm], None],
        on_pulses_ended: Callable[[int], None],
        overrides_done: Callable[[], bool],
        abnormal: Callable[[], bool],
    ) -> None:
        self._context, self._core_timing, self._pins = context, core_timing, pins
        self._outputs, self._counters, self._responses = outputs, counters, responses
        self._alarm, self._on_pulses_ended, self._abnormal = alarm, on_pulses_ended, abnormal
        self.motion = Motion(
            context,
            core_timing,
            pins,
            lambda: self.speed_limit,
            self._count,
            on_pulse,
            overrides_done,
            self._pulses_ended,
        )
        self._on_position: Callable[[int], None] = on_pulses_ended
        self.speed_limit = 0xFFFF
        self.end_monitored = self.run_ignored = False
        self.run_level = context.levels["run"]
        self._waiting_for_run: MotionRequest | None = None
        self._end_wait: Cause | None = None
        self._alarm_at = -1
        self.last_cause: Cause | None = None

    # ------------------------------------------------------------------ state

    @property
    def state(self) -> State | None:
        """State ACC, FIX or WRN; `None` at standstill."""
        if self._waiting_for_run:
            return State.WRN
        if self.motion.in_table:
            return State.ACC
        return State.FIX if self.motion.busy or self.waits_for_end else None

    @property
    def waits_for_end(self) -> bool:
        """True while the operation waits for END."""
        return self._end_wait is not None

    @property
    def at_standstill(self) -> bool:
        """True if the pulse output is inactive."""
        return not self.motion.busy

    def _count(self, t: int, direction: int) -> None:
        """Count a pulse in POS."""
        self._counters.count_pulse(direction)
        self._on_position(t)

    # ------------------------------------------------------------------ start

    def is_start_blocked(self, request: MotionRequest) -> bool:
        """Return True if a limit forbids the start (P312-INP-11)."""
        slow = not self._pins[SLOW_LIMITS[request.direction]] and request.target <= self.speed_limit
        return not self._pins[LIMITS[request.direction]] or slow

    @property
    def may_run(self) -> bool:
        """True if RUN is high or not monitored."""
        return bool(self.run_level) or self.run_ignored

    def start(self, t: int, request: MotionRequest) -> bool:
        """Start at t0, or change to state WRN; return True if the operation waits for RUN."""
        if self.may_run:
            self._begin(t, request)
            return False
        self._waiting_for_run = request
        return True

    def check_run(self, t: int) -> None:
        """Process a change of RUN or of its monitoring."""
        if self._waiting_for_run and self.may_run:
            self._context.queue.at(t + self._core_timing.run_to_t0, Phase.BEGIN, self._release)

    def _release(self, t: int) -> None:
        if self._waiting_for_run is None or not self.may_run:
            return
        if not self._responses.report(t, responses312.HOLD, Answer.HOLD_EXECUTED):
            self._alarm(t, Alarm.INTERLOCK_OR_HOLD)
        request, self._waiting_for_run = self._waiting_for_run, None
        self._begin(t, request)

    def _begin(self, t: int, request: MotionRequest) -> None:
        self._outputs.begin()
        self._on_position(t)
        self.motion.start(t, request)

    # ------------------------------------------------------------------ stops

    def stop(self, t: int, cause: Cause = Cause.STOP) -> None:
        """Process instruction 80, or the alarm of a multiple occurrence or of alm_n."""
        if cause is Cause.ALARM:
            self._alarm_at = t
        if self._waiting_for_run:
            self._waiting_for_run = None
            self._report(t, cause)
        elif self._end_wait is not None and cause is Cause.ALARM:
            self._context.queue.at(t + 1, Phase.QUEUE, self._leave_end_wait)
        else:
            self.motion.stop(t, cause)

    def slow_stop(self, t: int) -> None:
        """Process instruction 81."""
        self.motion.slow_stop(t)

    def change(self, t: int, change: Change) -> None:
        """Process instruction 87 or 88."""
        self.motion.change(t, change)

    # ------------------------------------------------------------------ end

    def _pulses_ended(self, t: int, cause: Cause) -> None:
        if cause is Cause.RETURN:
            self._start_phase_2(t)
            return
        self._outputs.pulses_ended(t)
        # In state ABN, a motion ends without a wait for END, for any cause of the end. If ABN begins at this
        # edge, the wait ends immediately.
        waits = self.end_monitored and cause is not Cause.ALARM and self._pins["end_n"]
        if waits and not (self._abnormal() and self._alarm_at < t):
            self._end_wait = cause
            if self._abnormal():
                self._context.queue.at(t + 1, Phase.QUEUE, self._leave_end_wait)
        else:
            self._report(t, cause)
        self._on_pulses_ended(t)

    def _start_phase_2(self, t: int) -> None:
        """Process t0 of phase 2."""
        request = self.motion.request
        table = request.plan.table
        rate = table.rates[table.sa]
        self._begin(
            t, MotionRequest(constant(table, rate), 1 - request.direction, rate, True, False, request.index)
        )

    def check_end(self, t: int) -> None:
        """Process a change of end_n or of its monitoring."""
        if self._end_wait is not None and (not self.end_monitored or not self._pins["end_n"]):
            self._leave_end_wait(t)

    def _leave_end_wait(self, t: int) -> None:
        cause, self._end_wait = self._end_wait, None
        if cause is not None:
            self._report(t, cause)

    def _report(self, t: int, cause: Cause) -> None:
        self._context.queue.at(t + self._core_timing.report, Phase.END, lambda at: self._store(at, cause))

    def _store(self, t: int, cause: Cause) -> None:
        position = self._counters.pulse.to_bytes(4, "big")
        self.last_cause = cause
        if not self._responses.report(t, responses312.STOPPED, Answer.STOPPED, cause, position):
            self._alarm(t, Alarm.STOPPED)
