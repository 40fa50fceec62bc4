"""Motions of a PMC006B4."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ..axis import OnProgress
from ..check import whole, within
from ..ending import Cause, OriginNotFound
from ..errors import CommandRefused, NoAnswer, NothingToStop, NotWhileBusy, OutOfRange, StartRefused
from ..motion import Progress
from .motion import End, Motion
from .settings import Settings, mean_acceleration
from .wire import Code, Flags, MotorFree, SpeedRefused, locked

FORWARD, BACKWARD = 1, -1
LONGEST = 0x7FFFFFFF
_ACCEPTED, _RUNNING = 3, 1


class Axis(Settings):
    """See `pmc006.Pmc006`. Steps are microsteps of the setting in force, forward positive."""

    _motion: Motion | None = None

    @property
    def motion(self) -> Motion | None:
        """The motion that was started last, None before the first."""
        return self._motion

    # ------------------------------------------------------------------ motions

    def start_move(self, steps: int, speed: int | None = None) -> Motion:
        """Begin a move of 1 to 2^31 - 1 steps either way. speed: maximum from now on, in steps/s."""
        if not 1 <= abs(steps) <= LONGEST:
            raise OutOfRange(f"{steps} steps: a move has 1 to {LONGEST} steps either way")
        return self._start(Code.STEP, abs(steps), (_ACCEPTED, abs(steps)), _side(steps), speed)

    def move(self, steps: int, speed: int | None = None, progress: OnProgress | None = None) -> End:
        """Move and wait. Raises LimitReached (EXT), AlarmStop (stall), StoppedEarly if it ends early."""
        if steps == 0:
            return End(Cause.COMPLETE, 0, 0, self.position, 0, self.who)
        end = self.start_move(steps, speed).wait(progress=progress)
        end.check(abs(steps))
        return end

    def move_to(self, position: int, speed: int | None = None, progress: OnProgress | None = None) -> End:
        """Move to a position and wait."""
        return self.move(position - self.position, speed, progress)

    def jog(self, direction: int, speed: int | None = None) -> Motion:
        """Run (speed mode) until a stop, EXT or a stall. direction: FORWARD or BACKWARD. speed: maximum from
        now on, in steps/s."""
        if direction not in (FORWARD, BACKWARD):
            raise OutOfRange(f"direction {direction} is neither 1 (FORWARD) nor -1 (BACKWARD)")
        return self._start(Code.RUN, 1, (_RUNNING,), direction, speed)

    def change_speed(self, speed: int) -> None:
        """Another maximum speed, for a motion that runs too: it gets there by its ramps."""
        self.max_speed = speed

    def stop(self, wait: bool = True) -> End | None:
        """Stop with a ramp; returns the End, None if not waited for. NothingToStop at rest.

        A free run is told to stop. The part has no such instruction for moves: those of 256 steps and more
        get a low maximum speed first and are ended at once when they have come down to it.
        """
        return self._stop(False, wait)

    def halt(self, wait: bool = True) -> End | None:
        """Stop at once; steps may be lost at high speed. As `stop` otherwise."""
        return self._stop(True, wait)

    def brake(self, now: bool = False) -> None:
        """Stop a motion that this object started, without waiting for its end: a free run with its ramp,
        a move at once."""
        motion = self._motion
        if motion is None or motion.over:
            return
        motion.stop_ordered = True
        if now or motion.asked is not None:
            self.ask(Code.ABORT, good=lambda value: value == 0)
        else:
            self._end_run()

    # ------------------------------------------------------------------ stops and flags

    def enable_stops(self, ext1: bool = True, ext2: bool = True) -> None:
        """Which EXT inputs stop the motor; none does after power-up."""
        self.stops = int(ext1) | int(ext2) << 1

    def clear_stops(self, numbers: Iterable[int] = (1, 2)) -> None:
        """Clear EXT flags, so that the motor may start again. Nothing moves."""
        for number in numbers:
            code = Code.CLEAR_EXT2 if _ext(number) == 2 else Code.CLEAR_EXT1
            self.ask(code, good=lambda value: value == 0)

    def clear_stall(self) -> None:
        """Clear the stall flag, and with it the pull on GPO5."""
        self.ask(Code.CLEAR_STALL, good=lambda value: value == 0)

    def on_switch(self, number: int) -> bool:
        """Whether EXT1 or EXT2 has its active level, which its trigger setting tells."""
        rising = bool(self.trigger >> _ext(number) - 1 & 1)
        return self.ports().level(number) is rising

    # ------------------------------------------------------------------ position

    def set_position(self, position: int) -> None:
        """Here is this position, -2^31 to 2^31 - 1. Only at rest (NotWhileBusy)."""
        within(position, "position", -(1 << 31), (1 << 31) - 1)
        self._at_rest(self.flags())
        self.ask(Code.SET_POSITION, position, good=lambda value: value == position)

    def zero(self) -> None:
        """Here is position 0. Only at rest."""
        self.set_position(0)

    # ------------------------------------------------------------------ inside

    def _start(
        self, code: Code, data: int, replies: tuple[int, ...], direction: int, speed: int | None
    ) -> Motion:
        self._at_rest(self.flags())
        if speed is not None:
            self.max_speed = speed
        self.direction = int(direction == FORWARD)
        begin = self.position
        if begin < 0 < direction:
            self.remember("max_speed")  # shows a reset in a motion that ends at 0
        motion = Motion(self, data if code is Code.STEP else None, direction, begin)
        got = self.ask(
            code,
            data,
            good=lambda value: value == 0 or value in replies,
            settle=lambda: self._begun(begin, replies[0]),
            risky=True,
        )
        if got == 0:
            raise self._why_not(code)
        self._motion = motion
        return motion

    def _begun(self, begin: int, reply: int) -> int | None:
        """The reply to a start was lost: whether the motor moves or has moved. It rested before."""
        try:
            return reply if self.flags().busy or self.position != begin else None
        except NoAnswer as error:
            raise self.lost(str(error)) from error

    def _at_rest(self, flags: Flags) -> None:
        if flags.busy:
            raise NotWhileBusy(0, f"{self.who}the motor is moving: wait for its end or stop it first")

    def _why_not(self, code: Code) -> CommandRefused:
        """What has made the part refuse a start."""
        flags = self.flags()
        if flags.stops:
            return locked(flags.stops, self.who)
        if self.free:
            return MotorFree(0, f"{self.who}{MotorFree.text}")
        top, start, stop = self.max_speed, self.start_speed, self.stop_speed
        if code is Code.STEP and max(start, stop) > top:
            return SpeedRefused(
                0,
                f"{self.who}the maximum speed of {top} steps/s is below the start speed ({start}) or the "
                f"stop speed ({stop}): raise it, or lower those",
            )
        if code is Code.RUN and not top:
            return SpeedRefused(0, f"{self.who}the maximum speed is 0: set one")
        if flags.busy:
            return NotWhileBusy(0, f"{self.who}another program has started the motor: wait, or stop it")
        return StartRefused(
            0, f"{self.who}the part refused to start, but nothing is in the way now: try again"
        )

    def _stop(self, now: bool, wait: bool) -> End | None:
        motion = self._motion
        if motion is None or motion.over:
            motion = self._strange()
        motion.stop_ordered = True
        if now:
            self.ask(Code.ABORT, good=lambda value: value == 0)
        elif motion.asked is None:
            self._end_run()
        else:
            self._slow_move(motion)
        self._motion = motion
        return motion.wait() if wait else None

    def _strange(self) -> Motion:
        """A motion of another program. NothingToStop at rest."""
        if not self.flags().busy:
            raise NothingToStop(0, f"{self.who}nothing to stop: the motor is at rest")
        running = self.modes().running
        return Motion(self, None if running else LONGEST, FORWARD, None)

    def _end_run(self) -> None:
        self.ask(Code.RUN, 0, good=lambda value: value == 0)

    def _slow_move(self, motion: Motion) -> None:
        """Bring a move down to its stop speed; `Motion.look` ends it then."""
        top, low = self.max_speed, self.stop_speed
        if top <= low:
            motion.slow_down(0, top)
            return
        self.max_speed = low
        motion.slow_down((top - low) / mean_acceleration(self.deceleration), top)


def _side(steps: int) -> int:
    return BACKWARD if steps < 0 else FORWARD


def _ext(number: int) -> int:
    number = whole(number, "EXT")
    if number not in (1, 2):
        raise OutOfRange(f"EXT{number}: there are EXT1 and EXT2")
    return number


# Finding a reference point with a PMC006B4: its EXT switches are the only ones that it has.

LONGEST_WAY_OFF = 200_000
SLOWEST, FASTEST = 65, 3000
_KEPT = ("stops", "direction", "start_speed", "stop_speed", "max_speed")


class Homing:
    """One homing run of a controller; see `pmc006.Pmc006.home`."""

    def __init__(
        self,
        axis: Axis,
        switch: int,
        direction: int,
        speed: int,
        slow: int,
        off: int,
        progress: Callable[[Progress], None] | None,
    ) -> None:
        for name, pps in (("speed", speed), ("slow", slow)):
            within(pps, name, SLOWEST, FASTEST, "steps/s")
        within(off, "off", 1, LONGEST_WAY_OFF, "steps")
        if switch not in (1, 2):
            raise OutOfRange(f"EXT{switch}: there are EXT1 and EXT2")
        self._axis, self._switch, self._direction = axis, switch, direction
        self._speed, self._slow, self._off, self._progress = speed, slow, off, progress

    def run(self) -> End:
        """Off the switch if need be, towards it, off, slowly towards it again, off; zero. Speeds, direction
        and enabled stops are afterwards as they were."""
        axis = self._axis
        before = {name: getattr(axis, name) for name in _KEPT}
        try:
            axis.clear_stops()
            axis.stops = 3  # the other one, too: this may be the wrong way
            if axis.on_switch(self._switch):
                self._leave()
            else:
                self._approach(self._speed)
                self._leave()
            self._approach(self._slow)
            end = self._leave()
            axis.zero()
            return end.at(0)
        finally:
            if axis.motion is None or axis.motion.over:
                for name, value in before.items():
                    setattr(axis, name, value)

    def _pace(self, speed: int) -> None:
        """No ramps: the way from the switch's edge to rest is always the same."""
        self._axis.start_speed = self._axis.stop_speed = self._axis.max_speed = speed

    def _approach(self, speed: int) -> None:
        """Run until the switch stops the motor, and clear its flag."""
        axis = self._axis
        self._pace(speed)
        end = axis.jog(self._direction).wait(progress=self._progress)
        stops = axis.flags().stops
        if self._switch not in stops:
            other = " and ".join(f"EXT{number}" for number in stops) or end.why
            raise OriginNotFound(
                f"{axis.who}{other} came before EXT{self._switch}: home in the other direction, or check the "
                "switch",
                end,
            )
        axis.clear_stops(stops)

    def _leave(self) -> End:
        """Away from the switch in moves of the same length until it is released."""
        axis, gone = self._axis, 0
        self._pace(self._slow)
        while True:
            end = axis.move(-self._direction * self._off, progress=self._progress)
            gone += self._off
            if not axis.on_switch(self._switch):
                return end
            if gone > LONGEST_WAY_OFF:
                raise OriginNotFound(
                    f"{axis.who}EXT{self._switch} is still active {gone} steps away from where it was: check "
                    "it",
                    end,
                )
