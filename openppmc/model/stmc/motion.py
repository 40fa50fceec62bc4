"""What is special in the motion of the STMC: STMC-MOT, -CLK, -DEC, -IN, -DS.

Divisors: a gap of x ticks is an interval of rate x - 1 on a base clock of 1280 crystal periods, so the
family's ramp and rate counter serve as they are (STMC-INI-01, STMC-RMP-01). There is no pulse output: a
motion is over with its last step (STMC-MOT-08). An operation that starts while its deceleration limit is
active makes one step (STMC-DEC-03); at the start-up speed a request ends it at once.
"""

from __future__ import annotations

from ..common.blocks import Context
from ..motion.chopper import Chopper
from ..motion.codes import FINISH_SLOW, FINISH_STOP, ORIGIN, Command
from ..motion.excitation import Excitation
from ..motion.guard import Seen
from ..motion.motion import Setup
from ..motion.ramp import BaseClock
from ..single.hostport import HostPort
from ..single.timed_motion import TimedMotion
from .codes import TICK_XT
from .pins import GUARD


class Motion(TimedMotion):
    """The axis of an STMC. hold_xt: crystal periods from the fall of BUSY to `hold`."""

    stops_at_start_speed = True

    def __init__(
        self, context: Context, port: HostPort, excitation: Excitation, chopper: Chopper, hold_xt: int
    ) -> None:
        super().__init__(context, port, excitation, chopper, GUARD)
        self.hold_cycles = hold_xt
        self.finish = 0x80

    # ------------------------------------------------------------------ start

    def _latch_operation(self, command: Command, data: list[int], setup: Setup) -> None:
        """data: as written, divisor before count."""
        rated = [data[0] - 1, *data[1:]] if data and command.operation in (4, 5, 7) else data
        self._load(command, rated, setup, csel=1, plain=True)
        self._clock = BaseClock(TICK_XT // self._context.timebase.quantum)

    # ------------------------------------------------------------------ stops and inputs

    def slow_stop(self, t: int, reference: int) -> None:
        """Command 1 in state S or A of commands 3 and 6 (STMC-STP-03, STMC-DS-11)."""
        self._request(t, "flag", FINISH_STOP)

    def _seen(self, t: int) -> Seen:
        """Command 7 ends at its deceleration limit, too (STMC-IN-04, ruling R-19)."""
        seen = super()._seen(t)
        if self.operation == ORIGIN and seen.slow:
            return Seen(seen.bits | FINISH_SLOW, seen.origin)
        return seen

    # ------------------------------------------------------------------ steps and end

    def _begin_low(self, t: int, rate: int | None, gap: int | None) -> None:
        """No pulse output."""

    def _train_over(self, t: int) -> None:
        if self._context.datasheet:
            super()._train_over(t)
        else:
            self._plan_end(t)
