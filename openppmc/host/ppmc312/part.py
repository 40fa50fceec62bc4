"""Driver of a PPMC-312 behind a UART bridge."""

from __future__ import annotations

from ...model.ppmc312.codes import Answer
from .. import speeds
from ..axis import CCW, CW, Moves, OnProgress
from ..ending import Cause, End
from ..errors import NothingToStop, OutOfRange, ProtocolError
from ..kind import PULSE_ONLY
from ..link import Link
from ..part import Part
from ..script import Script
from . import blocks
from .answers import EventBuffer
from .blocks import Trigger
from .core import MotionT, Settings
from .errors import RegistrationRefused
from .motion import Homing, Motion
from .profile import KIND
from .window import Window

# Registered instructions of a PPMC-312: overrides that wait for a position or an event, event buffers.

_EVENTS = {1: Trigger.EVENT1, 2: Trigger.EVENT2}
REGISTERED, IN_USE, FULL, DELETED, EMPTY_NOW, NOTHING = range(6)


class Overrides(Settings[MotionT]):
    """See `ppmc312.Ppmc312`.

    Overrides happen in the order of their registration, up to eight of them; each waits for a position (at)
    or for event input 1 or 2 (event). They stay through the end of a motion and go with the next table.
    Raises RegistrationRefused. What they did comes as a report (`Executed`, `Failed`): read it before the
    next one is due, or the part goes into alarm.
    """

    # ------------------------------------------------------------------ overrides

    def override_stop(self, at: int | None = None, event: int | None = None, slow: bool = True) -> None:
        """A stop, with a ramp or at once (then pulse `at` is the last one)."""
        make = blocks.slow_stop if slow else blocks.immediate_stop
        self._register(make(_trigger(at, event), at))

    def override_speed(
        self, pps: speeds.Number, at: int | None = None, event: int | None = None, ramped: bool = True
    ) -> None:
        """Another speed of the table, with a ramp (which needs a constant speed before) or at once."""
        self._register(blocks.change(self.rate_of(pps), ramped, _trigger(at, event), at))

    def override_move(self, pulses: int, event: int, pps: speeds.Number | None = None) -> None:
        """A move on an event; pps: constant speed, None for one with ramps."""
        self._register(self.move_block(pulses, pps, _trigger(None, event)))

    def override_run(self, direction: int, event: int, pps: speeds.Number | None = None) -> None:
        """An endless motion on an event; pps: constant speed, None: with a ramp to the high speed."""
        rate = 0 if pps is None else self.rate_of(pps)
        self._register(blocks.run(direction, rate, pps is None, _trigger(None, event)))

    def _register(self, block: bytes) -> None:
        response = self.window.ask(block)
        if response.code != Answer.REGISTERED:
            raise ProtocolError(f"{self.link.name}: nothing was registered: {response.raw.hex(' ')}")

    def move_block(
        self, pulses: int, pps: speeds.Number | None = None, trigger: Trigger = Trigger.NOW
    ) -> bytes:
        """Instruction of a move, signed pulses; pps: constant speed. OutOfRange."""
        side, count = (CCW, -pulses) if pulses < 0 else (CW, pulses)
        if not 1 <= count < blocks.POSITIONS:
            raise OutOfRange(f"{pulses} pulses: a move has 1 to {blocks.POSITIONS - 1} pulses either way")
        if pps is None:
            return blocks.acceleration(side, count, 0, trigger)
        return blocks.constant(side, count, self.rate_of(pps), trigger)

    # ------------------------------------------------------------------ event buffers

    def event_add(self, event: int, block: bytes) -> None:
        """Put an instruction (`move_block`, `blocks`) into event buffer 1 or 2, which hold four each. A
        falling edge of the event input carries the next one out, round and round. Only at rest."""
        status = self.instruct(blocks.event_register(event, block), 4)[0]
        if status == IN_USE:
            raise RegistrationRefused(status, f"event {event} is in use by an override")
        if status == FULL:
            raise RegistrationRefused(status, f"event buffer {event} is full: it holds four instructions")

    def event_delete(self, event: int) -> bool:
        """Take the last instruction of an event buffer out; False if there was none."""
        return self.instruct(blocks.event_delete(event), 4)[0] != NOTHING

    def event_buffer(self, event: int) -> EventBuffer:
        """What event buffer 1 or 2 holds; at rest."""
        return EventBuffer.parse(self.instruct(blocks.event_read(event), 9))


