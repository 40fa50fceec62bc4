"""What is special in the motion of a PPMC-2104 axis: RUN gate, stop at start-up speed, polled inputs.

RUN: P2104-OPR-02, -TIM-02. Stops: P2104-STP-01..05, -FDC-02. Inputs: P2104-LIM-03..09, in DATASHEET
P2104-DS-20, -21. The rest is the family's: `motion`.
"""

from __future__ import annotations

from ..common.blocks import Context, Phase
from ..motion import motion
from ..motion.chopper import Chopper
from ..motion.codes import FINISH_STOP, ORIGIN, Command
from ..motion.excitation import Excitation
from ..motion.guard import Seen
from ..motion.motion import OnEnd, Setup
from .pins import GUARD
from .windows import Windows

HOLD_UNIT, HOLD_DEFAULT = 2048, 0x18


class Motion(motion.Motion):
    """One axis of a PPMC-2104. `waiting`: state RUNWAIT."""

    stops_at_start_speed = True

    def __init__(
        self,
        context: Context,
        excitation: Excitation,
        chopper: Chopper,
        windows: Windows,
        on_end: OnEnd,
    ) -> None:
        super().__init__(context, excitation, chopper, GUARD, on_end)
        self._windows = windows
        self.waiting = False
        self._look_from = 0
        self._held_until: int | None = None
        self._judged_at = -1
        self.set_hold_delay(HOLD_DEFAULT)

    def set_hold_delay(self, n: int) -> None:
        """Hold delay of 128 (n + 1) us for timers that start from now on (P2104-AUX-05)."""
        self.hold_cycles = HOLD_UNIT * (n + 1)

    # ------------------------------------------------------------------ start

    def start(self, t: int, command: Command, data: list[int], setup: Setup, look_from: int) -> None:
        """C-event of an operation's last byte; RUN counts from edge `look_from` on."""
        self._load(command, data, setup, self._context.levels["csel"], plain=True)
        self._begin(t)
        self._held_until = None
        self.waiting, self._look_from = True, look_from
        if look_from > t:
            self._context.queue.at(look_from, Phase.RUN, self.look_at_run)
        else:
            self.look_at_run(t)

    def look_at_run(self, t: int) -> None:
        """RUNWAIT ends on the first edge that sees RUN = H."""
        if not self.waiting or self.finishing or t < self._look_from or not self._context.levels["run"]:
            return
        self.waiting = False
        self._arm(t + self._context.timebase.w + self._context.latency.start_extra)
        self._context.queue.at(t + 1, Phase.GUARD, self.judge)

    # ------------------------------------------------------------------ stops

    @property
    def can_decelerate(self) -> bool:
        """Whether a deceleration stop is accepted: START, ACC or HIGH of 011/110 (P2104-STP-02, -03)."""
        free = self._flag_edge is None and not self._natural
        return self.busy and self.is_ramp and not self.waiting and not self.finishing and free

    def slow_stop(self, at: int) -> None:
        """Deceleration stop that acts at edge `at`."""
        self._request(at, "flag", FINISH_STOP)

    def stop_until(self, t: int, end: int) -> None:
        """Immediate stop in DATASHEET: cut at edge t, all the rest at edge `end` (P2104-DS-02)."""
        if not self.finishing:
            self._held_until = end
        self.stop(t)

    # ------------------------------------------------------------------ inputs

    def _seen(self, t: int) -> Seen:
        seen = super()._seen(t)
        if not self._context.datasheet:
            return Seen(seen.bits, seen.origin and not self.waiting, seen.slow)
        if self._windows.is_tick(t):
            return Seen(seen.bits, False, seen.slow)
        tick = self._windows.next_tick(t)
        if (seen.bits or seen.slow) and tick != self._judged_at:
            self._judged_at = tick
            self._context.queue.at(tick, Phase.GUARD, self.judge)
        return Seen()

    def _next_rate(self, t: int) -> int | None:
        rate = super()._next_rate(t)
        origin = self.operation == ORIGIN and not self._context.levels[GUARD.origin]
        return None if self._context.datasheet and origin else rate

    # ------------------------------------------------------------------ end

    def _decided(self, t: int) -> None:
        if self._held_until is None:
            super()._decided(t)
        else:
            self._context.queue.at(self._held_until, Phase.BEGIN, self._finish)

    def _ends_with_low(self) -> bool:
        return self._held_until is None

    def _finish(self, t: int) -> None:
        self.waiting = False
        super()._finish(t)
