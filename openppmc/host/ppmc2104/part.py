"""Driver of a PPMC-2104 on a UART bridge: two axes."""

from __future__ import annotations

from collections.abc import Mapping

from ...lazy import Renamed
from ...model.ppmc2104.codes import CMND, IBF
from .. import speeds
from ..axis import Axis, OnProgress
from ..capabilities import AXIS_BIT
from ..check import whole, within
from ..errors import AlreadyDecelerating, CommandRefused, PpmcError, ProtocolError
from ..link import Link
from ..motion import PROGRESS_POLL, READ_FINISH, SAFETY_POLL, Motion, Progress
from ..motion_result import EndUnknown, MotionResult
from ..part import Part
from ..script import Answer, Script
from .axis import Axis2104
from .registers import BY_NUMBER, CAPABILITIES, Status, command_error

READ_ERROR, AUX_INPUT, AUX_OUTPUT = 0x86, 0xC2, 0xC1
ALL_HIGH = 0xFF
CSEL, RUN, PINS_OF_1 = (0x01, 0x02), (0x04, 0x08), 0x80
"""Bits of the straps: csel of each axis, run of each axis, and the bit that selects the axis for PINS."""


class Axes(dict[int, Axis2104]):
    """Axes by number."""

    def __missing__(self, number: object) -> Axis2104:
        return self[CAPABILITIES.check_axis(whole(number, "axis"))]


