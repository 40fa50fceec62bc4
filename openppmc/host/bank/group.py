"""Motions of several axes that start in the same cycle (BANK-GRP-01..03)."""

from __future__ import annotations

from collections.abc import Iterable
from types import TracebackType
from typing import Protocol

from ..axis import STOP_NOW
from ..capabilities import RateCapabilities
from ..check import Checked, whole
from ..errors import AxisBusy, CommandRefused, OutOfRange, PpmcError
from ..link import Link
from ..motion import READ_FINISH
from ..script import Script
from .axis import BankAxis
from .registers import BUSY, ERR, GO, MASK, STATUS, GroupRefused, bit_bytes, go_error
from .window import visit

_GO_READS = 8
"""Number of read accesses between a write of GO and the next change of MASK.

One access takes 10 cycles, and a GO is effective in all axes after at most 64 cycles.
"""


class GroupAccess(Protocol):
    """Members of a bank (`part.PpmcBank`) that a group needs."""

    @property
    def link(self) -> Link: ...
    @property
    def kind(self) -> RateCapabilities: ...
    @property
    def axes(self) -> tuple[BankAxis, ...]: ...
    def _set_group(self, group: Group | None) -> None: ...


def numbers_of(kind: RateCapabilities, axes: Iterable[int]) -> tuple[int, ...]:
    """Return the axis numbers of a group in ascending order.

    Raises:
        OutOfRange: the group is empty, a number occurs twice, or the bank has no such axis.
    """
    if isinstance(axes, str | bytes) or not isinstance(axes, Iterable):
        raise OutOfRange(f"axes {axes!r}: a group needs the numbers of its axes, as in (1, 2, 5)")
    numbers = [kind.check_axis(whole(axis, "axis")) for axis in axes]
    if not numbers:
        raise OutOfRange("a group without axes: name one at least")
    for number in numbers:
        if numbers.count(number) > 1:
            raise OutOfRange(f"axis {number} is in the group twice")
    return tuple(sorted(numbers))


def write_mask(kind: RateCapabilities, numbers: tuple[int, ...]) -> list[tuple[int, Script]]:
    """Return the scripts that write MASK.

    Byte k is written at axis k + 1. This axis exists in every bank that has a MASK byte k.
    """
    raw = bit_bytes(numbers, kind.axes)
    return [(k + 1, Script().write(MASK, byte)) for k, byte in enumerate(raw)]


class Group(Checked):
    """Context manager for motions that start together.

    If a motion is started inside the block, on an axis of the group, the motion waits before its first pulse.

    At the end of the block, all of these motions start in the same cycle. If an exception leaves the block,
    the waiting motions are stopped, and no axis moves. A group is created with the numbers of its axes.

    Raises:
        AxisBusy: an axis moves at the start of the block.
        GroupRefused: an axis did not start at the end of the block. A motion that a switch ended while it was
            waiting does not raise this error; its result holds the cause.
    """

    numbers: tuple[int, ...]
    started: set[int]

    def __init__(self, bank: GroupAccess, axes: Iterable[int]) -> None:
        self._bank = bank
        self.numbers = numbers_of(bank.kind, axes)
        self.started = set()

    def _each(self, numbers: Iterable[int], script: Script) -> list[tuple[bytes, ...]]:
        return visit(self._bank.link, [(number, script) for number in numbers])

    def __enter__(self) -> Group:
        bank = self._bank
        for number, (status,) in zip(
            self.numbers, self._each(self.numbers, Script().read(STATUS)), strict=True
        ):
            if status[0] & BUSY:
                raise AxisBusy(status[0], f"axis {number}: {AxisBusy.text}")
        bank._set_group(self)
        try:
            visit(bank.link, write_mask(bank.kind, self.numbers))
        except BaseException:
            bank._set_group(None)
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if error is not None:
                self._cancel()
            else:
                self._go()
        finally:
            self._bank._set_group(None)

    def _go(self) -> None:
        """Start the waiting motions and check which of them started."""
        bank, began = self._bank, tuple(sorted(self.started))
        if not began:
            visit(bank.link, write_mask(bank.kind, ()))
            return
        go = Script().write(GO, 0).read_many(STATUS, _GO_READS)
        try:
            visit(bank.link, [*write_mask(bank.kind, began), (1, go), *write_mask(bank.kind, ())])
            seen = self._each(began, Script().read(STATUS))
        except BaseException:
            self._cancel()
            raise
        refusals = {}
        for number, (status,) in zip(began, seen, strict=True):
            if status[0] & ERR and not self._ended(number, status[0]):
                refusals[number] = go_error(status[0], number)
        if refusals:
            raise GroupRefused(refusals)

    def _ended(self, number: int, status: int) -> bool:
        """Return True if the motion of this axis ended while it was waiting.

        A switch, a stop or a reset may have ended it.
        """
        motion = self._bank.axes[number - 1].motion
        if motion is None:
            return False
        motion._on_status(status)
        return motion.over and not (motion.result and motion.result.complete)

    def _cancel(self) -> None:
        """Cancel all motions of this group.

        Other motions are not affected, because all axes of the group were at standstill when it was opened.
        """
        link, kind = self._bank.link, self._bank.kind
        try:
            for number in self.numbers:
                try:
                    self._each((number,), Script().call(STOP_NOW).wait(STATUS, BUSY, 0))
                except CommandRefused:
                    continue  # the motor is stopped
                motion = self._bank.axes[number - 1].motion
                if number in self.started and motion is not None:
                    motion._on_status(0)
                else:
                    self._each((number,), Script().call(READ_FINISH).get(1))
            visit(link, write_mask(kind, ()))
        except PpmcError:
            pass  # the caller receives the first error
