"""Running motions: progress, wait for the end, and the search for the origin."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol

from ..lazy import Renamed
from ..model.motion.codes import ENDLESS, RAMP_OPERATIONS
from . import speeds
from .capabilities import Capabilities
from .check import Checked, side, within
from .errors import AxisBusy, ProtocolError, Timeout
from .link import LinkProtocol
from .motion_result import COUNTS, Cause, EndUnknown, MotionResult, OriginNotFound, decode_end
from .registers import ReadCodes
from .script import Script
from .speeds import Number

READ_FINISH = 0x80
SAFETY_POLL = 0.5
"""Time in s between two reads of BUSY during a wait for the interrupt message.

Noise on the line may destroy the interrupt message.
"""
PROGRESS_POLL = 0.1
OPERATION, OPERATION_PULSES, DIRECTION_BIT = 0x40, 0xC0, 3


@dataclass(frozen=True)
class MotionRequest:
    """Parameters of a motion to start.

    Attributes:
        operation: lowest three bits of the command code.
        requested: pulses, `None` for endless motions.
        clock: base clock, `None` for the base clock of the ramp.
    """

    operation: int
    direction: int
    data: bytes = b""
    requested: int | None = None
    clock: speeds.BaseClock | None = None
    pulse_only: bool = False

    @property
    def code(self) -> int:
        """Command byte without the bit that selects the axis."""
        group = OPERATION_PULSES if self.pulse_only else OPERATION
        return group | side(self.direction) << DIRECTION_BIT | self.operation

    @property
    def ramped(self) -> bool:
        """True if the motion has ramps. Only such a motion can stop with a ramp."""
        return self.operation in RAMP_OPERATIONS


@dataclass(frozen=True)
class Progress:
    """Argument of a progress callback.

    Attributes:
        position: value of the pulse counter.
        done: pulses output since the start.
        requested: pulses of the move, `None` for an endless motion.
        seconds: time since the start in s.
    """

    position: int
    done: int
    requested: int | None
    seconds: float
    made = Renamed("done")
    asked = Renamed("requested")


class AnyMotion(Protocol):
    """Running motion of any part; see `Motion`."""

    @property
    def result(self) -> MotionResult | None: ...
    @property
    def over(self) -> bool: ...
    @property
    def requested(self) -> int | None: ...
    def poll(self) -> Progress | None: ...
    def wait(
        self, timeout: float | None = None, progress: Callable[[Progress], None] | None = None
    ) -> MotionResult: ...


class MotionAxis(Protocol):
    """Members of an axis (`axis.Axis`) that a motion needs."""

    link: LinkProtocol
    _code_bits: int
    _busy_mask: int
    _zero_mask: int
    _known_count: int

    @property
    def _message_prefix(self) -> str: ...
    @property
    def _read_codes(self) -> ReadCodes: ...
    def _on_status(self, status: int) -> None: ...
    def _add_position_read(self, script: Script) -> Script: ...
    def _position_of(self, count: int) -> int | None: ...
    def _annotate(self, end: MotionResult) -> MotionResult: ...


class Handle(Checked):
    """Members that all motions have.

    Attributes:
        result: result of the motion, after the part has confirmed it.
        result_error: error of a motion that is over, but whose result the part has not confirmed.
        requested: pulses, `None` for endless motions.
    """

    result: MotionResult | None = None
    result_error: EndUnknown | None = None
    requested: int | None
    end = Renamed("result")
    asked = Renamed("requested")

    @property
    def over(self) -> bool:
        """True if the motion is over: `result` is set, or `poll` and `wait` raise EndUnknown."""
        return self.result is not None or self.result_error is not None

    def _confirmed_result(self) -> MotionResult | None:
        """Return the result, `None` while the motion is running. Raises EndUnknown."""
        if self.result_error is not None:
            raise self.result_error
        return self.result


class Motion(Handle):
    """Handle of a motion that was started; `result` is its result when it is known.

    Attributes:
        requested: pulses, `None` for endless motions.
        direction: 0 = CW, 1 = CCW.
        ramped: True if the motion has ramps.
        begin: value of the pulse counter before the motion.
        ours: False if another program started the motion.
        new: FINISH_NEW if a script may already have read the finish status, which clears its bit FINISH_NEW;
            otherwise 0.
    """

    requested: int | None
    direction: int
    ramped: bool
    operation: int
    begin: int

    def __init__(
        self, axis: MotionAxis, request: MotionRequest, begin: int, ours: bool = True, new: int = 0
    ) -> None:
        self._axis = axis
        self._link = axis.link
        self._ours = ours
        self._new = new
        self.requested = request.requested
        self.direction = request.direction
        self.ramped = request.ramped
        self.operation = request.operation
        self.begin = begin
        self._started = self._link.clock()

    def poll(self) -> Progress | None:
        """Return the current progress; `None` if the motor has stopped (then `result` is set).

        Raises:
            EndUnknown: the motor has stopped, but the part does not confirm how the motion ended.
        """
        self._confirmed_result()
        answer = self._link.execute(self._axis._add_position_read(Script().read(1)))
        self._on_status(answer.byte(0))
        self._axis._on_status(answer.byte(0))
        if self._confirmed_result() is not None:
            return None
        count = answer.number(1, signed=True)
        done = abs(count - self.begin)
        return Progress(
            self._axis._position_of(count) or 0, done, self.requested, self._link.clock() - self._started
        )

    def _on_status(self, status: int) -> None:
        """Process a value of the status register; if BUSY = 0, read how the motion ended.

        This method does not raise EndUnknown, so that a poll of one axis does not raise the error of another
        axis. Only `poll` and `wait` raise it.

        Raises:
            ProtocolError: the status has a bit set that always reads as 0.
        """
        if status & self._axis._zero_mask:
            raise ProtocolError(
                f"{self._link.name}: {self._axis._message_prefix}status 0x{status:02X} does not exist; "
                "the bus to the "
                "part is not connected, or another part is there: check the wiring"
            )
        if not self.over and not status & self._axis._busy_mask:
            self._finish()

    def wait(
        self, timeout: float | None = None, progress: Callable[[Progress], None] | None = None
    ) -> MotionResult:
        """Wait for the end of the motion and return the result, also if the motion ended early.

        Args:
            timeout: longest wait in s, `None` for no limit.
            progress: called about ten times a second. An exception that it raises ends the wait; the motion
                continues.

        Raises:
            Timeout: the time limit is exceeded; the motion continues.
            EndUnknown: the part does not confirm how the motion ended.
        """
        self._confirmed_result()
        limit = None if timeout is None else self._link.clock() + timeout
        pause = PROGRESS_POLL if progress else SAFETY_POLL
        while self.result is None:
            left = pause if limit is None else min(pause, limit - self._link.clock())
            self._link.wait_event(max(0.0, left))
            now = self.poll()
            if now is None:
                break
            if progress:
                progress(now)
            if limit is not None and self._link.clock() >= limit:
                raise Timeout(
                    f"motion still in progress after {timeout:g} s; increase timeout or stop the motion"
                )
        assert self.result is not None
        return self.result

    def _finish(self, finish: int | None = None) -> None:
        """Read the finish status, unless a script has already read it. The read releases int_n (P104-RD-04).

        With DATASHEET timing, BUSY rises up to 112 us after the command, and the part accepts no byte before
        (P104-DS-03). If the read is rejected in this time, the motion has not begun yet.
        """
        bit, remaining = self._axis._code_bits, self._axis._read_codes.remaining
        script = Script() if finish is not None else Script().call(READ_FINISH | bit).get(1)
        try:
            answer = self._link.execute(self._axis._add_position_read(script.call(remaining | bit).get(3)))
        except AxisBusy:
            return  # the motion has not begun yet
        self._decode(answer.byte(1) if finish is None else finish, *answer.values[-2:])

    def _decode(self, finish: int, remaining: bytes, counted: bytes) -> None:
        """Set `result` or `result_error` from the registers of the part and the pulse counter."""
        count = int.from_bytes(counted, "little", signed=True)
        self._axis._known_count = count
        position = self._axis._position_of(count)
        moved = None
        if self._ours and position is not None:
            moved = (count - self.begin + COUNTS // 2) % COUNTS - COUNTS // 2
        try:
            end = decode_end(
                finish | self._new,
                int.from_bytes(remaining, "little"),
                (self.requested or ENDLESS) if self._ours else None,
                self.direction,
                position,
                self.operation if self._ours else None,
                moved,
                f"{self._link.name}: {self._axis._message_prefix}",
            )
        except EndUnknown as error:
            self.result_error = error
        else:
            self.result = self._axis._annotate(end)


# Homing from any start position: it always approaches the same edge of the switch from the same side.

LONGEST_BACK_OFF = 200_000


class OriginInput(Protocol):
    """States of the switches; True = active."""

    @property
    def origin(self) -> bool: ...


class HomingAxis(Protocol):
    """Members of an axis that homing needs.

    The axis is an `axis.Axis`, or an axis of a part with other commands.
    """

    @property
    def kind(self) -> Capabilities: ...
    @property
    def _message_prefix(self) -> str: ...
    @property
    def position(self) -> int: ...
    @property
    def _default_speed(self) -> Number: ...
    def inputs(self) -> OriginInput: ...
    def search(self, direction: int, pps: Number | None = None) -> AnyMotion: ...
    def jog(self, direction: int, speed: Number | None = None, high: bool = False) -> AnyMotion: ...
    def move_constant(
        self, pulses: int, pps: Number, progress: Callable[[Progress], None] | None = None
    ) -> MotionResult: ...
    def zero(self) -> None: ...


class Homing:
    """Homing run of an axis; see `Axis.home`."""

    def __init__(
        self,
        axis: HomingAxis,
        direction: int,
        search_pps: Number | None,
        back_off: int,
        progress: Callable[[Progress], None] | None,
    ) -> None:
        within(back_off, "back_off", 1, LONGEST_BACK_OFF, "pulses")
        self._axis = axis
        self._towards = side(direction)
        self._pps = search_pps
        self._back_off = back_off
        self._progress = progress

    def run(self, fast: bool, to_limit: bool) -> MotionResult:
        """Find the switch and set the position to 0 at its edge.

        First approach the switch at high speed if requested. If the switch is now active, move away from it.
        Finally, search for the edge of the switch.
        """
        if (fast or to_limit) and not self._axis.inputs().origin:
            self._approach(to_limit)
            if self._axis.kind.origin_between and not self._axis.inputs().origin:
                self._search(1 - self._towards)
        if self._axis.inputs().origin:
            self._leave()
        end = self._search(self._towards)
        self._axis.zero()
        return replace(end, position=None if end.position is None else 0)

    def _search(self, direction: int) -> MotionResult:
        """Search for the origin switch at constant speed, and return the result."""
        end = self._axis.search(direction, self._pps).wait(progress=self._progress)
        if end.cause & (Cause.LIMIT | Cause.SLOW_LIMIT):
            raise OriginNotFound(
                f"{end.message_prefix}a limit switch was reached before the origin: home in the other "
                "direction, or check the switches",
                end,
            )
        return self._check_found(end)

    @staticmethod
    def _check_found(end: MotionResult) -> MotionResult:
        """Return the result of a search if the origin switch ended it.

        Raises:
            OriginNotFound: the search output all its pulses and did not find the switch.
            MotionError: another cause ended the search; see `MotionResult.check`.
        """
        if end.cause is Cause.ORIGIN:
            return end
        raise OriginNotFound(
            f"{end.message_prefix}the search ended after {abs(end.check().pulses or 0)} pulses without "
            "the origin; "
            "check the switch",
            end,
        )

    def _approach(self, to_limit: bool) -> None:
        """Run at high speed to the slow-down limit; if `to_limit` is set, continue to the hard limit."""
        end = self._axis.jog(self._towards, high=True).wait(progress=self._progress)
        if to_limit and end.cause == Cause.SLOW_LIMIT:
            end = self._axis.jog(self._towards, speed=self._pps).wait(progress=self._progress)
        if to_limit and end.cause & Cause.LIMIT and not end.cause & (Cause.ALARM | Cause.STOP):
            return
        if end.cause != Cause.SLOW_LIMIT:
            raise OriginNotFound(
                f"{end.message_prefix}no limit switch ended the approach after "
                f"{abs(end.check().pulses or 0)} pulses; "
                "check the switches",
                end,
            )

    def _leave(self) -> None:
        """Move away from the switch in small moves until it is released."""
        gone = 0
        step = -self._back_off if not self._towards else self._back_off
        while self._axis.inputs().origin:
            if gone > LONGEST_BACK_OFF:
                end = MotionResult(Cause.COMPLETE, gone, 0, self._axis.position, 0)
                raise OriginNotFound(
                    f"{self._axis._message_prefix}the origin switch is still active after a move of {gone} "
                    "pulses away "
                    "from it: check the switch",
                    end,
                )
            pps = self._pps if self._pps is not None else self._axis._default_speed
            self._axis.move_constant(step, pps, self._progress)
            gone += self._back_off