class Ppmc2104(Part):
    """PPMC-2104 on a bridge. An object is a context manager; see `part.Part`.

    `x` is axis 1, `y` axis 2; `axis[1]` and `axis[2]` are the same objects. Opening the part reads and clears
    the errors that other programs caused, and ends their unfinished commands. A running motion continues.
    """

    kind = CAPABILITIES
    x: Axis2104
    y: Axis2104
    axis: Mapping[int, Axis2104]
    together = Renamed("move_together")
    start_together = Renamed("start_moves")

    def __init__(self, link: Link) -> None:
        self.link = link
        link.refusal = self._refusal
        self.x, self.y = Axis2104(self, 1), Axis2104(self, 2)
        self.axis = Axes({1: self.x, 2: self.y})
        self._levels = ALL_HIGH
        self._clear_errors()
        busy = self.status().busy
        # These motions were started by another program. If it was aborted, such an axis may still wait for
        # RUN. It must not start now.
        self._foreign = {number for number in self.axis if busy[number - 1]}
        self._run_held = set(self._foreign)
        for number in set(self.axis) - self._foreign:
            self._read_finish(number)

    @property
    def axes(self) -> tuple[Axis, ...]:
        return (self.x, self.y)

    def _other_axis(self, number: int) -> Axis2104:
        """Return the axis other than the one with this number."""
        return self.axis[3 - number]

    # ------------------------------------------------------------------ both axes

    def move_together(
        self,
        x: int,
        y: int,
        x_pps: speeds.Number | None = None,
        y_pps: speeds.Number | None = None,
        progress: OnProgress | None = None,
        pulse_only: bool = False,
    ) -> tuple[MotionResult, MotionResult]:
        """Start moves of both axes in the same cycle, and wait for both.

        If the motion of one axis ends early, the other axis is stopped with a ramp.

        Args:
            x: pulses of axis 1, as in `Axis.move`.
            y: pulses of axis 2.
            x_pps: constant speed of axis 1, `None` for a move with ramps.
            y_pps: constant speed of axis 2, `None` for a move with ramps.

        Raises:
            LimitReached, AlarmStop, StoppedByCommand: cause of the first early end.
        """
        if not (x and y):
            ends = [
                axis._empty_move_result()
                if not pulses
                else axis._start_motion(axis._move_request(pulses, pps, pulse_only))
                .wait(progress=progress)
                .check(abs(pulses))
                for axis, pulses, pps in ((self.x, x, x_pps), (self.y, y, y_pps))
            ]
            return ends[0], ends[1]
        motions = self.start_moves(x, y, x_pps, y_pps, pulse_only)
        first = self._wait(motions, progress)
        if first is not None:
            first.wait().check(first.requested)
        return motions[0].wait(), motions[1].wait()

    def start_moves(
        self,
        x: int,
        y: int,
        x_pps: speeds.Number | None = None,
        y_pps: speeds.Number | None = None,
        pulse_only: bool = False,
    ) -> tuple[Motion, Motion]:
        """Start two moves in the same cycle: both commands wait until RUN of both axes rises.

        If the part rejects one of the commands, neither axis moves.

        Raises:
            OutOfRange: a number of pulses is 0.
        """
        requests = (self.x._move_request(x, x_pps, pulse_only), self.y._move_request(y, y_pps, pulse_only))
        for number in self.axis:
            self._read_finish(number)  # while this axis moves, the part rejects the command
        script = Script()
        waiting = self._levels & ~(RUN[0] | RUN[1])
        for axis, request in zip(self.axis.values(), requests, strict=True):
            waiting = _with_csel(waiting, axis.number, axis._clock_for(request))
        script.straps(waiting).count(1).count(2)
        for axis, request in zip(self.axis.values(), requests, strict=True):
            script.call(request.code | axis._code_bits, *request.data)
        # With DATASHEET timing, the part samples RUN only after its processing time (P2104-DS-14).
        script.wait(1, CMND[0] | CMND[1], 0).straps(waiting | RUN[0] | RUN[1])
        self.link.forget_events()
        try:
            answer = self.link.execute(script)
        except BaseException:
            self._cancel_start()
            raise
        self._levels = waiting | RUN[0] | RUN[1]
        begins = [answer.number(place, signed=True) for place in (0, 1)]
        return self.x._motion_started(requests[0], begins[0]), self.y._motion_started(requests[1], begins[1])

    def _cancel_start(self) -> None:
        """Cancel a common start that failed, so that no axis waits for RUN any more.

        If the start was executed and only its answer was lost, the axes are already running. They stop with a
        ramp.
        """
        try:
            for axis in self.axis.values():
                try:
                    axis._send_stop(now=False)
                except AlreadyDecelerating:
                    axis._send_stop(now=True)
                except CommandRefused:
                    continue
            for axis in self.axis.values():
                self.link.execute(Script().wait(1, axis._busy_mask, 0))
                self._read_finish(axis.number)
            self.link.execute(Script().straps(self._levels))
        except PpmcError:
            self._run_held = set(self.axis)

    def _wait(self, motions: tuple[Motion, Motion], progress: OnProgress | None) -> Motion | None:
        """Wait until both motions have ended; return the motion that ended early, if any.

        If a motion ends early, the other motion is stopped.
        """
        pause = PROGRESS_POLL if progress else SAFETY_POLL
        first: Motion | None = None
        while running := [motion for motion in motions if not motion.over]:
            self.link.wait_event(pause)
            seen = [now for motion in running if (now := self._poll(motion)) is not None]
            if first is None:
                first = next(
                    (one for one in motions if one.over and not (one.result and one.result.complete)), None
                )
                for axis in self.axis.values() if first is not None else ():
                    if axis.motion is not None and not axis.motion.over:
                        axis._request_stop()
            if progress and seen:
                progress(seen[-1])
        return first

    @staticmethod
    def _poll(motion: Motion) -> Progress | None:
        """Poll a motion as `Motion.poll` does, but do not raise EndUnknown.

        EndUnknown is raised later, when both motors have stopped.
        """
        try:
            return motion.poll()
        except EndUnknown:
            return None

    # ------------------------------------------------------------------ straps

    def _strap_script(self, number: int, clock: speeds.BaseClock | None) -> Script:
        """Return a script that sets the straps for a motion of one axis with this base clock.

        If the other axis may be waiting for RUN, its RUN stays low.
        """
        self._levels = _with_csel(self._levels, number, clock)
        return Script().straps(self._run_low(self._run_held - {number}))

    def _set_idle(self, number: int) -> None:
        """Store that this axis does not wait for RUN."""
        self._run_held.discard(number)
        self._foreign.discard(number)

    def _resolve_foreign(self, number: int) -> None:
        """Read the end status of a motion that another program started; int_n stays low until this read.

        The motion of this axis has ended. The status is read only once.
        """
        if number in self._foreign:
            self._foreign.discard(number)
            self._read_finish(number)

    def _read_finish(self, number: int) -> None:
        self.link.execute(Script().call(READ_FINISH | self.axis[number]._code_bits).get(1))

    def _run_low(self, axes: set[int]) -> int:
        """Return the straps, with RUN of these axes low."""
        return self._levels & ~sum(RUN[axis - 1] for axis in axes)

    def _select_pins(self, number: int) -> Script:
        """Return a script that selects the axis whose pins the next PINS operation returns."""
        self._levels = self._levels | PINS_OF_1 if number == 1 else self._levels & ~PINS_OF_1
        return Script().straps(self._run_low(self._run_held))

    # ------------------------------------------------------------------ registers, auxiliary, reset

    def status(self) -> Status:
        """Return the status register. The call is allowed at any time."""
        return Status.parse(self.link.execute(Script().read(1)).byte(0))

    def auxo(self, value: int) -> None:
        """Set the two auxiliary outputs, 0 to 3; a 1 sets a pin low. The call is allowed at any time."""
        self.link.execute(Script().call(AUX_OUTPUT | within(value, "outputs", 0, 3) << 4))

    def auxi(self) -> int:
        """Return the two auxiliary inputs as pin levels. The call is allowed at any time."""
        return self.link.execute(Script().call(AUX_INPUT).get(1)).byte(1)

    def reset(self) -> None:
        """Reset the part in any state.

        The pulses end immediately. After the reset all coils are off, and no axis is initialised.
        """
        self.link.execute(Script().reset())
        self._run_held.clear()
        self._foreign.clear()
        for axis in self.axis.values():
            axis._on_reset()

    # ------------------------------------------------------------------ errors

    def _error_reads(self) -> Script:
        """Return a script that reads and clears both error registers.

        The script does not use CALL, because an error of the other axis would end CALL.
        """
        script = Script()
        for bit in (0, AXIS_BIT):
            script.post(1, bytes([READ_ERROR | bit])).wait(1, IBF | CMND[0] | CMND[1], 0).get(1)
        return script

    def _clear_errors(self) -> None:
        """Clear errors, unfinished commands and unread answers of another program.

        The code of the instruction that reads the error is written twice. If a command waits for data, the
        part discards the first code and ends the command. The second code is executed.
        """
        self.link.execute(
            Script()
            .timeout(3000)
            .post(1, bytes([READ_ERROR, READ_ERROR]))
            .wait(1, IBF | CMND[0] | CMND[1], 0)
            .get(1)
        )
        self.link.execute(self._error_reads())

    def _refusal(self, answer: Answer) -> Exception:
        """Read the error registers, and return the exception for a rejected command."""
        errors = self.link.execute(self._error_reads())
        numbers = errors.byte(1), errors.byte(3)
        code = answer.failed.code[1] if answer.failed is not None and answer.failed.name == "CALL" else 0
        place = int(bool(code & AXIS_BIT))
        if not numbers[place]:
            place = 1 - place
        if numbers[place] not in BY_NUMBER:
            return ProtocolError(f"{self.link.name}: the part reported an error and then no error; try again")
        return command_error(numbers[place], answer.last, place + 1)


def _with_csel(levels: int, number: int, clock: speeds.BaseClock | None) -> int:
    """Return the straps with CSEL of one axis set for this base clock."""
    if clock is None:
        return levels
    bit = CSEL[number - 1]
    return levels | bit if clock.csel else levels & ~bit
