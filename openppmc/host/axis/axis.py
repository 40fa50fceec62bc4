"""One axis of a part: the motions and registers that are the same on all parts."""

from __future__ import annotations

from ...model.motion.codes import (
    ACC_DEC,
    CONSTANT,
    CONTINUOUS,
    ENDLESS,
    HIGH_SPEED,
    ORIGIN,
    SINGLE_STEP,
)
from ..basis import units
from ..basis.ending import Cause, End
from ..basis.errors import OutOfRange
from ..basis.kind import PULSE_ONLY
from ..basis.refusals import AlreadyDecelerating, NothingToStop
from ..bridge.script import Script
from .core import AxisCore
from .homing import Homing
from .motion import READ_FINISH, Motion, Order
from .moves import Moves, OnProgress

CW, CCW = 0, 1
STOP_NOW, STOP_SLOWLY = 0x40, 0x41


class Axis(Moves, AxisCore):
    """One axis. Directions: 0 or CW, 1 or CCW. Speeds in pulses per second, pulses signed, CW positive.

    Any method may raise LinkErrors; commands raise the part's CommandRefused errors. A part says how its
    straps are set, where its switches are read, and what else it has.
    """

    # ------------------------------------------------------------------ for the parts

    def look(self, status: int) -> None:
        """The status register was read during a motion of this axis."""

    def order_stop(self, now: bool) -> None:
        """The stop command, with or without a ramp. Raises what the part says about it."""
        self.link.execute(Script().call((STOP_NOW if now else STOP_SLOWLY) | self.bit))

    def brake(self, now: bool = False) -> None:
        """Stop a motion that this object started, without waiting; fine if its end is near or gone by."""
        try:
            self.order_stop(now)
        except (AlreadyDecelerating, NothingToStop):
            pass

    # ------------------------------------------------------------------ motions

    def start_move(self, pulses: int, pulse_only: bool = False) -> Motion:
        """Begin a move with ramps: 1 to 16 777 216 pulses either way. pulse_only: phases stand still."""
        return self.start(self.move_order(pulses, pulse_only=pulse_only))

    def start_constant(self, pulses: int, pps: units.Number) -> Motion:
        """Begin a move at constant speed, without ramps."""
        return self.start(self.move_order(pulses, pps))

    def jog(
        self,
        direction: int,
        speed: units.Number | None = None,
        high: bool = False,
        pulse_only: bool = False,
    ) -> Motion:
        """Run until a stop, a limit or the alarm. speed: constant, in pps, default the start speed; high:
        with a ramp to the high speed."""
        if high:
            if speed is not None:
                raise OutOfRange("jog: either a speed or high, not both")
            return self.start(Order(HIGH_SPEED, direction, pulse_only=pulse_only))
        clock, rate = self._rate(speed)
        return self.start(Order(CONTINUOUS, direction, bytes([rate]), clock=clock))

    def search(self, direction: int, pps: units.Number | None = None) -> Motion:
        """Run at constant speed until the origin switch (or a stop, a limit, the alarm)."""
        clock, rate = self._rate(pps)
        return self.start(Order(ORIGIN, direction, bytes([rate]), clock=clock))

    def step(self, direction: int) -> End:
        """One pulse."""
        return self.start(Order(SINGLE_STEP, direction, asked=1)).wait().check(1)

    def home(
        self,
        direction: int = CCW,
        search_pps: units.Number | None = None,
        fast: bool = False,
        to_limit: bool = False,
        back_off: int = 100,
        progress: OnProgress | None = None,
    ) -> End:
        """Find the origin switch from the far side and make its edge position 0.

        direction: towards the switch. search_pps: default the start speed. fast: first at high speed to the
        slow-down limit; to_limit: on to the hard limit, then search from there. back_off: pulses of each step
        off the switch when the search would begin on it. Raises OriginNotFound, LimitReached, AlarmStop,
        StoppedEarly.
        """
        return Homing(self, direction, search_pps, back_off, progress).run(fast, to_limit)

    def stop(self, wait: bool = True) -> End | None:
        """Stop with a ramp (constant speeds: at once). Returns the End, None if not waited for.

        A motor that decelerates already or has just come to rest is fine; NothingToStop if it was at rest.
        """
        return self._stop(False, wait)

    def halt(self, wait: bool = True) -> End | None:
        """Stop at once; steps may be lost at high speed. As `stop` otherwise."""
        return self._stop(True, wait)

    def _stop(self, now: bool, wait: bool) -> End | None:
        motion = self._motion
        if motion is None or motion.over:
            # Perhaps one that another program started.
            motion = Motion(self, Order(CONTINUOUS, CW), 0, ours=False)
            self.order_stop(now)
        else:
            self.brake(now)
        self._motion = motion
        return motion.wait() if wait else None

    # ------------------------------------------------------------------ starting

    def move_order(self, pulses: int, pps: units.Number | None = None, pulse_only: bool = False) -> Order:
        """A move with ramps, or at a constant speed. OutOfRange for what the part cannot do."""
        direction = CCW if pulses < 0 else CW
        if not 1 <= abs(pulses) <= ENDLESS:
            raise OutOfRange(f"{pulses} pulses: a move has 1 to {ENDLESS} pulses either way")
        data = (abs(pulses) - 1).to_bytes(3, "little")
        if pps is None:
            return Order(ACC_DEC, direction, data, abs(pulses), pulse_only=pulse_only)
        clock, rate = self._rate(pps)
        return Order(CONSTANT, direction, bytes([rate]) + data, abs(pulses), clock)

    def start(self, order: Order) -> Motion:
        """One frame: a pending interrupt away, straps, counter, the command."""
        if order.pulse_only:
            self.kind.need(PULSE_ONLY)
        code = order.code | self.bit
        script = Script().call(READ_FINISH | self.bit).get(1)
        self.where(script.extend(self.straps(self.clock_of(order)))).call(code, *order.data)
        self.link.forget_events()
        answer = self.link.execute(script)
        return self.started(order, answer.number(2, signed=True))

    def started(self, order: Order, begin: int) -> Motion:
        """The part has taken the order; `begin`: pulse counter before."""
        self._motion = Motion(self, order, begin)
        return self._motion

    def clock_of(self, order: Order) -> units.BaseClock | None:
        """Its base clock; None if nobody knows."""
        if order.clock is not None:
            return order.clock
        return None if self.setup is None else self.setup.clock

    def nothing_to_move(self) -> End:
        """The End of a move of 0 pulses."""
        return self.told(End(Cause.COMPLETE, 0, 0, self.counted(self._count()), 0))
