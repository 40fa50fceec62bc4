"""Driver of a PPMC-312 on a UART bridge."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...model.ppmc312.codes import Answer
from .. import speeds
from ..axis import CCW, CW, OnProgress
from ..capabilities import PULSE_ONLY
from ..check import wholes
from ..errors import CommandRefused, NothingToStop, OutOfRange, PpmcError, ProtocolError, Timeout
from ..link import Link
from ..motion_result import Cause, MotionResult
from ..moves import LONGEST_WAIT_MS, run_moves
from ..part import Part
from ..script import Script
from . import blocks
from .answers import EventBuffer, Response, signed
from .blocks import Trigger
from .core import MotionT, Settings
from .errors import RegistrationRefused
from .motion import Homing, Motion
from .profile import CAPABILITIES
from .window import Window

# Registered instructions of a PPMC-312: overrides that wait for a position or an event, and event buffers.

_EVENTS = {1: Trigger.EVENT1, 2: Trigger.EVENT2}
REGISTERED, IN_USE, FULL, DELETED, EMPTY_NOW, NOTHING = range(6)


class Overrides(Settings[MotionT]):
    """Overrides and event buffers; see `ppmc312.Ppmc312`.

    An override waits for a position (`at`) or for event input 1 or 2 (`event`). Up to eight overrides can be
    registered; they are executed in the order of their registration. Overrides remain registered after the
    end of a motion, until the next table is loaded. A report contains the result of an override (`Executed`,
    `Failed`). On a bus, read this report before the next override is executed; otherwise the part enters the
    alarm state. It also enters the alarm state if an override or event is triggered between an instruction of
    the host and the read of its answer. Therefore, `Motion.wait` only reads reports while one waits.
    All methods may raise RegistrationRefused.
    """

    # ------------------------------------------------------------------ overrides

    def override_stop(self, at: int | None = None, event: int | None = None, slow: bool = True) -> None:
        """Register a stop with a ramp, or an immediate stop.

        After an immediate stop, pulse `at` is the last one.
        """
        make = blocks.slow_stop if slow else blocks.immediate_stop
        self._register(make(_trigger(at, event), at))

    def override_speed(
        self, pps: speeds.Number, at: int | None = None, event: int | None = None, ramped: bool = True
    ) -> None:
        """Register a change to another speed of the table.

        Args:
            ramped: True: change with a ramp, which is possible only at constant speed; False: change
                immediately.
        """
        self._register(blocks.change(self.rate_of(pps), ramped, _trigger(at, event), at))

    def override_move(self, pulses: int, event: int, pps: speeds.Number | None = None) -> None:
        """Register a move that an event starts.

        Args:
            pps: constant speed, `None` for a move with ramps.
        """
        self._register(self.move_block(pulses, pps, _trigger(None, event)))

    def override_run(self, direction: int, event: int, pps: speeds.Number | None = None) -> None:
        """Register an endless motion that an event starts.

        Args:
            pps: constant speed, `None` for an acceleration to the high speed.
        """
        rate = 0 if pps is None else self.rate_of(pps)
        self._register(blocks.run(direction, rate, pps is None, _trigger(None, event)))

    def _register(self, block: bytes) -> None:
        response = self.window.execute(block)
        if response.code != Answer.REGISTERED:
            raise ProtocolError(f"{self.link.name}: nothing was registered: {response.raw.hex(' ')}")
        if self._waiting is not None:
            self._waiting += 1

    def move_block(
        self, pulses: int, pps: speeds.Number | None = None, trigger: Trigger = Trigger.NOW
    ) -> bytes:
        """Return the instruction of a move.

        Args:
            pulses: signed number of pulses.
            pps: constant speed, `None` for a move with ramps.

        Raises:
            OutOfRange: the number of pulses is out of range.
        """
        side, count = (CCW, -pulses) if pulses < 0 else (CW, pulses)
        if not 1 <= count < blocks.POSITIONS:
            raise OutOfRange(f"{pulses} pulses: a move has 1 to {blocks.POSITIONS - 1} pulses either way")
        if pps is None:
            return blocks.acceleration(side, count, 0, trigger)
        return blocks.constant(side, count, self.rate_of(pps), trigger)

    # ------------------------------------------------------------------ event buffers

    def event_add(self, event: int, block: bytes) -> None:
        """Append an instruction, for example the result of `move_block`, to event buffer 1 or 2.

        A buffer holds four instructions. Each falling edge of the event input executes the next instruction;
        after the last one, the first one follows.

        During this call, the motor must be stopped.
        """
        self._waiting = None
        status = self.instruct(blocks.event_register(event, block), 4)[0]
        if status == IN_USE:
            raise RegistrationRefused(status, f"event {event} is in use by an override")
        if status == FULL:
            raise RegistrationRefused(status, f"event buffer {event} is full: it holds four instructions")

    def event_delete(self, event: int) -> bool:
        """Remove the last instruction of an event buffer; return False if the buffer was empty."""
        return self.instruct(blocks.event_delete(event), 4)[0] != NOTHING

    def event_buffer(self, event: int) -> EventBuffer:
        """Return the content of event buffer 1 or 2. The motor must be stopped."""
        return EventBuffer.parse(self.instruct(blocks.event_read(event), 9))


def _trigger(at: int | None, event: int | None) -> Trigger:
    """Return the trigger of an override.

    Raises OutOfRange unless exactly one of the arguments is given.
    """
    if (at is None) == (event is None):
        raise OutOfRange("an override waits either for a position (at) or for an event")
    if event is None:
        return Trigger.POSITION
    if event not in _EVENTS:
        raise OutOfRange(f"event {event!r}: there are events 1 and 2")
    return _EVENTS[event]


# Motions of a PPMC-312 on a bridge or on a line.


class Axis(Overrides[MotionT]):
    """Motions; see `ppmc312.Ppmc312`."""

    # ------------------------------------------------------------------ moves that wait for their end

    def move(self, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False) -> MotionResult:
        """Move with ramps and wait for the end.

        Raises:
            LimitReached, AlarmStop, StoppedByCommand: the move ended before all pulses were output.
        """
        if pulses == 0:
            return self._empty_move_result()
        return self.start_move(pulses, pulse_only).wait(progress=progress).check(abs(pulses))

    def move_to(self, position: int, progress: OnProgress | None = None) -> MotionResult:
        """Move with ramps to a position of the pulse counter and wait for the end."""
        return self.move(position - self.position, progress)

    def move_constant(
        self, pulses: int, pps: speeds.Number, progress: OnProgress | None = None
    ) -> MotionResult:
        """Move at constant speed and wait for the end; raises the same errors as `move`."""
        return self.start_constant(pulses, pps).wait(progress=progress).check(abs(pulses))

    def moves(self, pulses: Iterable[int], pps: speeds.Number | None = None) -> Iterator[MotionResult]:
        """Move by each number of pulses in order, and yield the result of each move.

        The iteration starts the moves. A move that does not end as requested is the last one.

        Args:
            pps: constant speed, `None` for moves with ramps.

        Raises:
            LimitReached, AlarmStop, StoppedByCommand: a move ended before all pulses were output.
        """
        numbers = wholes(pulses, "pulses")
        return (self.move_constant(one, pps) if pps and one else self.move(one) for one in numbers)

    # ------------------------------------------------------------------ motions

    def start_move(self, pulses: int, pulse_only: bool = False) -> MotionT:
        """Start a move with ramps of 1 to 2^32 - 1 pulses in either direction."""
        if pulse_only:
            self.kind.need(PULSE_ONLY)
        return self._start(self.move_block(pulses), _side(pulses), abs(pulses))

    def start_constant(self, pulses: int, pps: speeds.Number) -> MotionT:
        """Start a move at constant speed, without ramps."""
        return self._start(self.move_block(pulses, pps), _side(pulses), abs(pulses))

    def _empty_move_result(self) -> MotionResult:
        """Return the result of a move of 0 pulses."""
        return self._annotate(MotionResult(Cause.COMPLETE, 0, 0, self.position, 0))

    def jog(
        self,
        direction: int,
        speed: speeds.Number | None = None,
        high: bool = False,
        pulse_only: bool = False,
    ) -> MotionT:
        """Run until a stop command, a limit or the alarm.

        Args:
            speed: constant speed in pps, default: the start speed.
            high: True to accelerate with a ramp to `speed`. The default of `speed` is then the high speed.
        """
        if pulse_only:
            self.kind.need(PULSE_ONLY)
        if high:
            rate = 0 if speed is None else self.rate_of(speed)
        else:
            rate = self._search_rate(speed)
        return self._start(blocks.run(direction, rate, high), direction)

    def step(self, direction: int) -> MotionResult:
        """Output one pulse in this direction."""
        return self._start(blocks.single_step(direction), direction, 1).wait().check(1)

    def search(self, direction: int, pps: speeds.Number | None = None, index: bool = False) -> MotionT:
        """Run at constant speed to the origin switch or, with `index`, to the first index pulse on it.

        The default speed is the start speed.
        """
        return self._start(blocks.origin_search(direction, self._search_rate(pps), index), direction)

    def zero_return(self, direction: int, pps: speeds.Number | None = None, index: bool = False) -> MotionT:
        """Run to the origin switch at high speed (or `pps`), and return to it at the start speed.

        The motor decelerates after it has reached the switch, so it runs past the switch before it returns.

        The switch must be active only over a short distance.
        """
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
    ) -> MotionResult:
        """Find the origin switch, always from the same side, and set its edge to position 0.

        Args:
            direction: direction towards the switch.
            search_pps: speed of the search in pps, default: the start speed.
            fast: True to make a zero return at high speed first.
            to_limit: True to run at high speed to the slow-down limit first, and then continue to the hard
                limit.
            back_off: pulses of each move away from the switch if it is active at the start of the search.
            index: True if the origin is the first index of the encoder on the switch.

        Raises:
            OriginNotFound, LimitReached, AlarmStop, StoppedByCommand: homing did not succeed.
        """
        return Homing(self, direction, search_pps, back_off, progress, index).run(fast, to_limit)

    # ------------------------------------------------------------------ during a motion

    def change_speed(self, pps: speeds.Number, ramped: bool = True) -> None:
        """Change the running motion to another speed of the table.

        Args:
            ramped: True: change with a ramp, which is possible only at constant speed; False: change
                immediately.

        Raises:
            NothingToStop: the motor is stopped.
            AxisBusy: the motor is on a ramp.
        """
        self.instruct(blocks.change(self.rate_of(pps), ramped))

    def stop(self, wait: bool = True) -> MotionResult | None:
        """Stop with a ramp; return the result, or `None` if wait is False.

        If the motor has just stopped without the call, the call is not an error.

        Raises:
            NothingToStop: the motor was stopped.
            HeldByRun: the start still waits for RUN.
        """
        return self._stop(False, wait)

    def halt(self, wait: bool = True) -> MotionResult | None:
        """Stop immediately; steps may be lost at high speed.

        In all other respects, the method works like `stop`.
        """
        return self._stop(True, wait)

    def _request_stop(self, now: bool = False) -> None:
        """Request a stop of the motion that this object started, without waiting.

        If the motion has already ended, the call is not an error.
        """
        try:
            self.instruct(blocks.immediate_stop() if now else blocks.slow_stop())
        except NothingToStop:
            self.window.collect()
            if self._motion is None or not self._motion.over:
                raise
        else:
            if self._motion is not None:
                self._motion.stop_ordered = True

    # ------------------------------------------------------------------ internal

    def _stop(self, now: bool, wait: bool) -> MotionResult | None:
        motion = self._motion
        if motion is None or motion.over:
            # Another program, an override or an event may have started a motion.
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
            self._request_stop(now)
        return motion.wait() if wait else None

    def _start(self, block: bytes, direction: int, requested: int | None = None) -> MotionT:
        """Start a motion. One message may contain both the response and the report of the end."""
        before, begin = self._motion, self.position
        self._mark = self.window.answers
        self._motion = motion = self._make_motion(requested, direction, begin)
        self.link.forget_events()
        try:
            data = self.instruct(block, 4)
        except BaseException:
            self._motion = before
            raise
        motion._on_start_response(data[0] if data else None)
        return motion

    def _search_rate(self, pps: speeds.Number | None) -> int:
        """Return the rate of a constant speed; without a speed, the rate of the start speed as reached."""
        if pps is not None:
            return self.rate_of(pps)
        setup = self.known_setup()
        return setup.table.rates[setup.table.sa]

    @property
    def _default_speed(self) -> speeds.Number:
        """Default speed of searches and jogs in pps.

        Raises:
            OutOfRange: this object has loaded no table.
        """
        setup = self.known_setup()
        return setup.clock.speed(setup.table.rates[setup.table.sa])


def _side(pulses: int) -> int:
    return CCW if pulses < 0 else CW


MOVES_PER_FRAME = 5
RUN, EVENT_1, EVENT_2 = 0x01, 0x02, 0x04
"""Strap bits of the board: RUN, and the event inputs, which are active at 0."""


class Ppmc312(Axis[Motion], Part):
    """One PPMC-312: part and axis in one object; see `part.Part`.

    Directions are 0 or CW, 1 or CCW. Speeds are in pulses per second; the speeds of motions must be within
    the table. Pulses and positions are signed, CW positive. Any method may raise LinkErrors; instructions
    raise the errors of the part (CommandRefused, `errors`). `Axis` defines the motions, `core.Settings` the
    settings and tables, `Overrides` the overrides and events, and `core.Core` the registers and outputs.
    """

    kind = CAPABILITIES
    link: Link
    window: Window

    def __init__(self, link: Link) -> None:
        self._straps = 0xFF
        super().__init__(link)

    def _make_motion(self, requested: int | None, direction: int, begin: int | None) -> Motion:
        return Motion(self, requested, direction, begin)

    def _make_window(self) -> Window:
        return Window(self.link, self._on_response)

    def _start(self, block: bytes, direction: int, requested: int | None = None) -> Motion:
        if self._waiting != 0:
            self._waiting = self.status().waiting
        return super()._start(block, direction, requested)

    def _may_poll(self) -> bool:
        return self._waiting == 0 or self.window.was_reset()

    @property
    def axes(self) -> tuple[Ppmc312, ...]:
        return (self,)

    def moves(self, pulses: Iterable[int], pps: speeds.Number | None = None) -> Iterator[MotionResult]:
        """Move by each number of pulses in order, and yield the result of each move.

        One frame contains up to five moves; see `axis.Axis.moves`.
        """
        numbers = wholes(pulses, "pulses")
        return run_moves(
            numbers, MOVES_PER_FRAME, lambda moves: self._execute_moves(moves, pps), self._empty_move_result
        )

    def _execute_moves(
        self, moves: Sequence[int], pps: speeds.Number | None
    ) -> tuple[list[Motion], PpmcError | None]:
        """Execute moves with one frame.

        Returns the motions that were started, and the error that ended the script, if any.
        """
        motions: list[Motion] = []
        begin: int | None = None
        error: PpmcError | None = None

        def on_answer(response: Response) -> None:
            nonlocal begin, error
            code = (steps[len(motions)] if begin is not None and len(motions) < len(steps) else position)[2]
            if response.error is not None:
                error = response.error
            elif response.code != code:
                error = self._wrong_answer(response, code)
            elif begin is None:
                begin = signed(int.from_bytes(response.data[1:5], "big"))
            else:
                pulses = moves[len(motions)]
                self._mark = self.window.answers - 1
                self._motion = motion = self._make_motion(abs(pulses), _side(pulses), begin)
                motion._on_start_response(response.data[0] if response.data else None)
                motions.append(motion)
                begin += pulses

        position, steps = blocks.read_position(), [self.move_block(pulses, pps) for pulses in moves]
        before, self._mark = self._motion, self.window.answers
        self._motion = self._make_motion(None, CW, None)  # a move may be running if an exception is raised
        self._motion.stop_ordered = True
        self.link.forget_events()
        try:
            self.window.execute_moves(position, steps, LONGEST_WAIT_MS, on_answer)
            if not motions and error is None:
                error = Timeout(f"{self.link.name}: the part does not answer: is it in reset?")
        except PpmcError as caught:
            error = error or caught
        if not motions and isinstance(error, CommandRefused):
            self._motion = before
        return motions, error

    def reset(self) -> None:
        """Reset the part with its pin, in any state.

        The pulses end immediately. After the reset there is no table, and the position is 0.
        """
        self.link.execute(Script().reset())
        self._on_reset()

    def allow_run(self, on: bool) -> None:
        """Set the RUN input of the part with a strap of the board.

        A switch at the pin can keep RUN inactive even if the strap is set to active.
        """
        self._strap(RUN, on)

    def pulse_event(self, event: int) -> None:
        """Pulse event input 1 or 2 with a strap of the board.

        The pulse is 30 ms long, so that a part with DATASHEET timing accepts it.
        """
        bit = {1: EVENT_1, 2: EVENT_2}[blocks.buffer_number(event) + 1]
        self._strap(bit, False)
        self.link.pause(0.03)
        self._strap(bit, True)

    def _strap(self, bit: int, high: bool) -> None:
        self._straps = self._straps & ~bit | (bit if high else 0)
        self.link.execute(Script().straps(self._straps))