def _trigger(at: int | None, event: int | None) -> Trigger:
    """What an override waits for. OutOfRange if it is not exactly one thing."""
    if (at is None) == (event is None):
        raise OutOfRange("an override waits either for a position (at) or for an event")
    if event is None:
        return Trigger.POSITION
    if event not in _EVENTS:
        raise OutOfRange(f"event {event!r}: there are events 1 and 2")
    return _EVENTS[event]


# The motions of a PPMC-312, whatever carries its instructions.


class Axis(Moves, Overrides[MotionT]):
    """See `ppmc312.Ppmc312`."""

    # ------------------------------------------------------------------ motions

    def start_move(self, pulses: int, pulse_only: bool = False) -> MotionT:
        """Begin a move with ramps: 1 to 2^32 - 1 pulses either way."""
        if pulse_only:
            self.kind.need(PULSE_ONLY)
        return self._start(self.move_block(pulses), _side(pulses), abs(pulses))

    def start_constant(self, pulses: int, pps: speeds.Number) -> MotionT:
        """Begin a move at constant speed, without ramps."""
        return self._start(self.move_block(pulses, pps), _side(pulses), abs(pulses))

    def nothing_to_move(self) -> End:
        """The End of a move of 0 pulses."""
        return self.told(End(Cause.COMPLETE, 0, 0, self.position, 0))

    def jog(
        self,
        direction: int,
        speed: speeds.Number | None = None,
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

    def search(self, direction: int, pps: speeds.Number | None = None, index: bool = False) -> MotionT:
        """Run at constant speed (default: start speed) until the origin, or until the index on it."""
        return self._start(blocks.origin_search(direction, self._search_rate(pps), index), direction)

    def zero_return(self, direction: int, pps: speeds.Number | None = None, index: bool = False) -> MotionT:
        """Run at high speed (or pps) to the origin, slow down past it and come back to it at the start speed.
        Wants an origin switch that is active over a short way only."""
        rate = 0 if pps is None else self.rate_of(pps)
        return self._start(blocks.zero_return(direction, rate, index), direction)

    def home(
        self,
        direction: int = CCW,
        search_pps: speeds.Number | None = None,
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

    def change_speed(self, pps: speeds.Number, ramped: bool = True) -> None:
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

    def _search_rate(self, pps: speeds.Number | None) -> int:
        """Rate of a constant speed, by default the start speed that is really reached."""
        if pps is not None:
            return self.rate_of(pps)
        setup = self.known_setup()
        return setup.table.rates[setup.table.sa]

    @property
    def search_speed(self) -> speeds.Number:
        """Speed of searches and jogs that name none, in pps. OutOfRange without a setup."""
        setup = self.known_setup()
        return setup.clock.speed(setup.table.rates[setup.table.sa])


def _side(pulses: int) -> int:
    return CCW if pulses < 0 else CW


RUN, EVENT_1, EVENT_2 = 0x01, 0x02, 0x04
"""Strap bits of the board: RUN, and the event inputs (0 = active)."""


class Ppmc312(Axis[Motion], Part):
    """One PPMC-312: part and axis in one object; see `part.Part`.

    Directions: 0 or CW, 1 or CCW. Speeds in pulses per second, those of motions within the table; pulses and
    positions signed, CW positive. Any method may raise LinkErrors; instructions raise what the part refuses
    (CommandRefused, `errors`). Motions: `axis`, settings and tables: `settings`, overrides and events:
    `overrides`, registers and outputs: `core`.
    """

    kind = KIND
    link: Link

    def __init__(self, link: Link) -> None:
        self._straps = 0xFF
        super().__init__(link)

    def _make_motion(self, asked: int | None, direction: int, begin: int | None) -> Motion:
        return Motion(self, asked, direction, begin)

    def _make_window(self) -> Window:
        return Window(self.link, self._arrived)

    @property
    def axes(self) -> tuple[Ppmc312, ...]:
        return (self,)

    def reset(self) -> None:
        """Reset of the part by its pin, in any state: pulses end at once, no table, position 0."""
        self.link.execute(Script().reset())
        self.forget()

    def allow_run(self, on: bool) -> None:
        """Level of the part's RUN input by the board's strap; a switch at the pin can still forbid."""
        self._strap(RUN, on)

    def pulse_event(self, event: int) -> None:
        """A pulse at event input 1 or 2 by the board's strap: 30 ms long, so DATASHEET timing sees it too."""
        bit = {1: EVENT_1, 2: EVENT_2}[blocks.buffer_number(event) + 1]
        self._strap(bit, False)
        self.link.pause(0.03)
        self._strap(bit, True)

    def _strap(self, bit: int, high: bool) -> None:
        self._straps = self._straps & ~bit | (bit if high else 0)
        self.link.execute(Script().straps(self._straps))
