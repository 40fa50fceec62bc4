"""Registered instructions of the PPMC-312: command FIFO, event buffers (P312-OVR-01..05, P312-EVT-01..04)."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

from ...chip import Context
from ..codes import Alarm, Code, Source, State, Trigger
from ..front.responses import Responses
from ..front.station import HostSide
from ..motion.inputs import InputChange, Outputs
from ..motion.operation import Operation
from ..motion.position import Counters, Interlock, Watch
from ..pace import Pace
from ..stages import FreeCurve, Table

# What instructions of the PPMC-312 need of the part: its blocks and its state. `ppmc312.core.Core` is it.


class Core(Protocol):
    """table: of the last setting, None in state INI. transfer: a free curve that is being sent. version: of
    the firmware."""

    table: Table | None
    transfer: FreeCurve | None
    context: Context
    pace: Pace
    version: int
    host: HostSide
    responses: Responses
    counters: Counters
    interlock: Interlock
    fifo: Fifo
    events: tuple[EventBuffer, EventBuffer]
    outputs: Outputs
    operation: Operation
    watch: Watch
    input_change: InputChange

    @property
    def state(self) -> State:
        """The operation state of chapter 4."""

    def reset(self, t: int, source: Source, /) -> None:
        """The part's software reset, which answers."""

    def forget_table(self) -> None:
        """State INI: no table, no registered instructions."""

    def set_table(self, table: Table) -> None:
        """State NOR with a new table."""

    def drop_overrides(self, t: int) -> None:
        """An override has failed."""

    def alarm(self, t: int, status: Alarm) -> None:
        """Multiple occurrence."""

    def clear_alarm(self, t: int) -> None:
        """24."""


FIFO_DEPTH, BUFFER_DEPTH = 8, 4


class Entry(NamedTuple):
    """A registered instruction: block in logical order, trigger, position that triggers it."""

    block: bytes
    trigger: Trigger
    position: int = 0


@dataclass
class Triggered:
    """An entry of the FIFO that its trigger has released at edge t."""

    entry: Entry
    t: int

    @property
    def stops_at_position(self) -> bool:
        """Position-triggered 80, which stops the pulses before it is processed (P312-OVR-12)."""
        return self.entry.trigger is Trigger.POSITION and self.entry.block[2] == Code.STOP


class Fifo:
    """Command buffers. waiting: armed head first. triggered: released, not processed. armed: release to the
    arming of the next head, in clk."""

    def __init__(self, armed: int) -> None:
        self._armed = armed
        self.waiting: deque[Entry] = deque()
        self.triggered: deque[Triggered] = deque()
        self._armed_from = 0

    @property
    def full(self) -> bool:
        """Eight entries wait."""
        return len(self.waiting) >= FIFO_DEPTH

    def uses(self, trigger: Trigger) -> bool:
        """Whether an entry waits for this trigger."""
        return any(entry.trigger is trigger for entry in self.waiting)

    def register(self, entry: Entry, armed_from: int) -> None:
        """Add an entry, which no trigger before that edge releases."""
        if not self.waiting:
            self._armed_from = armed_from
        self.waiting.append(entry)

    def _release(self, t: int) -> Triggered:
        released = Triggered(self.waiting.popleft(), t)
        self.triggered.append(released)
        self._armed_from = t + self._armed
        return released

    def clear(self) -> None:
        """Forget everything."""
        self.waiting.clear()
        self.triggered.clear()

    def event(self, t: int, trigger: Trigger) -> bool:
        """Falling edge of an event pin; True if it released the head."""
        if not self.waiting or self.waiting[0].trigger is not trigger or t < self._armed_from:
            return False
        self._release(t)
        return True

    def count(self, t: int, position: int) -> Triggered | None:
        """A count has led to this position; what it released."""
        head = self.waiting[0] if self.waiting else None
        if head is None or head.trigger is not Trigger.POSITION or head.position != position:
            return None
        return self._release(t) if t >= self._armed_from else None


@dataclass
class EventBuffer:
    """One event buffer. next: number of the entry that the next edge executes. edge: time of a remembered
    edge that has not been worked on."""

    entries: list[bytes] = field(default_factory=list)
    next: int = 0
    edge: int | None = None

    @property
    def full(self) -> bool:
        """Four entries."""
        return len(self.entries) >= BUFFER_DEPTH

    def register(self, block: bytes) -> None:
        """Add an entry."""
        self.entries.append(block)
        self.next = 0

    def delete(self) -> None:
        """Remove the last entry, if there is one; the edge that waits for it is dropped."""
        if self.entries:
            self.entries.pop()
            self.next = 0
            self.edge = self.edge if self.entries else None

    def take(self) -> bytes:
        """The next entry, cyclically."""
        block = self.entries[self.next]
        self.next = (self.next + 1) % len(self.entries)
        return block

    def clear(self) -> None:
        """Empty it; a remembered edge is dropped."""
        self.entries.clear()
        self.next, self.edge = 0, None

    def read(self) -> bytes:
        """Parameters of 47 after the code (P312-CMD-47)."""
        codes = bytes(block[2] for block in self.entries).ljust(BUFFER_DEPTH, b"\0")
        return bytes([len(self.entries), self.next]) + codes
