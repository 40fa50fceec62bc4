"""Input buffer and output queue of one axis of the bank (BANK-HSK-01..04)."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ..common.blocks import Context, Phase
from ..common.scheduler import Event
from .visits import BYTE_LEAD, Visits

Take = Callable[[int, int, bool], None]
Waits = Callable[[int, bool], int | None]


class Mailbox:
    """take(t, byte, is_command): the command unit. waits(t, is_command): None, or the edge from which on a
    byte that visit t must leave may be looked at again. Readable: obf, shown (the byte in the data register).
    """

    def __init__(self, context: Context, visits: Visits, take: Take, waits: Waits) -> None:
        self._queue, self._visits = context.queue, visits
        self._take, self._waits = take, waits
        self._written: list[tuple[int, int, bool]] = []
        self._planned: Event | None = None
        self._next = -1
        self._closed_until = -1
        self.obf = False
        self.shown = 0
        self._more: list[int] = []
        self._being_read = False

    # ------------------------------------------------------------------ in

    @property
    def ibf(self) -> bool:
        """A byte waits."""
        return bool(self._written)

    def store(self, t: int, byte: int, command: bool) -> None:
        """Write event t. What it replaces may still be taken by a visit that does not see it."""
        self._written.append((t, byte, command))
        if self._planned is None or self._visits.first(t + BYTE_LEAD) < self._next:
            self._plan(t + BYTE_LEAD)

    def close_until(self, t: int) -> None:
        """No visit before edge t takes a byte."""
        self._closed_until = t

    def look_again(self, t: int) -> None:
        """What kept a byte waiting at visit t may be gone at the next one."""
        if self._planned:
            self._plan(t + 1)

    def _plan(self, edge: int) -> None:
        """The first visit from an edge on has something to look at."""
        if self._planned:
            self._planned.cancel()
        self._next = self._visits.first(edge)
        self._planned = self._queue.at(self._next, Phase.COMMAND, self._visit)

    def _visit(self, t: int) -> None:
        self._planned = None
        seen = [entry for entry in self._written if entry[0] + BYTE_LEAD <= t]
        later = t + 1
        if seen:
            _, byte, command = seen[-1]
            self._written = self._written[len(seen) - 1 :]
            again = self._closed_until if t < self._closed_until else self._waits(t, command)
            if again is None:
                del self._written[0]
                self._take(t, byte, command)
            else:
                # One that has replaced it need not wait as long.
                later = min([again, *(written + BYTE_LEAD for written, _, _ in self._written[1:])])
        if self._written:
            self._plan(later)

    # ------------------------------------------------------------------ out

    def answer(self, values: Iterable[int]) -> None:
        """A read command loads its bytes; whatever was there is dropped (P104-HSK-08)."""
        self.shown, *self._more = values
        self.obf, self._being_read = True, False

    def snapshot(self) -> None:
        """A data read shows `shown`."""
        self._being_read = self.obf

    def read_ended(self) -> None:
        """The end of a data read: the next byte, or none (BANK-HSK-04)."""
        if not self._being_read:
            return
        self._being_read = False
        if self._more:
            self.shown = self._more.pop(0)
        else:
            self.obf = False
