"""Driver of a bank behind a UART bridge: many axes, each a PPMC-104."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from .. import speeds
from ..axis import OnProgress
from ..check import whole
from ..ending import End
from ..errors import CommandRefused, OutOfRange
from ..kind import PULSE_ONLY
from ..link import Link
from ..motion import PROGRESS_POLL, READ_FINISH, SAFETY_POLL, Motion, Order
from ..part import Part
from ..registers import Inputs, Status
from ..script import Script
from .axis import BankAxis
from .group import Group, numbers_of, write_mask
from .window import read_info, visit
from .words import (
    KIND,
    PENDING,
    POSITION,
    POSITION_BYTES,
    SELECT,
    STATUS,
    STOP,
    BankKind,
    BankStatus,
    Info,
    Look,
    members,
)


class Axes(dict[int, BankAxis]):
    """Axes by number."""

    def __init__(self, kind: BankKind, axes: Iterable[BankAxis]) -> None:
        super().__init__({axis.number: axis for axis in axes})
        self._kind = kind

    def __missing__(self, number: object) -> BankAxis:
        return self[self._kind.check_axis(whole(number, "axis"))]


class PpmcBank(Part):
    """`axis[1]` to `axis[N]` are the axes, axis 0 to N − 1 of the window. A context manager, see `part.Part`.

    Opening it reads INFO (WrongDevice), takes the ends of motions that others left unread, and empties MASK;
    motions that run go on. The way through the bridge is shared: one call at a time, for all axes.
    """

    kind: BankKind = KIND
    axis: Mapping[int, BankAxis]

    def __init__(self, link: Link) -> None:
        self.link = link
        self._info = read_info(link)
        self.kind = replace(KIND, axes=self._info.axes)
        self.axis = Axes(self.kind, (BankAxis(self, number) for number in range(1, self._info.axes + 1)))
        self._group: Group | None = None
        visit(link, write_mask(self.kind, ()))
        for number in self.pending():
            self._take_end(number)

    @property
    def axes(self) -> tuple[BankAxis, ...]:
        return tuple(self.axis.values())

    def info(self) -> Info:
        """Version of the window and number of axes, as read at the opening."""
        return self._info

    def _all(self, script: Script) -> list[tuple[bytes, ...]]:
        return visit(self.link, [(number, script) for number in self.axis])

    # ------------------------------------------------------------------ looking

    def positions(self) -> dict[int, int]:
        """Where all axes are, by number; allowed at any time."""
        seen = self._all(Script().read_number(POSITION, POSITION_BYTES))
        return {axis.number: axis.counted(_signed(one)) for axis, (one,) in zip(self.axes, seen, strict=True)}

    def position(self, axis: int) -> int:
        """Where one axis is; allowed at any time."""
        return self.axis[axis].position

    def status(self) -> BankStatus:
        """Status registers of all axes; allowed at any time."""
        return BankStatus.parse(b"".join(one for (one,) in self._all(Script().read(STATUS))))

    def look(self, axes: Iterable[int] | None = None) -> dict[int, Look]:
        """Status, position and switches of these axes or all, by number; allowed at any time."""
        numbers = tuple(self.axis) if axes is None else numbers_of(self.kind, axes)
        script = Script().read(STATUS).read_number(POSITION, POSITION_BYTES).pins()
        seen = visit(self.link, [(number, script) for number in numbers])
        return {
            number: Look(
                Status.parse(raw[0]), self.axis[number].counted(_signed(at)), Inputs.of_pins(pins[0])
            )
            for number, (raw, at, pins) in zip(numbers, seen, strict=True)
        }

    def pending(self) -> tuple[int, ...]:
        """Numbers of the axes whose interrupt is pending (BANK-WIN-08): their motion has ended,
        and nobody has read its end. Allowed at any time."""
        count = (self._info.axes + 7) // 8
        seen = visit(self.link, [(k + 1, Script().read(PENDING)) for k in range(count)])
        return members(b"".join(one for (one,) in seen))

    # ------------------------------------------------------------------ groups

    def group(self, axes: Iterable[int]) -> Group:
        """For `with bank.group((1, 2, 5)):`, see `Group`: what is started inside begins on the same clk."""
        if self._group is not None:
            raise OutOfRange(
                f"a group is open already, of axes {_listed(self._group.numbers)}: close it first"
            )
        return Group(self, axes)

    def start_together(
        self,
        moves: Mapping[int, int],
        pps: speeds.Number | None = None,
        pulse_only: bool = False,
    ) -> dict[int, Motion]:
        """Begin moves on the same clk. moves: pulses by number of the axis, as in `Axis.start_move`. pps: all
        at this constant speed. Raises GroupRefused for axes that did not begin with the others. If an axis
        refuses its move, or an argument is wrong, nothing moves.
        """
        orders = self._orders(moves, pps, pulse_only)
        with self.group(orders) as group:
            pieces = []
            for number, order in orders.items():
                axis = self.axis[number]
                script = Script().call(READ_FINISH).get(1).extend(axis.straps(axis.clock_of(order)))
                pieces.append((number, axis.where(script).call(order.code, *order.data)))
            begins = [_signed(values[2]) for values in visit(self.link, pieces)]
            motions = {
                number: self.axis[number].started(order, begin)
                for (number, order), begin in zip(orders.items(), begins, strict=True)
            }
            assert group.started == set(motions)
        return motions

    def together(
        self,
        moves: Mapping[int, int],
        pps: speeds.Number | None = None,
        progress: OnProgress | None = None,
        pulse_only: bool = False,
    ) -> dict[int, End]:
        """`start_together`, and wait for all; axes with 0 pulses stand. When one axis ends early, the others
        are stopped with a ramp. Raises LimitReached, AlarmStop, StoppedEarly for the one that ended first.
        """
        _table(moves)
        still = {number: pulses for number, pulses in moves.items() if whole(pulses, "pulses") == 0}
        moving = {number: pulses for number, pulses in moves.items() if number not in still}
        numbers_of(self.kind, moves)
        motions = self.start_together(moving, pps, pulse_only) if moving else {}
        first = self._wait(motions, progress)
        if first is not None:
            first.wait().check(first.asked)
        ends = {number: self.axis[number].nothing_to_move() for number in still}
        for number, motion in motions.items():
            ends[number] = motion.wait()
        return dict(sorted(ends.items()))

    def _orders(
        self, moves: Mapping[int, int], pps: speeds.Number | None, pulse_only: bool
    ) -> dict[int, Order]:
        """In order of the axes, all checked."""
        if pulse_only:
            self.kind.need(PULSE_ONLY)
        numbers = numbers_of(self.kind, _table(moves))
        orders = {}
        for number in numbers:
            pulses = whole(moves[number], f"axis {number}: pulses")
            try:
                orders[number] = self.axis[number].move_order(pulses, pps, pulse_only)
            except OutOfRange as error:
                raise OutOfRange(f"axis {number}: {error}") from None
        return orders

    def _wait(self, motions: Mapping[int, Motion], progress: OnProgress | None) -> Motion | None:
        """Until all have ended. The early end of one stops the others; returns that one."""
        pause = PROGRESS_POLL if progress else SAFETY_POLL
        first: Motion | None = None
        while running := {number: motion for number, motion in motions.items() if not motion.over}:
            self.link.wait_event(pause)
            seen = visit(self.link, [(number, Script().read(STATUS)) for number in running])
            for motion, (status,) in zip(running.values(), seen, strict=True):
                motion.look(status[0])
            running = {number: motion for number, motion in running.items() if not motion.over}
            if first is None:
                first = next(
                    (one for one in motions.values() if one.over and not (one.end and one.end.complete)), None
                )
                for number in running if first is not None else ():
                    self.axis[number].brake()
            if progress and running:
                now = running[max(running)].poll()
                if now is not None:
                    progress(now)
        return first

    # ------------------------------------------------------------------ all axes

    def stop_all(self, wait: bool = True) -> dict[int, End]:
        """STOP: every motion ends at once, on the same clk (BANK-GRP-04); steps may be lost at high speed.
        Returns the ends of those that moved, by number, also if another program started them; none without
        wait. That nothing moves is fine."""
        visit(self.link, [(1, Script().write(STOP, 0))])
        ends: dict[int, End] = {}
        ours: dict[int, Motion] = {}
        if not wait:
            return ends
        for axis in self.axes:
            if axis.motion is not None and not axis.motion.over:
                self.link.execute(Script().write(SELECT, axis.number - 1).wait(STATUS, axis.busy, 0))
                axis.motion.look(0)
                ours[axis.number] = axis.motion
        for number in self.pending():
            ends[number] = self.axis[number].foreign_end()
        ends |= {number: motion.wait() for number, motion in ours.items()}
        return dict(sorted(ends.items()))

    def reset(self) -> None:
        """Reset of the part, in any state: pulses end at once, nothing initialised, positions 0."""
        self.link.execute(Script().reset())
        self._group = None
        for axis in self.axes:
            axis.forget()

    # ------------------------------------------------------------------ for axes and groups

    def open_group(self, group: Group | None) -> None:
        """The group that is open now."""
        if group is not None and self._group is not None:
            raise OutOfRange(
                f"a group is open already, of axes {_listed(self._group.numbers)}: close it first"
            )
        self._group = group

    def holds(self, number: int) -> bool:
        """The open group holds what this axis starts."""
        return self._group is not None and number in self._group.numbers

    def started(self, number: int) -> None:
        """This axis has taken an order."""
        if self._group is not None and number in self._group.numbers:
            self._group.started.add(number)

    def settle(self, number: int) -> None:
        """This axis was looked at: take the ends of others, too, because int_n stays low until then."""
        motions = (axis.motion for axis in self.axes if axis.number != number)
        if not any(motion is not None and not motion.over for motion in motions):
            return
        for other in self.pending():
            if other == number:
                continue
            motion = self.axis[other].motion
            if motion is not None and not motion.over:
                motion.look(0)  # an interrupt is pending, so it rests
            else:
                self._take_end(other)

    def _take_end(self, number: int) -> None:
        try:
            visit(self.link, [(number, Script().call(READ_FINISH).get(1))])
        except CommandRefused:
            pass  # it moves again


def _table(moves: Any) -> Mapping[int, int]:
    if not isinstance(moves, Mapping):
        raise OutOfRange(f"moves {moves!r}: wants pulses by axis, as in {{1: 1000, 2: -500}}")
    return moves


def _signed(raw: bytes) -> int:
    """A position as it was read."""
    return int.from_bytes(raw, "little", signed=True)


def _listed(numbers: Iterable[int]) -> str:
    return ", ".join(map(str, numbers))
