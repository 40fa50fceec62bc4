"""Registered instructions of the PPMC-312: command FIFO, event buffers.

Rules: P312-OVR-01..05, P312-EVT-01..04.
"""

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
from ..motion.position import Counters, Interlock, WindowMonitors
from ..stages import FreeCurve, Table
from ..timing import CoreTiming

# Protocol with the blocks and the state of the part that instructions use. `ppmc312.core.Core` implements it.


class Core(Protocol):
    """Members of the part that instructions use.

    Attributes:
        table: table of the last setting, `None` in state INI.
        transfer: free curve that is being transferred.
        version: version of the firmware.
    """

    table: Table | None
    transfer: FreeCurve | None
    context: Context
    core_timing: CoreTiming
    version: int
    host: HostSide
    responses: Responses
    counters: Counters
    interlock: Interlock
    fifo: Fifo
    events: tuple[EventBuffer, EventBuffer]
    outputs: Outputs
    operation: Operation
    monitors: WindowMonitors
    input_change: InputChange

    @property
    def state(self) -> State:
        """Operation state (docs/ppmc312/README.md, 7 States)."""

    def reset(self, t: int, source: Source, /) -> None:
        """Execute a software reset, which sends a response."""

    def discard_table(self) -> None:
        """Change to state INI, without a table and without registered instructions."""

    def set_table(self, table: Table) -> None:
        """Change to state NOR with a new table."""

    def drop_overrides(self, t: int) -> None:
        """Discard all registered overrides after an override has failed."""

    def alarm(self, t: int, status: Alarm) -> None:
        """Process a multiple occurrence."""

    def clear_alarm(self, t: int) -> None:
        """Execute instruction 24."""


FIFO_DEPTH, BUFFER_DEPTH = 8, 4


class Entry(NamedTuple):
    """Registered instruction: block in logical order, trigger, and the position of a trigger by position."""

    block: bytes
    trigger: Trigger
    position: int = 0


@dataclass
class Triggered:
    """Entry of the FIFO that was released by its trigger at edge t."""

    entry: Entry
    t: int

    @property
    def stops_at_position(self) -> bool:
        """True for an instruction 80 that is triggered by a position (P312-OVR-12).

        The pulses stop at this position, before the instruction is processed.
        """
        return self.entry.trigger is Trigger.POSITION and self.entry.block[2] == Code.STOP


class Fifo:
    """FIFO of registered overrides.

    Attributes:
        waiting: entries that are not released yet. Only the first entry, the head, can be released.
        triggered: released entries that are not processed yet.
        armed: number of cycles from a release to the arming of the next head.
    """

    def __init__(self, armed: int) -> None:
        self._armed = armed
        self.waiting: deque[Entry] = deque()
        self.triggered: deque[Triggered] = deque()
        self._armed_from = 0

    @property
    def full(self) -> bool:
        """True if eight entries wait."""
        return len(self.waiting) >= FIFO_DEPTH

    def uses(self, trigger: Trigger) -> bool:
        """Return True if any entry waits for this trigger."""
        return any(entry.trigger is trigger for entry in self.waiting)

    def register(self, entry: Entry, armed_from: int) -> None:
        """Add an entry. A trigger before edge `armed_from` does not release it."""
        if not self.waiting:
            self._armed_from = armed_from
        self.waiting.append(entry)

    def _release(self, t: int) -> Triggered:
        released = Triggered(self.waiting.popleft(), t)
        self.triggered.append(released)
        self._armed_from = t + self._armed
        return released

    def clear(self) -> None:
        """Discard all entries."""
        self.waiting.clear()
        self.triggered.clear()

    def event(self, t: int, trigger: Trigger) -> bool:
        """Process a falling edge of an event pin; return True if this edge releases the head."""
        if not self.waiting or self.waiting[0].trigger is not trigger or t < self._armed_from:
            return False
        self._release(t)
        return True

    def count(self, t: int, position: int) -> Triggered | None:
        """Process the position after a pulse; return the head if this position releases it."""
        head = self.waiting[0] if self.waiting else None
        if head is None or head.trigger is not Trigger.POSITION or head.position != position:
            return None
        return self._release(t) if t >= self._armed_from else None


@dataclass
class EventBuffer:
    """Event buffer.

    Attributes:
        next: number of the entry that the next event edge executes.
        edge: edge of `clk` of a stored event that is not processed yet.
    """

    entries: list[bytes] = field(default_factory=list)
    next: int = 0
    edge: int | None = None

    @property
    def full(self) -> bool:
        """True if the buffer has four entries."""
        return len(self.entries) >= BUFFER_DEPTH

    def register(self, block: bytes) -> None:
        """Add an entry."""
        self.entries.append(block)
        self.next = 0

    def delete(self) -> None:
        """Remove the last entry, if any. If no entry is left, discard a stored event edge."""
        if self.entries:
            self.entries.pop()
            self.next = 0
            self.edge = self.edge if self.entries else None

    def take(self) -> bytes:
        """Return the next entry; the first entry follows the last one."""
        block = self.entries[self.next]
        self.next = (self.next + 1) % len(self.entries)
        return block

    def clear(self) -> None:
        """Clear the buffer, and discard an event edge that is stored."""
        self.entries.clear()
        self.next, self.edge = 0, None

    def read(self) -> bytes:
        """Return the parameters of the response to instruction 47 (P312-CMD-47)."""
        codes = bytes(block[2] for block in self.entries).ljust(BUFFER_DEPTH, b"\0")
        return bytes([len(self.entries), self.next]) + codes
