"""Motion of an axis of the bank, where it differs from the PPMC-104 (BANK-MOT, BANK-GRP).

The bank processes its axes in turn; a visit is an edge of `clk` at which it processes an axis. Decisions are
made, and events are detected, at visits. Pins change at the edges of their events. A motion is *cut* at the
edge that ends it; the first visit after END_LEAD cycles detects the cut. Until this visit, the pulse engine
continues unchanged (BANK-MOT-03). A pulse that is scheduled in this time is *cancelled*: it is never output,
but the engine counts it until this visit.
"""

from __future__ import annotations

from collections.abc import Mapping

from .. import ppmc104
from ..chip import Context, Phase
from ..motion.codes import FINISH_SLOW, FINISH_STOP, ActiveCauses, Command, inspect
from ..motion.excitation import Excitation
from ..motion.motion import Setup
from ..ppmc104 import GUARD
from ..single.hostport import BytePort, SpeedGate
from .chopper import END_LEAD, GROUP_LEAD, Chopper, VisitSchedule
from .group import Group


class Motion(ppmc104.Motion):
    """Motion of the axis with the number `axis`.

    Args:
        switches: current levels of the switches; context.levels holds the levels that are effective at a
            visit.

    Attributes:
        waits_for_go: True if the operation has been accepted and is waiting for GO (BANK-GRP-01).
        ended: visit that ended the last motion; -1 before the first.
    """

    def __init__(
        self,
        context: Context,
        port: BytePort,
        excitation: Excitation,
        chopper: Chopper,
        visits: VisitSchedule,
        switches: Mapping[str, int],
        group: Group,
        axis: int,
    ) -> None:
        super().__init__(context, port, SpeedGate(lambda t: None), excitation, chopper)
        self._visits, self._switches, self._group, self._axis = visits, switches, group, axis
        self._schedules_edge = chopper.schedules_edge
        self.waits_for_go = False
        self.ended = -1
        self._cut: int | None = None
        self._stopped = -1
        self._cancelled = 0
        self._next_pulse: int | None = None
        self._position = 0

    # ------------------------------------------------------------------ start

    def start(self, t: int, command: Command, data: list[int], setup: Setup, reference: int) -> None:
        """Start an operation at the visit that accepts its last byte (BANK-MOT-01, BANK-GRP-01, -04)."""
        self._latch_operation(command, data, setup)
        self._begin(t)
        self.waits_for_go = self.in_group
        if not self.waits_for_go:
            self._arm(t + self._context.timebase.w)
        if self._group.stops(t):
            self._context.queue.at(t + 1, Phase.COMMAND, self.halt)
        self.schedule_slow_check(t + 1)

    @property
    def in_group(self) -> bool:
        """True if the MASK bit of this axis is set, with its value that is effective at the current visit."""
        return self._group.includes(self._axis)

    def release(self, go: int) -> None:
        """Start the pulses of a waiting operation.

        Pulse 1 is output only after the GO has become effective in all axes (BANK-GRP-02).
        """
        self.waits_for_go = False
        self._arm(go + GROUP_LEAD - 1 + self._visits.round + self._context.timebase.w)

    # ------------------------------------------------------------------ stops and inputs

    def stop(self, t: int) -> None:
        """Process an immediate stop accepted at visit t.

        This visit schedules no pulse and ignores the slow-down limit (BANK-MOT-05). If the end of the motion
        was decided before t, the stop adds no finish bit (BANK-MOT-03).
        """
        self._stopped = t
        if self._cut is None:
            super().stop(t)
        elif self._cut == t:
            self._stop_bits |= FINISH_STOP
        if not self.finishing:
            self._cancel("pulse")

    def halt(self, t: int) -> None:
        """Process STOP at edge t for a running motion (BANK-GRP-04)."""
        super().stop(t)

    def check_stops(self, t: int) -> None:
        """Check the stop causes at edge t. The first decision to end the motion is final (BANK-MOT-02)."""
        if self._cut is None:
            super().check_stops(t)

    def _active_causes(self, t: int) -> ActiveCauses:
        return inspect(GUARD, self._switches, self.operation, self.direction)._replace(slow=False)

    def schedule_slow_check(self, edge: int) -> None:
        """Schedule the check of an active slow-down limit at the first visit at or after `edge`."""
        if self.busy and self.is_ramp and self._slow_active():
            self._context.queue.at(self._visits.first(edge), Phase.GUARD, self._check_slow_limit)

    def _slow_active(self) -> bool:
        return not self._context.levels[GUARD.slow_limits[self.direction]]

    def _check_slow_limit(self, t: int) -> None:
        """Check the slow-down limit at visit t (BANK-MOT-05)."""
        if not self.busy or self.finishing or t <= self._began or t == self._stopped:
            return
        if self.is_ramp and self._slow_active() and self._slow_limit_effective():
            self._request(t, "slow", FINISH_SLOW)

    def _interval_begun(self, t: int) -> None:
        if self._command.pulse_only and self.high:
            self.schedule_slow_check(t + 1)

    # ------------------------------------------------------------------ pulses

    def position(self, after: int) -> int:
        """Return the value of the position register after an edge (BANK-WIN-07)."""
        next_pulse = self._next_pulse
        scheduled = next_pulse is not None and self._visits.last(next_pulse) <= after < next_pulse
        return self._position + (self._step if scheduled else 0)

    @property
    def _step(self) -> int:
        return -1 if self.direction else 1

    def _plan_pulse(self, edge: int) -> None:
        self._next_pulse = edge
        super()._plan_pulse(edge)

    def _cancel(self, name: str) -> None:
        if name == "pulse":
            self._next_pulse = None
        super()._cancel(name)

    def _output_pulse(self, t: int, rate: int | None, gap: int | None) -> None:
        self._position += self._step
        if self._cut is None:
            super()._output_pulse(t, rate, gap)
        else:
            self._cancelled += 1

    # ------------------------------------------------------------------ end

    def _end_now(self, t: int, bits: int) -> None:
        """Cut the motion: no pulse is output from edge t on.

        A later visit detects the cut (BANK-MOT-02, -03).
        """
        self._cut, self._stop_bits = t, bits
        self._context.queue.at(self._visits.first(t + END_LEAD), Phase.CHOPPER, self._detect_cut)

    def _detect_cut(self, t: int) -> None:
        """Process visit t, which detects the cut.

        A low time that has already begun is completed (BANK-MOT-04).
        """
        self.finishing = True
        self._cancel("pulse")
        if self._cancelled:
            self.done -= self._cancelled
            self._position -= self._cancelled * self._step
            del self.intervals[self.done :]
            self._cancelled = 0
        if not self.low:
            self._finish(t)

    def _plan_end(self, low_ended: int) -> None:
        """Clear BUSY at the first visit after the low time (BANK-MOT-04).

        The low time is longer than END_LEAD cycles.
        """
        self._context.queue.at(self._visits.first(low_ended + 1), Phase.CHOPPER, self._finish)

    def _finish(self, t: int) -> None:
        super()._finish(t)
        self.waits_for_go, self._cut = False, None
        self.ended = t

    def _plan_hold(self, edge: int) -> None:
        super()._plan_hold(self._visits.first(edge))

    def _set_hold(self, t: int) -> None:
        """Set HOLD at the first visit that schedules no edge of the chopper (BANK-HLD-01)."""
        if self._schedules_edge(t):
            self._plan_hold(t + 1)
        else:
            super()._set_hold(t)
