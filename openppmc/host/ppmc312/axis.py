"""The motions of a PPMC-312, whatever carries its instructions."""

from __future__ import annotations

from ..axis.axis import CCW, CW
from ..axis.moves import Moves, OnProgress
from ..basis import units
from ..basis.ending import Cause, End
from ..basis.kind import PULSE_ONLY
from ..basis.refusals import NothingToStop
from . import blocks
from .core import MotionT
from .homing import Homing
from .overrides import Overrides


class Axis(Moves, Overrides[MotionT]):
    """See `ppmc312.Ppmc312`."""

    # ------------------------------------------------------------------ motions

    def start_move(self, pulses: int, pulse_only: bool = False) -> MotionT:
        """Begin a move with ramps: 1 to 2^32 - 1 pulses either way."""
        if pulse_only:
            self.kind.need(PULSE_ONLY)
        return self._start(self.move_block(pulses), _side(pulses), abs(pulses))

    def start_constant(self, pulses: int, pps: units.Number) -> MotionT:
        """Begin a move at constant speed, without ramps."""
        return self._start(self.move_block(pulses, pps), _side(pulses), abs(pulses))

    def nothing_to_move(self) -> End:
        """The End of a move of 0 pulses."""
        return self.told(End(Cause.COMPLETE, 0, 0, self.position, 0))

    def jog(
        self,
        direction: int,
        speed: units.Number | None = None,
        high: bool = False,
        pulse_only: bool = False,
    ) -> MotionT:
        """Run until a stop, a limit or the alarm. speed: constant, in pps, default the start speed; high:
        with a ramp to `speed`, default the high speed."""
        if pulse_only:
            self.kind.need(PULSE_ONLY)
        if high:
            rate = 0 if speed is None else self.rate_of(speed)
        else:
            rate = self._search_rate(speed)
        return self._start(blocks.run(direction, rate, high), direction)

    def step(self, direction: int) -> End:
        """One pulse."""
        return self._start(blocks.single_step(direction), direction, 1).wait().check(1)

    def search(self, direction: int, pps: units.Number | None = None, index: bool = False) -> MotionT:
        """Run at constant speed (default: start speed) until the origin, or until the index on it."""
        return self._start(blocks.origin_search(direction, self._search_rate(pps), index), direction)

    def zero_return(self, direction: int, pps: units.Number | None = None, index: bool = False) -> MotionT:
        """Run at high speed (or pps) to the origin, slow down past it and come back to it at the start speed.
        Wants an origin switch that is active over a short way only."""
        rate = 0 if pps is None else self.rate_of(pps)
        return self._start(blocks.zero_return(direction, rate, index), direction)

    def home(
        self,
        direction: int = CCW,
        search_pps: units.Number | None = None,
        fast: bool = False,
        to_limit: bool = False,
        back_off: int = 100,
        progress: OnProgress | None = None,
        index: bool = False,
    ) -> End:
        """Find the origin switch from the far side and make its edge position 0.

        direction: towards the switch. search_pps: default the start speed. fast: first a zero return at high
        speed; to_limit: first to the slow-down limit at high speed and on to the hard limit. back_off: pulses
        of each step off the switch when the search would begin on it. index: the origin is the first index of
        the encoder on the switch. Raises OriginNotFound, LimitReached, AlarmStop, StoppedEarly.
        """
        return Homing(self, direction, search_pps, back_off, progress, index).run(fast, to_limit)

    # ------------------------------------------------------------------ while it runs

    def change_speed(self, pps: units.Number, ramped: bool = True) -> None:
        """Another speed of the table for the motion that runs: with a ramp (the speed must be constant now)
        or at once. NothingToStop at rest, NotWhileBusy on a ramp."""
        self.instruct(blocks.change(self.rate_of(pps), ramped))

    def stop(self, wait: bool = True) -> End | None:
        """Stop with a ramp. Returns the End, None if not waited for.

        A motor that has just come to rest is fine; NothingToStop if it was at rest, HeldByRun if the start
        still waits for RUN.
        """
        return self._stop(False, wait)

    def halt(self, wait: bool = True) -> End | None:
        """Stop at once; steps may be lost at high speed. As `stop` otherwise."""
        return self._stop(True, wait)

    def brake(self, now: bool = False) -> None:
        """Stop a motion that this object started, without waiting; fine if it has ended by itself."""
        try:
            self.instruct(blocks.immediate_stop() if now else blocks.slow_stop())
        except NothingToStop:
            self.window.collect()
            if self._motion is None or not self._motion.over:
                raise
        else:
            if self._motion is not None:
                self._motion.stop_ordered = True

    # ------------------------------------------------------------------ inside

    def _stop(self, now: bool, wait: bool) -> End | None:
        motion = self._motion
        if motion is None or motion.over:
            # Perhaps one that another program, an override or an event started.
            self._mark = self.window.answers
            self._motion, before = self._make_motion(None, CW, None), motion
            self._motion.stop_ordered = True
            try:
                self.instruct(blocks.immediate_stop() if now else blocks.slow_stop())
            except BaseException:
                self._motion = before
                raise
            motion = self._motion
        else:
            motion.stop_ordered = True
            self.brake(now)
        return motion.wait() if wait else None

    def _start(self, block: bytes, direction: int, asked: int | None = None) -> MotionT:
        """Start a motion; its end may be reported in the same message as its answer."""
        before, begin = self._motion, self.position
        self._mark = self.window.answers
        self._motion = motion = self._make_motion(asked, direction, begin)
        self.link.forget_events()
        try:
            data = self.instruct(block, 4)
        except BaseException:
            self._motion = before
            raise
        motion.accepted(data[0] if data else None)
        return motion

    def _search_rate(self, pps: units.Number | None) -> int:
        """Rate of a constant speed, by default the start speed that is really reached."""
        if pps is not None:
            return self.rate_of(pps)
        setup = self.known_setup()
        return setup.table.rates[setup.table.sa]

    @property
    def search_speed(self) -> units.Number:
        """Speed of searches and jogs that name none, in pps. OutOfRange without a setup."""
        setup = self.known_setup()
        return setup.clock.speed(setup.table.rates[setup.table.sa])


def _side(pulses: int) -> int:
    return CCW if pulses < 0 else CW
