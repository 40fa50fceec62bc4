"""One axis of a part: set-up, speeds, motions and registers that are the same on all parts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Protocol

from ..model.motion.codes import ACC_DEC, CONSTANT, CONTINUOUS, ENDLESS, HIGH_SPEED, ORIGIN, SINGLE_STEP
from . import speeds
from .check import Checked
from .ending import Cause, End
from .errors import AlreadyDecelerating, NothingToStop, NotWhileBusy, OutOfRange, ProtocolError
from .kind import COILS_OFF, PULSE_ONLY, RateKind, Wanted
from .link import Talk
from .motion import READ_FINISH, AnyMotion, Homing, Motion, Order, Progress
from .registers import FAMILY, Outputs, ReadCodes, Switches
from .script import Script
from .speeds import Number, Setup, exact, nearby

# Moves that are waited for, the same with every part.

OnProgress = Callable[[Progress], None]


class Startable(Protocol):
    """What `Moves` needs of its axis; `nothing_to_move` gives the End of a move of 0 pulses."""

    @property
    def position(self) -> int: ...
    def start_move(self, pulses: int, pulse_only: bool = False) -> AnyMotion: ...
    def start_constant(self, pulses: int, pps: speeds.Number) -> AnyMotion: ...
    def nothing_to_move(self) -> End: ...
    def move(self, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False) -> End: ...


class Moves(Checked):
    """For an axis that is `Startable`."""

    def move(
        self: Startable, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False
    ) -> End:
        """Move with ramps and wait. Raises LimitReached, AlarmStop, StoppedEarly if it ends early."""
        if pulses == 0:
            return self.nothing_to_move()
        return self.start_move(pulses, pulse_only).wait(progress=progress).check(abs(pulses))

    def move_to(self: Startable, position: int, progress: OnProgress | None = None) -> End:
        """Move with ramps to a reading of the pulse counter, and wait."""
        return self.move(position - self.position, progress)

    def move_constant(
        self: Startable, pulses: int, pps: speeds.Number, progress: OnProgress | None = None
    ) -> End:
        """Move at constant speed and wait; errors as `move`."""
        return self.start_constant(pulses, pps).wait(progress=progress).check(abs(pulses))


# What an axis is without its motions: set-up, speeds, registers.

EXCITATION_OFF = 0xC0


class AxisCore(Checked):
    """See `axis.Axis`. `setup`: the initialisation this object made, if any. number: of the axis; bit: what
    its command codes have set; busy: its bit in the status register; unused: bits of that which read as 0.
    """

    kind: RateKind
    number = 1
    bit = 0
    busy = 0x04
    unused = 0x08
    link: Talk
    setup: speeds.Setup | None

    def __init__(self, link: Talk) -> None:
        self.link = link
        self.setup = None
        self._motion: Motion | None = None

    @property
    def motion(self) -> Motion | None:
        """The motion that was started last, None before the first."""
        return self._motion

    @property
    def codes(self) -> ReadCodes:
        """Of the read commands that differ from part to part."""
        return FAMILY

    @property
    def who(self) -> str:
        """Begins a message about this axis, if the part has several."""
        return f"axis {self.number}: " if self.kind.axes > 1 else ""

    def told(self, end: End) -> End:
        """The end with the words of this axis and its part."""
        return replace(end, who=self.who, alarm=self.kind.alarm)

    # ------------------------------------------------------------------ initialisation

    def initialise(
        self,
        start_pps: speeds.Number = 1000,
        high_pps: speeds.Number = 5000,
        ramp_pulses: int = 200,
        phases: int = 4,
        half_step: bool = False,
        positive_logic: bool | None = None,
        chop: bool = False,
        base_clock: speeds.Number | None = None,
        external_clock: speeds.Number | None = None,
        long_intervals: bool = False,
    ) -> speeds.Setup:
        """Speeds, ramp and motor of this axis; returns what is really reached.

        start_pps, high_pps: what the part can do, high_pps not below start_pps. ramp_pulses: from start to
        high speed. phases: 3, 4, 5. positive_logic: a high level switches a coil on (the default, where the
        part has both). chop: the coils are switched at rest. base_clock: one of those that the part has, in
        Hz, None to choose by start_pps. external_clock: frequency at the part's clock pin in Hz.
        long_intervals: vsel low, 7.5 us more an interval. The driver of each part has its figures, and says
        what stays as it is until `reset`. Raises OutOfRange, also for what the part does not have, and
        NotWhileBusy.
        """
        wanted = Wanted(
            start_pps,
            high_pps,
            ramp_pulses,
            phases,
            half_step,
            positive_logic,
            chop,
            base_clock,
            external_clock,
            long_intervals,
            self.number,
        )
        return self.apply(self.kind.plan(self.link.identity.xtal_hz, wanted))

    # ------------------------------------------------------------------ for the parts

    def straps(self, clock: speeds.BaseClock | None) -> Script:
        """Levels of the strap pins for a motion with this base clock; None: it does not matter."""
        raise NotImplementedError

    def inputs(self) -> Switches:
        """Switches; allowed at any time."""
        raise NotImplementedError

    def apply(self, setup: speeds.Setup) -> speeds.Setup:
        """Initialise with a setup that was planned before for this axis."""
        raise NotImplementedError

    @property
    def search_speed(self) -> speeds.Number:
        """Speed of searches and jogs that name none: the start speed, in pps. OutOfRange without a setup."""
        if self.setup is None:
            raise OutOfRange("no speed given, and no initialisation to take it from: name a speed in pps")
        return self.setup.start.reached

    def _rate(self, pps: speeds.Number | None) -> tuple[speeds.BaseClock, int]:
        """Base clock and rate byte of a constant speed; the other internal base clock if it must be."""
        if pps is None:
            pps = self.search_speed
        ramp = self.setup.clock if self.setup else None
        clock = self.kind.constant_clock(self.link.identity.xtal_hz, ramp, pps)
        return clock, clock.choose(pps).rate

    # ------------------------------------------------------------------ registers

    def outputs(self) -> Outputs:
        """Motor outputs; only at rest (NotWhileBusy)."""
        return Outputs.parse(self.link.execute(Script().call(self.codes.outputs | self.bit).get(1)).byte(1))

    def remaining(self) -> int:
        """Remaining-pulse register of the last motion (pulses left - 1, at least 0); only at rest."""
        return self.link.execute(Script().call(self.codes.remaining | self.bit).get(3)).number(1)

    @property
    def position(self) -> int:
        """Pulse counter of the bridge, CW positive; allowed at any time."""
        position = self.counted(self._count())
        if position is None:
            raise ProtocolError(f"{self.link.name}: this board has no pulse counter, so no position")
        return position

    def where(self, script: Script) -> Script:
        """Adds what reads the counter of this axis; gives one value of 4 bytes."""
        return script.count(self.number)

    def counted(self, count: int) -> int | None:
        """The position that a reading of the counter means, None if there is no counter."""
        return count if self.link.identity.counter else None

    def _count(self) -> int:
        return self.link.execute(self.where(Script())).number(0, signed=True)

    def zero(self) -> None:
        """Make the present position 0. Raises NotWhileBusy while a motion of this object is running: its end
        is compared with the pulse counter."""
        motion = self._motion
        if motion is not None and not motion.over and motion.poll() is not None:
            raise NotWhileBusy(self.busy)
        self.link.execute(Script().zero(self.number))

    def excitation_off(self) -> None:
        """All coils off; the axis must be initialised anew. During a motion nothing is sent: on a PPMC-104
        the code would mean something else then (P104-AUX-05): NotWhileBusy. OutOfRange on an STMC."""
        self.kind.need(COILS_OFF)
        self._at_rest(Script().call(EXCITATION_OFF | self.bit))

    def forget(self) -> None:
        """The part was reset."""
        self.setup = self._motion = None

    def _at_rest(self, script: Script) -> None:
        """Run a script only if BUSY is 0, decided by the bridge itself."""
        answer = self.link.attempt(Script().timeout(0).wait(1, self.busy, 0).timeout(250).extend(script))
        if answer.failed is not None and answer.failed.name == "WAIT":
            raise NotWhileBusy(answer.last)
        self.link.judge(answer)


# The chopper at rest of the parts that have that of the PPMC-104 (P104-SW-04).

SWITCHING = 0x84


def chop_byte(xtal_hz: int, microseconds: Number, phase: str, vsel: int) -> tuple[int, Fraction]:
    """Parameter byte of the chopper nearest to a time, and the time it makes in us (P104-SW-04).

    phase: "on" or "off". Raises OutOfRange with the possible range.
    """
    quantum = Fraction(4_000_000, xtal_hz)
    offset = {("on", 1): 108, ("on", 0): 100, ("off", 1): 132, ("off", 0): 115}[phase, vsel] * quantum
    unit = 12 * quantum
    low, high = offset, offset + 255 * unit
    asked = exact(microseconds, f"{phase} time")
    if not low <= asked <= high:
        raise OutOfRange(
            f"{phase} time {nearby(microseconds)} us is outside {nearby(low)} to {nearby(high)} us"
        )
    byte = min(255, int((asked - offset) / unit + Fraction(1, 2)))
    return byte, offset + byte * unit


class Chopped(Protocol):
    """What `Chopping` needs of its axis. setup: its initialisation, if known."""

    setup: Setup | None

    @property
    def link(self) -> Talk: ...


class Chopping(Checked):
    """For an axis that is `Chopped`."""

    def switching(self: Chopped, on_us: Number, off_us: Number) -> tuple[Fraction, Fraction]:
        """Times of the chopper at rest in us (16 MHz: on 27 to 792, off 33 to 798); returns those reached."""
        vsel = self.setup.clock.vsel if self.setup else 1
        on = chop_byte(self.link.identity.xtal_hz, on_us, "on", vsel)
        off = chop_byte(self.link.identity.xtal_hz, off_us, "off", vsel)
        self.link.execute(Script().call(SWITCHING, on[0], off[0]))
        return on[1], off[1]


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

    def start_constant(self, pulses: int, pps: speeds.Number) -> Motion:
        """Begin a move at constant speed, without ramps."""
        return self.start(self.move_order(pulses, pps))

    def jog(
        self,
        direction: int,
        speed: speeds.Number | None = None,
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

    def search(self, direction: int, pps: speeds.Number | None = None) -> Motion:
        """Run at constant speed until the origin switch (or a stop, a limit, the alarm)."""
        clock, rate = self._rate(pps)
        return self.start(Order(ORIGIN, direction, bytes([rate]), clock=clock))

    def step(self, direction: int) -> End:
        """One pulse."""
        return self.start(Order(SINGLE_STEP, direction, asked=1)).wait().check(1)

    def home(
        self,
        direction: int = CCW,
        search_pps: speeds.Number | None = None,
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

    def move_order(self, pulses: int, pps: speeds.Number | None = None, pulse_only: bool = False) -> Order:
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

    def clock_of(self, order: Order) -> speeds.BaseClock | None:
        """Its base clock; None if nobody knows."""
        if order.clock is not None:
            return order.clock
        return None if self.setup is None else self.setup.clock

    def nothing_to_move(self) -> End:
        """The End of a move of 0 pulses."""
        return self.told(End(Cause.COMPLETE, 0, 0, self.counted(self._count()), 0))
