"""Commands of an axis of the bank, and the builder of ramp tables, which all axes share.

The commands are those of the PPMC-104, except for commands and options that concern auxiliary pins or the
external clock (BANK-GEN-03). Rules of the builder: BANK-HSK-05, BANK-INI-01, -02. The bank processes its axes
in turn; a visit is an edge of `clk` at which it processes an axis.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import ClassVar

from .. import ppmc104
from ..chip import Context, Phase
from ..clock import Event
from ..motion.excitation import Chopper, Excitation
from ..ppmc104 import ChopperTimes
from ..single.codes import Command, Error, Kind, decode
from ..single.hostport import BytePort
from .chopper import BUILD_LEAD, BYTE_LEAD, READY_LEAD, VisitSchedule
from .motion import Motion

# Input buffer and output queue of one axis of the bank (BANK-HSK-01..04).

AcceptByte = Callable[[int, int, bool], None]
RetryEdge = Callable[[int, bool], int | None]


class Mailbox:
    """The input buffer and the output queue of an axis.

    Args:
        take: take(t, byte, is_command) passes an accepted byte to the command unit.
        retry_edge: retry_edge(t, is_command) returns `None` if visit t may accept the byte, else the edge of
            the next attempt.

    Attributes:
        data_register: next byte that a data read returns.
    """

    def __init__(
        self, context: Context, visits: VisitSchedule, take: AcceptByte, retry_edge: RetryEdge
    ) -> None:
        self._queue, self._visits = context.queue, visits
        self._take, self._retry_edge = take, retry_edge
        self._written: list[tuple[int, int, bool]] = []
        self._planned: Event | None = None
        self._next = -1
        self._closed_until = -1
        self.obf = False
        self.data_register = 0
        self._next_bytes: list[int] = []
        self._being_read = False

    # ------------------------------------------------------------------ in

    @property
    def ibf(self) -> bool:
        """True if the input buffer is full."""
        return bool(self._written)

    def store(self, t: int, byte: int, command: bool) -> None:
        """Process a write event at edge t.

        The write replaces a byte that still waits. However, a visit at which the write is not effective yet
        may accept the old byte.
        """
        self._written.append((t, byte, command))
        if self._planned is None or self._visits.first(t + BYTE_LEAD) < self._next:
            self._plan(t + BYTE_LEAD)

    def close_until(self, t: int) -> None:
        """Accept no byte at a visit before edge t."""
        self._closed_until = t

    def retry(self, t: int) -> None:
        """Check the waiting byte again at the next visit; a condition for its acceptance has changed."""
        if self._planned:
            self._plan(t + 1)

    def _plan(self, edge: int) -> None:
        """Schedule the first visit at or after an edge; this visit checks the waiting byte."""
        if self._planned:
            self._planned.cancel()
        self._next = self._visits.first(edge)
        self._planned = self._queue.at(self._next, Phase.COMMAND, self._visit)

    def _visit(self, t: int) -> None:
        self._planned = None
        visible = [entry for entry in self._written if entry[0] + BYTE_LEAD <= t]
        later = t + 1
        if visible:
            _, byte, command = visible[-1]
            self._written = self._written[len(visible) - 1 :]
            retry_at = self._closed_until if t < self._closed_until else self._retry_edge(t, command)
            if retry_at is None:
                del self._written[0]
                self._take(t, byte, command)
            else:
                # The waiting byte may be replaced by another byte, which may be accepted earlier.
                later = min([retry_at, *(written + BYTE_LEAD for written, _, _ in self._written[1:])])
        if self._written:
            self._plan(later)

    # ------------------------------------------------------------------ out

    def answer(self, values: Iterable[int]) -> None:
        """Load the bytes of a read command; earlier bytes are discarded (P104-HSK-08)."""
        self.data_register, *self._next_bytes = values
        self.obf, self._being_read = True, False

    def snapshot(self) -> None:
        """Begin a data read: store whether `data_register` holds a byte to be read (OBF)."""
        self._being_read = self.obf

    def read_ended(self) -> None:
        """End a data read: load the next byte, or clear OBF if there is none (BANK-HSK-04)."""
        if not self._being_read:
            return
        self._being_read = False
        if self._next_bytes:
            self.data_register = self._next_bytes.pop(0)
        else:
            self.obf = False


_UNSUPPORTED = (Kind.AUX_ON, Kind.AUX_OFF, Kind.AUX_OUTPUT)
_READ_AUXILIARY = 0x85
_EXTERNAL = 0x10


class Builder:
    """Builder of ramp tables.

    Attributes:
        free_from: first edge at which the builder accepts a new table.
    """

    def __init__(self) -> None:
        self.free_from = 0


class CommandUnit(ppmc104.CommandUnit):
    """Commands of the axis with the number `axis`.

    Attributes:
        completed: visit that completed the last initialisation; -1 before the first.
        initialised: True if an initialisation is complete and active.
    """

    allowed_while_busy: ClassVar[tuple[Kind, ...]] = (Kind.STOP, Kind.SLOW_STOP)

    def __init__(
        self,
        context: Context,
        port: BytePort,
        motion: Motion,
        excitation: Excitation,
        chopper: Chopper,
        chopper_times: ChopperTimes,
        visits: VisitSchedule,
        builder: Builder,
        axis: int,
    ) -> None:
        super().__init__(context, port, motion, excitation, chopper, chopper_times)
        self._visits, self._builder, self._axis = visits, builder, axis
        self.completed = -1
        self.initialised = self._before = False

    def _decode(self, byte: int) -> Command:
        command = decode(byte)
        external = command.kind is Kind.INITIALISE and byte & _EXTERNAL
        if external or byte == _READ_AUXILIARY or command.kind in _UNSUPPORTED:
            return Command(Kind.UNDEFINED, byte)
        return command

    def _pin(self, name: str) -> int:
        return super()._pin(name) >> self._axis & 1

    def was_initialised(self, t: int) -> bool:
        """Return True if an initialisation was complete before visit t (BANK-GRP-02)."""
        return self._before if t == self.completed else self.initialised

    def reject(self, error: Error) -> None:
        """Store `error` because a GO was written while no motion of this axis was waiting (BANK-GRP-02)."""
        self._pending, self._data = None, []
        self.error = error

    def _excitation_off(self, t: int) -> None:
        super()._excitation_off(t)
        self.initialised = False

    def builder_free_from(self, command: bool) -> int:
        """Return the first edge at which the builder permits the next byte.

        The result is 0 if the next byte of `command` does not start a build.
        """
        last = self._pending is not None and self._pending.kind is Kind.INITIALISE and self.expected == 1
        return self._builder.free_from if last and not command else 0

    def _complete_after(self, done: int) -> None:
        self._builder.free_from = done + BUILD_LEAD
        visit = self._visits.first(done + READY_LEAD)
        self._port.close_until(visit)
        self._context.queue.at(visit, Phase.CHOPPER, self._complete)

    def _complete(self, t: int) -> None:
        self.completed, self._before, self.initialised = t, self.initialised, True
        self._context.counter.restart(t)
        super()._complete(t)
