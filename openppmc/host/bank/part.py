"""Driver of a bank on a UART bridge. Each axis of the bank works like a PPMC-104."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from ...lazy import Renamed
from .. import speeds
from ..axis import OnProgress
from ..capabilities import PULSE_ONLY
from ..check import whole
from ..errors import CommandRefused, OutOfRange
from ..link import Link
from ..motion import PROGRESS_POLL, READ_FINISH, SAFETY_POLL, Motion, MotionRequest
from ..motion_result import MotionResult
from ..part import Part
from ..registers import Inputs, Status
from ..script import Script
from .axis import BankAxis
from .group import Group, numbers_of, write_mask
from .registers import (
    CAPABILITIES,
    PENDING,
    POSITION,
    POSITION_BYTES,
    SELECT,
    STATUS,
    STOP,
    AxisSnapshot,
    BankCapabilities,
    BankStatus,
    Info,
    members,
)
from .window import read_info, visit


class Axes(dict[int, BankAxis]):
    """Axes by number."""

    def __init__(self, kind: BankCapabilities, axes: Iterable[BankAxis]) -> None:
        super().__init__({axis.number: axis for axis in axes})
        self._kind = kind

    def __missing__(self, number: object) -> BankAxis:
        return self[self._kind.check_axis(whole(number, "axis"))]


class PpmcBank(Part):
    """Bank of axes. A bank is a context manager; see `part.Part`.

    `axis[1]` to `axis[N]` are axes 0 to N − 1 of the window. When a bank is opened, the driver reads and
    checks INFO (WrongDevice), reads finish statuses that other programs left unread, and clears MASK. Running
    motions continue. All axes share the bridge, so only one call at a time is allowed, for whichever axis.
    """

    kind: BankCapabilities = CAPABILITIES
    axis: Mapping[int, BankAxis]
    together = Renamed("move_together")
    start_together = Renamed("start_moves")
    look = Renamed("snapshot")

    def __init__(self, link: Link) -> None:
        self.link = link
        self._info = read_info(link)
        self.kind = replace(CAPABILITIES, axes=self._info.axes)
        self.axis = Axes(self.kind, (BankAxis(self, number) for number in range(1, self._info.axes + 1)))
        self._group: Group | None = None
        visit(link, write_mask(self.kind, ()))
        for number in self.pending():
            self._read_finish(number)

    @property
    def axes(self) -> tuple[BankAxis, ...]:
        return tuple(self.axis.values())

    def info(self) -> Info:
        """Return the version of the window and the number of axes, as read when the bank was opened."""
        return self._info

    def _all(self, script: Script) -> list[tuple[bytes, ...]]:
        return visit(self.link, [(number, script) for number in self.axis])

    # ------------------------------------------------------------------ reading

    def positions(self) -> dict[int, int]:
        """Return the positions of all axes by number. The call is allowed at any time."""
        seen = self._all(Script().read_number(POSITION, POSITION_BYTES))
        return {
            axis.number: axis._position_of(_signed(one)) for axis, (one,) in zip(self.axes, seen, strict=True)
        }

    def position(self, axis: int) -> int:
        """Return the position of one axis. The call is allowed at any time."""
        return self.axis[axis].position

    def status(self) -> BankStatus:
        """Return the status registers of all axes. The call is allowed at any time."""
        return BankStatus.parse(b"".join(one for (one,) in self._all(Script().read(STATUS))))

    def snapshot(self, axes: Iterable[int] | None = None) -> dict[int, AxisSnapshot]:
        """Return status, position and switches of axes by number. The call is allowed at any time.

        Args:
            axes: numbers of the axes, None for all.
        """
        numbers = tuple(self.axis) if axes is None else numbers_of(self.kind, axes)
        script = Script().read(STATUS).read_number(POSITION, POSITION_BYTES).pins()
        seen = visit(self.link, [(number, script) for number in numbers])
        return {
            number: AxisSnapshot(
                Status.parse(raw[0]), self.axis[number]._position_of(_signed(at)), Inputs.of_pins(pins[0])
            )
            for number, (raw, at, pins) in zip(numbers, seen, strict=True)
        }

    def pending(self) -> tuple[int, ...]:
        """Return the numbers of the axes whose interrupt is pending (BANK-WIN-08).

        The motion of each of these axes has ended, and no program has read its finish status yet.

        The call is allowed at any time.
        """
        count = (self._info.axes + 7) // 8
        seen = visit(self.link, [(k + 1, Script().read(PENDING)) for k in range(count)])
        return members(b"".join(one for (one,) in seen))

    # ------------------------------------------------------------------ groups

    def group(self, axes: Iterable[int]) -> Group:
        """Return a group for `with bank.group((1, 2, 5)):`; its motions start in the same cycle."""
        if self._group is not None:
            raise OutOfRange(
                f"a group is open already, of axes {_listed(self._group.numbers)}: close it first"
            )
        return Group(self, axes)

    def start_moves(
        self,
        moves: Mapping[int, int],
        pps: speeds.Number | None = None,
        pulse_only: bool = False,
    ) -> dict[int, Motion]:
        """Start moves of several axes in the same cycle.

        Args:
            moves: pulses by number of the axis, as in `Axis.start_move`.
            pps: constant speed of all moves, `None` for moves with ramps.

        Raises:
            GroupRefused: some axes did not start with the others.
            CommandRefused, OutOfRange: an axis rejected its move, or an argument is wrong; nothing moves.
        """
        requests = self._requests(moves, pps, pulse_only)
        with self.group(requests) as group:
            pieces = []
            for number, request in requests.items():
                axis = self.axis[number]
                script = (
                    Script().call(READ_FINISH).get(1).extend(axis._strap_script(axis._clock_for(request)))
                )
                pieces.append((number, axis._add_position_read(script).call(request.code, *request.data)))
            begins = [_signed(values[2]) for values in visit(self.link, pieces)]
            motions = {
                number: self.axis[number]._motion_started(request, begin)
                for (number, request), begin in zip(requests.items(), begins, strict=True)
            }
            assert group.started == set(motions)
        return motions

    def move_together(
        self,
        moves: Mapping[int, int],
        pps: speeds.Number | None = None,
        progress: OnProgress | None = None,
        pulse_only: bool = False,
    ) -> dict[int, MotionResult]:
        """Start moves in the same cycle, and wait for all of them. An axis with 0 pulses does not move.

        If the motion of an axis ends early, the other axes are stopped with a ramp.

        Raises:
            LimitReached, AlarmStop, StoppedByCommand: cause of the first early end.
        """
        _table(moves)
        still = {number: pulses for number, pulses in moves.items() if whole(pulses, "pulses") == 0}
        moving = {number: pulses for number, pulses in moves.items() if number not in still}
        numbers_of(self.kind, moves)
        motions = self.start_moves(moving, pps, pulse_only) if moving else {}
        first = self._wait(motions, progress)
        if first is not None:
            first.wait().check(first.requested)
        ends = {number: self.axis[number]._empty_move_result() for number in still}
        for number, motion in motions.items():
            ends[number] = motion.wait()
        return dict(sorted(ends.items()))

    def _requests(
        self, moves: Mapping[int, int], pps: speeds.Number | None, pulse_only: bool
    ) -> dict[int, MotionRequest]:
        """Return the checked requests, sorted by axis."""
        if pulse_only:
            self.kind.need(PULSE_ONLY)
        numbers = numbers_of(self.kind, _table(moves))
        requests = {}
        for number in numbers:
            pulses = whole(moves[number], f"axis {number}: pulses")
            try:
                requests[number] = self.axis[number]._move_request(pulses, pps, pulse_only)
            except OutOfRange as error:
                raise OutOfRange(f"axis {number}: {error}") from None
        return requests

    def _wait(self, motions: Mapping[int, Motion], progress: OnProgress | None) -> Motion | None:
        """Wait until all motions have ended; return the first one that ended early, if any.

        If a motion ends early, the other motions are stopped.
        """
        pause = PROGRESS_POLL if progress else SAFETY_POLL
        first: Motion | None = None
        while running := {number: motion for number, motion in motions.items() if not motion.over}:
            self.link.wait_event(pause)
            seen = visit(self.link, [(number, Script().read(STATUS)) for number in running])
            for motion, (status,) in zip(running.values(), seen, strict=True):
                motion._on_status(status[0])
            running = {number: motion for number, motion in running.items() if not motion.over}
            if first is None:
                first = next(
                    (
                        one
                        for one in motions.values()
                        if one.over and not (one.result and one.result.complete)
                    ),
                    None,
                )
                for number in running if first is not None else ():
                    self.axis[number]._request_stop()
            if progress and running:
                now = running[max(running)].poll()
                if now is not None:
                    progress(now)
        return first

    # ------------------------------------------------------------------ all axes

    def stop_all(self, wait: bool = True) -> dict[int, MotionResult]:
        """Stop every motion immediately, in the same cycle (STOP, BANK-GRP-04).

        Steps may be lost at high speed. The call is not an error if no axis moves. The result contains the
        results of all axes that moved, by number, including motions that another program started. Without
        `wait`, the result is empty.
        """
        visit(self.link, [(1, Script().write(STOP, 0))])
        ends: dict[int, MotionResult] = {}
        ours: dict[int, Motion] = {}
        if not wait:
            return ends
        for axis in self.axes:
            if axis.motion is not None and not axis.motion.over:
                self.link.execute(Script().write(SELECT, axis.number - 1).wait(STATUS, axis._busy_mask, 0))
                axis.motion._on_status(0)
                ours[axis.number] = axis.motion
        for number in self.pending():
            ends[number] = self.axis[number]._foreign_result()
        ends |= {number: motion.wait() for number, motion in ours.items()}
        return dict(sorted(ends.items()))

    def reset(self) -> None:
        """Reset the part in any state.

        The pulses end immediately. After the reset no axis is initialised, and all positions are 0.
        """
        self.link.execute(Script().reset())
        self._group = None
        for axis in self.axes:
            axis._on_reset()

    # ------------------------------------------------------------------ for axes and groups

    def _set_group(self, group: Group | None) -> None:
        """Store the open group, `None` for no group."""
        if group is not None and self._group is not None:
            raise OutOfRange(
                f"a group is open already, of axes {_listed(self._group.numbers)}: close it first"
            )
        self._group = group

    def _is_in_group(self, number: int) -> bool:
        """Return True if a group is open and contains this axis."""
        return self._group is not None and number in self._group.numbers

    def _axis_started(self, number: int) -> None:
        """Store that this axis has accepted a motion."""
        if self._group is not None and number in self._group.numbers:
            self._group.started.add(number)

    def _resolve_others(self, number: int) -> None:
        """After the status of this axis was read, read the pending finish statuses of other axes.

        Otherwise, int_n would stay low.
        """
        motions = (axis.motion for axis in self.axes if axis.number != number)
        if not any(motion is not None and not motion.over for motion in motions):
            return
        for other in self.pending():
            if other == number:
                continue
            motion = self.axis[other].motion
            if motion is not None and not motion.over:
                motion._on_status(0)  # an interrupt is pending, so the axis is stopped
            else:
                self._read_finish(other)

    def _read_finish(self, number: int) -> None:
        try:
            visit(self.link, [(number, Script().call(READ_FINISH).get(1))])
        except CommandRefused:
            pass  # the axis moves again


def _table(moves: Any) -> Mapping[int, int]:
    if not isinstance(moves, Mapping):
        raise OutOfRange(f"moves {moves!r}: expected pulses by axis, as in {{1: 1000, 2: -500}}")
    return moves


def _signed(raw: bytes) -> int:
    """Return a position from its bytes, which are a signed number."""
    return int.from_bytes(raw, "little", signed=True)


def _listed(numbers: Iterable[int]) -> str:
    return ", ".join(map(str, numbers))
