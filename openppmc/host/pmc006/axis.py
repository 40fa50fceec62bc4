"""Motions of a PMC006B4."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ..axis import OnProgress
from ..check import whole, within
from ..errors import AxisBusy, CommandRefused, NoAnswer, NothingToStop, OutOfRange, StartRefused
from ..motion import Progress
from ..motion_result import Cause, OriginNotFound
from .motion import Motion, MotionResult
from .settings import Settings, mean_acceleration
from .wire import Code, Flags, MotorDisabled, SpeedRefused, locked

FORWARD, BACKWARD = 1, -1
LONGEST = 0x7FFFFFFF
_ACCEPTED, _RUNNING = 3, 1


class Axis(Settings):
    """Motions of a PMC006B4; see `pmc006.Pmc006`.

    Steps are microsteps of the active setting, forward positive.
    """

    _motion: Motion | None = None

    @property
    def motion(self) -> Motion | None:
        """Motion that was started last, `None` before the first."""
        return self._motion

    # ------------------------------------------------------------------ motions

    def start_move(self, steps: int, speed: int | None = None) -> Motion:
        """Start a move of 1 to 2^31 - 1 steps in either direction.

        Args:
            speed: new maximum speed in steps/s.
        """
        if not 1 <= abs(steps) <= LONGEST:
            raise OutOfRange(f"{steps} steps: a move has 1 to {LONGEST} steps either way")
        return self._start(Code.STEP, abs(steps), (_ACCEPTED, abs(steps)), _side(steps), speed)

    def move(self, steps: int, speed: int | None = None, progress: OnProgress | None = None) -> MotionResult:
        """Move and wait for the end.

        Raises:
            LimitReached, AlarmStop, StoppedByCommand: an EXT stop, a stall or a stop command ended the move.
        """
        if steps == 0:
            return MotionResult(Cause.COMPLETE, 0, 0, self.position, 0, self._message_prefix)
        end = self.start_move(steps, speed).wait(progress=progress)
        end.check(abs(steps))
        return end

    def move_to(
        self, position: int, speed: int | None = None, progress: OnProgress | None = None
    ) -> MotionResult:
        """Move to a position and wait for the end."""
        return self.move(position - self.position, speed, progress)

    def jog(self, direction: int, speed: int | None = None) -> Motion:
        """Run in speed mode until a stop command, an EXT stop or a stall.

        Args:
            direction: FORWARD or BACKWARD.
            speed: new maximum speed in steps/s.
        """
        if direction not in (FORWARD, BACKWARD):
            raise OutOfRange(f"direction {direction} is neither 1 (FORWARD) nor -1 (BACKWARD)")
        return self._start(Code.RUN, 1, (_RUNNING,), direction, speed)

    def change_speed(self, speed: int) -> None:
        """Set the maximum speed.

        A motion in progress accelerates or decelerates to the new speed with the set ramps. A move of up to
        255 steps and a last ramp ignore the new speed.
        """
        self.max_speed = speed

    def stop(self, wait: bool = True) -> MotionResult | None:
        """Stop with a ramp; return the result, or `None` if wait is False.

        Speed mode has a stop instruction with a ramp. A move can only be aborted immediately. Therefore, the
        driver lowers the maximum speed to the stop speed, waits for the time of this ramp, aborts the move,
        and restores the maximum speed. A move of up to 255 steps ignores the new maximum speed, so it is
        aborted without a ramp.

        Raises:
            NothingToStop: the motor is stopped.
        """
        return self._stop(False, wait)

    def halt(self, wait: bool = True) -> MotionResult | None:
        """Stop immediately; steps may be lost at high speed.

        In all other respects, the method works like `stop`.
        """
        return self._stop(True, wait)

    def _request_stop(self, now: bool = False) -> None:
        """Stop the motion that this object started, without waiting for its end.

        A free run stops with its ramp, a move stops immediately.
        """
        motion = self._motion
        if motion is None or motion.over:
            return
        motion.stop_ordered = True
        if now or motion.requested is not None:
            self.execute(Code.ABORT, good=lambda value: value == 0)
        else:
            self._end_run()

    # ------------------------------------------------------------------ stops and flags

    def enable_stops(self, ext1: bool = True, ext2: bool = True) -> None:
        """Select the EXT inputs that stop the motor; after power-up no input does."""
        self.stops = int(ext1) | int(ext2) << 1

    def clear_stops(self, numbers: Iterable[int] = (1, 2)) -> None:
        """Clear the flags of EXT stops, so that the motor may be started again.

        The call itself does not start the motor.
        """
        for number in numbers:
            code = Code.CLEAR_EXT2 if _ext(number) == 2 else Code.CLEAR_EXT1
            self.execute(code, good=lambda value: value == 0)

    def clear_stall(self) -> None:
        """Clear the stall flag, which also releases GPO5."""
        self.execute(Code.CLEAR_STALL, good=lambda value: value == 0)

    def on_switch(self, number: int) -> bool:
        """Return True if EXT1 or EXT2 has its active level, which its trigger setting defines."""
        rising = bool(self.trigger >> _ext(number) - 1 & 1)
        return self.ports().level(number) is rising

    # ------------------------------------------------------------------ position

    def set_position(self, position: int) -> None:
        """Set the current position to this value, -2^31 to 2^31 - 1.

        Raises:
            AxisBusy: the motor is moving.
        """
        within(position, "position", -(1 << 31), (1 << 31) - 1)
        self._at_rest(self.flags())
        self.execute(Code.SET_POSITION, position, good=lambda value: value == position)
        self._known_position = position

    def zero(self) -> None:
        """Set the current position to 0. The motor must be stopped."""
        self.set_position(0)

    # ------------------------------------------------------------------ internal

    def _start(
        self, code: Code, data: int, replies: tuple[int, ...], direction: int, speed: int | None
    ) -> Motion:
        self._at_rest(self.flags())
        if speed is not None:
            self.max_speed = speed
        self.direction = int(direction == FORWARD)
        begin = self.position
        if begin < 0 < direction:
            self.remember("max_speed")  # to detect a reset during a motion to position 0
        motion = Motion(self, data if code is Code.STEP else None, direction, begin)
        got = self.execute(
            code,
            data,
            good=lambda value: value == 0 or value in replies,
            resolve=lambda: self._start_executed(begin, replies[0]),
            risky=True,
        )
        if got == 0:
            raise self._start_error(code)
        self._motion = motion
        return motion

    def _start_executed(self, begin: int, reply: int) -> int | None:
        """Return `reply` if a start, whose reply was lost, was executed; otherwise, return `None`.

        Before the start, the motor was stopped. The start was therefore executed if the motor moves or has
        moved.
        """
        try:
            if self.flags().busy or self._read_position() != begin:
                return reply
            # A reset during the motion also sets the position to 0.
            if not begin and self.was_reset():
                raise self._lost_reply("the controller was reset since")
            return None
        except NoAnswer as error:
            raise self._lost_reply(str(error)) from error

    def _at_rest(self, flags: Flags) -> None:
        if flags.busy:
            raise AxisBusy(0, f"{self._message_prefix}the motor is moving: wait for its end or stop it first")

    def _start_error(self, code: Code) -> CommandRefused:
        """Return the reason why the part rejected a start."""
        flags = self.flags()
        if flags.stops:
            return locked(flags.stops, self._message_prefix)
        if self.free:
            return MotorDisabled(0, f"{self._message_prefix}{MotorDisabled.text}")
        top, start, stop = self.max_speed, self.start_speed, self.stop_speed
        if code is Code.STEP and max(start, stop) > top:
            return SpeedRefused(
                0,
                f"{self._message_prefix}the maximum speed of {top} steps/s is below the start speed "
                f"({start}) or the "
                f"stop speed ({stop}): raise it, or lower those",
            )
        if code is Code.RUN and not top:
            return SpeedRefused(0, f"{self._message_prefix}the maximum speed is 0: set one")
        if flags.busy:
            return AxisBusy(
                0, f"{self._message_prefix}another program has started the motor: wait, or stop it"
            )
        return StartRefused(
            0, f"{self._message_prefix}the part rejected the start, but its cause is gone: try again"
        )

    def _stop(self, now: bool, wait: bool) -> MotionResult | None:
        motion = self._motion
        if motion is None or motion.over:
            motion = self._foreign_motion()
        motion.stop_ordered = True
        if now:
            self.execute(Code.ABORT, good=lambda value: value == 0)
        elif motion.requested is None:
            self._end_run()
        else:
            self._slow_move(motion)
        self._motion = motion
        return motion.wait() if wait else None

    def _foreign_motion(self) -> Motion:
        """Return a motion of another program. Raises NothingToStop if the motor is stopped."""
        if not self.flags().busy:
            raise NothingToStop(0, f"{self._message_prefix}nothing to stop: the motor is at standstill")
        running = self.modes().running
        return Motion(self, None if running else LONGEST, FORWARD, None)

    def _end_run(self) -> None:
        self.execute(Code.RUN, 0, good=lambda value: value == 0)

    def _slow_move(self, motion: Motion) -> None:
        """Decelerate a move to its stop speed, and let `Motion._update` abort it afterwards."""
        top, low = self.max_speed, self.stop_speed
        if top <= low:
            motion._abort_after(0, top)
            return
        self.max_speed = low
        motion._abort_after((top - low) / mean_acceleration(self.deceleration), top)


def _side(steps: int) -> int:
    return BACKWARD if steps < 0 else FORWARD


def _ext(number: int) -> int:
    number = whole(number, "EXT")
    if number not in (1, 2):
        raise OutOfRange(f"EXT{number}: there are EXT1 and EXT2")
    return number


# Homing of a PMC006B4, whose only switches are EXT1 and EXT2.

LONGEST_WAY_OFF = 200_000
SLOWEST, FASTEST = 65, 3000
HOMING_SETTINGS = ("stops", "direction", "start_speed", "stop_speed", "max_speed")


class Homing:
    """Homing run of a controller; see `pmc006.Pmc006.home`."""

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

    def run(self) -> MotionResult:
        """Find the edge of the switch and set the position to 0.

        If the switch is inactive, the motor approaches it. Then the motor leaves the switch, approaches it
        slowly, and leaves it again. Afterwards, speeds, direction and enabled stops are restored.
        """
        axis = self._axis
        before = {name: getattr(axis, name) for name in HOMING_SETTINGS}
        try:
            axis.clear_stops()
            axis.stops = 3  # the other switch stops the motor, too, because the direction may be wrong
            if axis.on_switch(self._switch):
                self._leave()
            else:
                self._approach(self._speed)
                self._leave()
            self._approach(self._slow)
            end = self._leave()
            axis.zero()
            return end.with_position(0)
        finally:
            if axis.motion is None or axis.motion.over:
                for name, value in before.items():
                    setattr(axis, name, value)

    def _set_constant_speed(self, speed: int) -> None:
        """Switch the ramps off, so that the motor always stops at the same distance from the switch edge."""
        self._axis.start_speed = self._axis.stop_speed = self._axis.max_speed = speed

    def _approach(self, speed: int) -> None:
        """Run until the switch stops the motor, and clear its flag."""
        axis = self._axis
        self._set_constant_speed(speed)
        end = axis.jog(self._direction).wait(progress=self._progress)
        stops = axis.flags().stops
        if self._switch not in stops:
            other = " and ".join(f"EXT{number}" for number in stops) or end.cause_text
            raise OriginNotFound(
                f"{axis._message_prefix}{other} ended the search for EXT{self._switch}: home in the other "
                "direction, or check the "
                "switch",
                end,
            )
        axis.clear_stops(stops)

    def _leave(self) -> MotionResult:
        """Move away from the switch in moves of equal length until it is released."""
        axis, gone = self._axis, 0
        self._set_constant_speed(self._slow)
        while True:
            end = axis.move(-self._direction * self._off, progress=self._progress)
            gone += self._off
            if not axis.on_switch(self._switch):
                return end
            if gone > LONGEST_WAY_OFF:
                raise OriginNotFound(
                    f"{axis._message_prefix}EXT{self._switch} is still active after a move of {gone} "
                    "steps away from it: check "
                    "the switch",
                    end,
                )
