"""Axis of a part: set-up, speeds, motions and registers that all parts share."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

from ..model.motion.codes import ACC_DEC, CONSTANT, CONTINUOUS, ENDLESS, HIGH_SPEED, ORIGIN, SINGLE_STEP
from . import speeds
from .capabilities import CHOPPER, COILS_OFF, PULSE_ONLY, RateCapabilities, SetupRequest
from .check import Checked, wholes
from .errors import (
    AlreadyDecelerating,
    AxisBusy,
    NothingToStop,
    OutOfRange,
    PpmcError,
    ProtocolError,
    StartRefused,
)
from .link import LinkProtocol
from .motion import READ_FINISH, Homing, Motion, MotionRequest, Progress
from .motion_result import Cause, MotionResult, position_lost
from .registers import FAMILY, Outputs, ReadCodes, Switches
from .script import Script
from .speeds import Number, exact, nearby

OnProgress = Callable[[Progress], None]


EXCITATION_OFF = 0xC0
OPERATION_BITS = 7
"""Bits of the finish status that contain the code of the last operation.

They are 0 from a reset to the first operation.
"""
CW, CCW = 0, 1
STOP_NOW, STOP_SLOWLY = 0x40, 0x41

# Chopper at standstill, for parts that have the chopper of the PPMC-104 (P104-SW-04).

SWITCHING = 0x84


def chop_byte(xtal_hz: int, microseconds: Number, phase: str, vsel: int) -> tuple[int, Fraction]:
    """Return the chopper byte nearest to a time, and the resulting time in us (P104-SW-04).

    Args:
        microseconds: requested time.
        phase: "on" or "off".

    Raises:
        OutOfRange: the time is out of range; the message states the range.
    """
    quantum = Fraction(4_000_000, xtal_hz)
    offset = {("on", 1): 108, ("on", 0): 100, ("off", 1): 132, ("off", 0): 115}[phase, vsel] * quantum
    unit = 12 * quantum
    low, high = offset, offset + 255 * unit
    requested = exact(microseconds, f"{phase} time")
    if not low <= requested <= high:
        raise OutOfRange(
            f"{phase} time {nearby(microseconds)} us is outside {nearby(low)} to {nearby(high)} us"
        )
    byte = min(255, int((requested - offset) / unit + Fraction(1, 2)))
    return byte, offset + byte * unit


class Axis(Checked):
    """Axis of a part.

    Directions are 0 or CW, 1 or CCW. Speeds are in pulses per second. Pulses are signed, CW positive. Any
    method may raise a LinkError; commands may raise the CommandRefused errors of the part. The class of each
    part defines how the straps are set, how the switches are read, and the additional functions of the part.

    Attributes:
        setup: set-up of the last initialisation by this object, `None` before the first.
        number: number of the axis.
        _code_bits: bits that select this axis in command codes.
        _busy_mask: BUSY bit of this axis in the status register.
        _zero_mask: bits of the status register that always read as 0.
    """

    kind: RateCapabilities
    number = 1
    _code_bits = 0
    _busy_mask = 0x04
    _zero_mask = 0x08
    link: LinkProtocol
    setup: speeds.Setup | None

    def __init__(self, link: LinkProtocol) -> None:
        self.link = link
        self.setup = None
        self._motion: Motion | None = None
        self._known_count = 0

    @property
    def motion(self) -> Motion | None:
        """Motion that was started last, `None` before the first."""
        return self._motion

    @property
    def _read_codes(self) -> ReadCodes:
        """Codes of the read commands that differ between parts."""
        return FAMILY

    @property
    def _message_prefix(self) -> str:
        """Prefix of messages about this axis; empty if the part has one axis."""
        return f"axis {self.number}: " if self.kind.axes > 1 else ""

    def _annotate(self, end: MotionResult) -> MotionResult:
        """Return the result `end` with the message prefix and the alarm name of this axis."""
        return replace(end, message_prefix=self._message_prefix, alarm=self.kind.alarm)

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
        """Set speeds, ramp and motor of this axis; return the set-up with the speeds that are reached.

        The docstring of each driver states the limits of the part, and which settings cannot be changed until
        `reset`.

        Args:
            start_pps: start speed in pps.
            high_pps: high speed in pps, not below start_pps.
            ramp_pulses: pulses from the start speed to the high speed.
            phases: 3, 4 or 5.
            half_step: half steps instead of full steps.
            positive_logic: True if a high level switches a coil on. This is the default if the part supports
                both.
            chop: True to chop the coil currents while the motor is stopped.
            base_clock: one of the base clocks of the part in Hz; `None` selects one that reaches start_pps.
            external_clock: frequency of the external clock at the clock pin in Hz.
            long_intervals: True to set vsel low, which makes each interval 7.5 us longer.

        Raises:
            OutOfRange: an argument is out of range, or the part does not support it.
            AxisBusy: a motion is running.
        """
        request = SetupRequest(
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
        if self._known_count:
            self._check_count(self._count())
        return self.apply(self.kind.plan(self.link.identity.xtal_hz, request))

    # ------------------------------------------------------------------ implemented by each part

    def _strap_script(self, clock: speeds.BaseClock | None) -> Script:
        """Return the script that sets the strap pins for this base clock; `None`: any level is accepted."""
        raise NotImplementedError

    def inputs(self) -> Switches:
        """Return the states of the switches. The call is allowed at any time."""
        raise NotImplementedError

    def apply(self, setup: speeds.Setup) -> speeds.Setup:
        """Initialise the axis with a set-up planned earlier for this axis."""
        raise NotImplementedError

    @property
    def _default_speed(self) -> speeds.Number:
        """Default speed of searches and jogs in pps: the start speed.

        Raises:
            OutOfRange: the axis was not initialised.
        """
        if self.setup is None:
            raise OutOfRange("no speed given, and no default before an initialisation: give a speed in pps")
        return self.setup.start.reached

    def _rate(self, pps: speeds.Number | None) -> tuple[speeds.BaseClock, int]:
        """Return (base clock, rate byte) of a constant speed.

        The base clock may differ from the base clock of the ramp if both are internal clocks.
        """
        if pps is None:
            pps = self._default_speed
        ramp = self.setup.clock if self.setup else None
        clock = self.kind.constant_clock(self.link.identity.xtal_hz, ramp, pps)
        return clock, clock.choose(pps).rate

    # ------------------------------------------------------------------ registers

    def outputs(self) -> Outputs:
        """Return the motor outputs. Raises AxisBusy during a motion."""
        return Outputs.parse(
            self.link.execute(Script().call(self._read_codes.outputs | self._code_bits).get(1)).byte(1)
        )

    def remaining(self) -> int:
        """Return the remaining-pulse register of the last motion. The call is not allowed during a motion.

        The register holds the number of remaining pulses minus 1; if no pulse remains, it holds 0.
        """
        return self.link.execute(Script().call(self._read_codes.remaining | self._code_bits).get(3)).number(1)

    @property
    def position(self) -> int:
        """Position in the pulse counter of the bridge, CW positive. The call is allowed at any time.

        Raises:
            ProtocolError: the board has no counter, or a restart of the board has cleared the counter. After
                a restart, the next call returns the new value.
        """
        position = self._position_of(self._check_count(self._count()))
        if position is None:
            raise ProtocolError(f"{self.link.name}: this board has no pulse counter, so no position")
        return position

    def _check_count(self, count: int) -> int:
        """Check a value of the position counter, and return it.

        Raises:
            ProtocolError: a restart of the board has set the counter to 0. The driver detects the restart
                because the finish status indicates no motion since the reset.
        """
        known, self._known_count = self._known_count, count
        motion = self._motion
        if count or not known or (motion is not None and not motion.over and motion.poll() is not None):
            return count
        try:
            finish = self.link.execute(Script().call(READ_FINISH | self._code_bits).get(1)).byte(1)
        except AxisBusy:
            return count  # another program has started a motion
        if not finish & OPERATION_BITS:
            lost = self._position_of(known)
            self._on_reset()
            raise position_lost(f"{self.link.name}: {self._message_prefix}", lost)
        return count

    def _add_position_read(self, script: Script) -> Script:
        """Add a read of the position counter of this axis to a script. It returns one value of 4 bytes."""
        return script.count(self.number)

    def _position_of(self, count: int) -> int | None:
        """Return the position for a value of the counter, `None` if the board has no counter."""
        return count if self.link.identity.counter else None

    def _count(self) -> int:
        return self.link.execute(self._add_position_read(Script())).number(0, signed=True)

    def zero(self) -> None:
        """Set the current position to 0.

        Raises:
            AxisBusy: a motion that this object started is running. When a motion ends, its pulses are
                compared with the pulse counter, so the counter must not be changed until then.
        """
        motion = self._motion
        if motion is not None and not motion.over and motion.poll() is not None:
            raise AxisBusy(self._busy_mask)
        self.link.execute(Script().zero(self.number))
        self._known_count = 0

    def excitation_off(self) -> None:
        """Switch all coils off; the axis must be initialised again.

        No command is sent during a motion, because a PPMC-104 then executes this code as another command
        (P104-AUX-05).

        Raises:
            AxisBusy: a motion is running.
            OutOfRange: the part is an STMC, which has no such command.
        """
        self.kind.need(COILS_OFF)
        self._at_rest(Script().call(EXCITATION_OFF | self._code_bits))

    def switching(self, on_us: Number, off_us: Number) -> tuple[Fraction, Fraction]:
        """Set the chopper times at standstill in us; return the times that are reached.

        Ranges at 16 MHz: on 27 to 792 us, off 33 to 798 us.

        Raises:
            OutOfRange: a time is out of range, or the part does not have this command.
        """
        self.kind.need(CHOPPER)
        vsel = self.setup.clock.vsel if self.setup else 1
        on = chop_byte(self.link.identity.xtal_hz, on_us, "on", vsel)
        off = chop_byte(self.link.identity.xtal_hz, off_us, "off", vsel)
        self.link.execute(Script().call(SWITCHING, on[0], off[0]))
        return on[1], off[1]

    def _on_reset(self) -> None:
        """Discard set-up and motion, because the part was reset."""
        self.setup = self._motion = None
        self._known_count = 0

    def _at_rest(self, script: Script) -> None:
        """Execute a script on condition that BUSY = 0; the bridge checks this before the first operation."""
        answer = self.link.attempt(
            Script().timeout(0).wait(1, self._busy_mask, 0).timeout(250).extend(script)
        )
        if answer.failed is not None and answer.failed.name == "WAIT":
            raise AxisBusy(answer.last)
        self.link.check_answer(answer)

    # ------------------------------------------------------------------ stop commands

    def _on_status(self, status: int) -> None:
        """Process a value of the status register that was read during a motion of this axis."""

    def _send_stop(self, now: bool) -> None:
        """Send the stop command, immediate or with a ramp. Raises the error that the part reports."""
        self.link.execute(Script().call((STOP_NOW if now else STOP_SLOWLY) | self._code_bits))

    def _request_stop(self, now: bool = False) -> None:
        """Request a stop of the motion that this object started, without waiting.

        If the part rejects the stop because the motion is already decelerating or has ended, the call is not
        an error.
        """
        try:
            self._send_stop(now)
        except (AlreadyDecelerating, NothingToStop):
            pass

    # ------------------------------------------------------------------ motions

    def start_move(self, pulses: int, pulse_only: bool = False) -> Motion:
        """Start a move with ramps.

        Args:
            pulses: 1 to 16 777 216 in either direction.
            pulse_only: True to output pulses without changing the phases.
        """
        return self._start_motion(self._move_request(pulses, pulse_only=pulse_only))

    def start_constant(self, pulses: int, pps: speeds.Number) -> Motion:
        """Start a move at constant speed, without ramps."""
        return self._start_motion(self._move_request(pulses, pps))

    def jog(
        self,
        direction: int,
        speed: speeds.Number | None = None,
        high: bool = False,
        pulse_only: bool = False,
    ) -> Motion:
        """Run until a stop command, a limit or the alarm.

        Args:
            speed: constant speed in pps, default: the start speed.
            high: True to accelerate with a ramp to the high speed instead.
        """
        if high:
            if speed is not None:
                raise OutOfRange("jog: either a speed or high, not both")
            return self._start_motion(MotionRequest(HIGH_SPEED, direction, pulse_only=pulse_only))
        clock, rate = self._rate(speed)
        return self._start_motion(MotionRequest(CONTINUOUS, direction, bytes([rate]), clock=clock))

    def search(self, direction: int, pps: speeds.Number | None = None) -> Motion:
        """Run at constant speed until the origin switch, a stop command, a limit or the alarm."""
        clock, rate = self._rate(pps)
        return self._start_motion(MotionRequest(ORIGIN, direction, bytes([rate]), clock=clock))

    def step(self, direction: int) -> MotionResult:
        """Output one pulse."""
        return self._start_motion(MotionRequest(SINGLE_STEP, direction, requested=1)).wait().check(1)

    def home(
        self,
        direction: int = CCW,
        search_pps: speeds.Number | None = None,
        fast: bool = False,
        to_limit: bool = False,
        back_off: int = 100,
        progress: OnProgress | None = None,
    ) -> MotionResult:
        """Find the edge of the origin switch, always from the same side, and set the position there to 0.

        Args:
            direction: direction towards the switch.
            search_pps: speed of the search in pps, default: the start speed.
            fast: True to run at high speed to the slow-down limit first.
            to_limit: True to continue to the hard limit, and search from there.
            back_off: pulses of each move away from the switch if it is active at the start of the search.

        Raises:
            OriginNotFound, LimitReached, AlarmStop, StoppedByCommand: homing did not succeed.
        """
        return Homing(self, direction, search_pps, back_off, progress).run(fast, to_limit)

    def stop(self, wait: bool = True) -> MotionResult | None:
        """Stop with a ramp; return the result, or `None` if wait is False.

        A motion at constant speed stops immediately. If the motor is already decelerating or has just
        stopped, the call is not an error.

        Raises:
            NothingToStop: the motor was already stopped.
        """
        return self._stop(False, wait)

    def halt(self, wait: bool = True) -> MotionResult | None:
        """Stop immediately; steps may be lost at high speed.

        In all other respects, the method works like `stop`.
        """
        return self._stop(True, wait)

    def _stop(self, now: bool, wait: bool) -> MotionResult | None:
        motion = self._motion
        if motion is None or motion.over:
            # Another program may have started a motion.
            motion = Motion(self, MotionRequest(CONTINUOUS, CW), 0, ours=False)
            self._send_stop(now)
        else:
            self._request_stop(now)
        self._motion = motion
        return motion.wait() if wait else None

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

        One frame contains several moves, so short moves need much less time than with `move`. The iteration
        starts the moves. Up to 16 numbers are taken from `pulses` in advance, and a move may have ended
        before its result is yielded. A move that does not end as requested is the last one.

        Args:
            pps: constant speed, `None` for moves with ramps.

        Raises:
            LimitReached, AlarmStop, StoppedByCommand: a move ended before all pulses were output.
            OutOfRange: a number is out of range. Earlier moves that belong to the same frame are not started
                either.
        """
        from .moves import AHEAD, execute_moves, run_moves  # only this method needs the module

        numbers = wholes(pulses, "pulses")
        if self._position_of(0) is None:  # no counter confirms the ends of moves in a frame
            return (self.move_constant(one, pps) if pps and one else self.move(one) for one in numbers)

        def execute(moves: Sequence[int]) -> tuple[Sequence[Motion], PpmcError | None]:
            return execute_moves(self, [self._move_request(one, pps) for one in moves])

        return run_moves(numbers, AHEAD, execute, self._empty_move_result)

    # ------------------------------------------------------------------ starting

    def _move_request(
        self, pulses: int, pps: speeds.Number | None = None, pulse_only: bool = False
    ) -> MotionRequest:
        """Return the request of a move: with ramps, or at constant speed if pps is not `None`.

        Raises:
            OutOfRange: the part does not support these values.
        """
        direction = CCW if pulses < 0 else CW
        if not 1 <= abs(pulses) <= ENDLESS:
            raise OutOfRange(f"{pulses} pulses: a move has 1 to {ENDLESS} pulses either way")
        data = (abs(pulses) - 1).to_bytes(3, "little")
        if pps is None:
            return MotionRequest(ACC_DEC, direction, data, abs(pulses), pulse_only=pulse_only)
        clock, rate = self._rate(pps)
        return MotionRequest(CONSTANT, direction, bytes([rate]) + data, abs(pulses), clock)

    def _start_motion(self, request: MotionRequest) -> Motion:
        """Start a motion with one frame.

        The frame clears a pending interrupt, sets the straps, reads the counter and sends the command.
        """
        if request.pulse_only:
            self.kind.need(PULSE_ONLY)
        script = self._start_script(request).call(request.code | self._code_bits, *request.data)
        self.link.forget_events()
        answer = self.link.execute(script)
        return self._motion_started(request, answer.number(2, signed=True))

    def _start_script(self, request: MotionRequest) -> Script:
        """Return the part of the script that precedes the command of a motion.

        The third value of its answer is the position counter.
        """
        script = Script().call(READ_FINISH | self._code_bits).get(1)
        return self._add_position_read(script.extend(self._strap_script(self._clock_for(request))))

    def _refused_start_motion(self, request: MotionRequest, refused: StartRefused) -> Motion:
        """Return a motion without pulses if a switch has prevented the start; else raise the rejection."""
        raise refused

    def _motion_started(self, request: MotionRequest, begin: int) -> Motion:
        """Store the motion that the part has started.

        Args:
            begin: value of the pulse counter before the motion.
        """
        self._motion = Motion(self, request, begin)
        return self._motion

    def _clock_for(self, request: MotionRequest) -> speeds.BaseClock | None:
        """Return the base clock of a request, `None` if it is unknown."""
        if request.clock is not None:
            return request.clock
        return None if self.setup is None else self.setup.clock

    def _empty_move_result(self) -> MotionResult:
        """Return the result of a move of 0 pulses."""
        return self._annotate(MotionResult(Cause.COMPLETE, 0, 0, self._position_of(self._count()), 0))
