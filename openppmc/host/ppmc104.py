"""Driver of a PPMC-104 behind a UART bridge."""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType

from ..model.codes104 import (
    ACC_DEC,
    CONSTANT,
    CONTINUOUS,
    ENDLESS,
    HIGH_SPEED,
    ORIGIN,
    SINGLE_STEP,
)
from . import units
from .ending import Cause, End
from .errors import (
    AlreadyDecelerating,
    Disconnected,
    NothingToStop,
    OutOfRange,
    PpmcError,
)
from .homing import Homing
from .link import DEFAULT_BAUD, Link
from .motion import READ_FINISH, Motion, Progress
from .part104 import Part104
from .script import Script
from .transport import Port

PART = 104
CW, CCW = 0, 1
STOP_NOW, STOP_SLOWLY = 0x40, 0x41
OPERATION, PULSE_ONLY, DIRECTION_BIT = 0x40, 0xC0, 3
OnProgress = Callable[[Progress], None]


class Ppmc104(Part104):
    """One axis. A context manager: leaving the block by an exception decelerates a motion that this object
    started; leaving it normally lets the motion go on. Both close the port.

    Directions: 0 or CW, 1 or CCW. Speeds in pulses per second, pulses signed, CW positive.
    Any method may raise LinkErrors; commands raise the part's CommandRefused errors.
    """

    def __init__(self, link: Link) -> None:
        super().__init__(link)
        self._motion: Motion | None = None

    @classmethod
    def open(cls, spec: str | Port, baud: int = DEFAULT_BAUD) -> Ppmc104:
        """Open a port (`/dev/ttyUSB0`, `COM3`, `sim:…`, `model:…`) and check what is there."""
        return cls(Link(spec, baud, PART))

    @property
    def motion(self) -> Motion | None:
        """The motion that was started last, None before the first."""
        return self._motion

    def close(self) -> None:
        """Close the port; a motion goes on."""
        self.link.close()

    def __enter__(self) -> Ppmc104:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        moving = self._motion is not None and self._motion.end is None
        if error is not None and moving and not isinstance(error, Disconnected):
            try:
                self._brake(STOP_SLOWLY)
            except PpmcError:
                pass  # the first error is the one to tell
        self.close()

    # ------------------------------------------------------------------ motions

    def start_move(self, pulses: int, pulse_only: bool = False) -> Motion:
        """Begin a move with ramps: 1 to 16 777 216 pulses either way. pulse_only: phases stand still."""
        data = _pulse_bytes(pulses)
        return self._start(ACC_DEC, _side(pulses), data, abs(pulses), pulse_only=pulse_only)

    def start_constant(self, pulses: int, pps: units.Number) -> Motion:
        """Begin a move at constant speed, without ramps."""
        clock, rate = self._rate(pps)
        return self._start(CONSTANT, _side(pulses), bytes([rate]) + _pulse_bytes(pulses), abs(pulses), clock)

    def move(self, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False) -> End:
        """Move with ramps and wait. Raises LimitReached, AlarmStop, StoppedEarly if it ends early."""
        if pulses == 0:
            return End(Cause.COMPLETE, 0, 0, self.counted(self._count()), 0)
        return self.start_move(pulses, pulse_only).wait(progress=progress).check(abs(pulses))

    def move_to(self, position: int, progress: OnProgress | None = None) -> End:
        """Move with ramps to a reading of the pulse counter, and wait."""
        return self.move(position - self.position, progress)

    def move_constant(self, pulses: int, pps: units.Number, progress: OnProgress | None = None) -> End:
        """Move at constant speed and wait; errors as `move`."""
        return self.start_constant(pulses, pps).wait(progress=progress).check(abs(pulses))

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
            return self._start(HIGH_SPEED, direction, pulse_only=pulse_only)
        clock, rate = self._rate(speed)
        return self._start(CONTINUOUS, direction, bytes([rate]), clock=clock)

    def search(self, direction: int, pps: units.Number | None = None) -> Motion:
        """Run at constant speed until the origin switch (or a stop, a limit, the alarm)."""
        clock, rate = self._rate(pps)
        return self._start(ORIGIN, direction, bytes([rate]), clock=clock)

    def step(self, direction: int) -> End:
        """One pulse."""
        return self._start(SINGLE_STEP, direction, asked=1).wait().check(1)

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
        return self._stop(STOP_SLOWLY, wait)

    def halt(self, wait: bool = True) -> End | None:
        """Stop at once; steps may be lost at high speed. As `stop` otherwise."""
        return self._stop(STOP_NOW, wait)

    def _stop(self, command: int, wait: bool) -> End | None:
        motion = self._motion
        if motion is None or motion.end is not None:
            # Perhaps one that another program started.
            motion = Motion(self, None, CW, 0, ours=False)
            self.link.execute(Script().call(command))
        else:
            self._brake(command)
        self._motion = motion
        return motion.wait() if wait else None

    def _brake(self, command: int) -> None:
        try:
            self.link.execute(Script().call(command))
        except (AlreadyDecelerating, NothingToStop):
            pass  # its end is near, or just gone by

    def _start(
        self,
        operation: int,
        direction: int,
        data: bytes = b"",
        asked: int | None = None,
        clock: units.BaseClock | None = None,
        pulse_only: bool = False,
    ) -> Motion:
        """One frame: straps, a pending interrupt away, counter, the command."""
        if direction not in (CW, CCW):
            raise OutOfRange(f"direction {direction!r} is neither 0 (CW) nor 1 (CCW)")
        if clock is None and self.setup is not None:
            clock = self.setup.clock
        code = (PULSE_ONLY if pulse_only else OPERATION) | direction << DIRECTION_BIT | operation
        self.link.forget_events()
        script = self._straps(clock) if clock else Script()
        script.call(READ_FINISH).get(1).count().call(code, *data)
        answer = self.link.execute(script)
        self._motion = Motion(self, asked, direction, answer.number(2, signed=True))
        return self._motion

    def reset(self) -> None:
        """Reset of the part, in any state: pulses end at once, coils off, nothing initialised."""
        super().reset()
        self._motion = None


def _side(pulses: int) -> int:
    return CCW if pulses < 0 else CW


def _pulse_bytes(pulses: int) -> bytes:
    if not 1 <= abs(pulses) <= ENDLESS:
        raise OutOfRange(f"{pulses} pulses: a move has 1 to {ENDLESS} pulses either way")
    return (abs(pulses) - 1).to_bytes(3, "little")
