"""Time: XTAL cycles, quanta, clk edges, and the constants a core may choose inside the spec's windows.

Rules: P104-GEN-02..04 (CYC, quantum), P104-BCK-03 (tick n of the quantum counter), section 8 (`ds_*`).
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

BuildClk = Callable[[int, int, int], int]


@dataclass(frozen=True)
class Latency:
    """Constants of one core, in clk. The defaults are those of the RTL of this project.

    c_event: write event to C-event when the mailbox is open (P104-HSK-03, 0..8).
    window_open: end of a closed window to the C-event of a byte that waited.
    host_pins: internal change to int_n, aux_n, auxo. int_pin: interrupt latch to int_n on parts with
    several latches (P2104-INT-03, -05, 0..2). motor_pins: to s, pout_n, hold, dir (both 0..2).
    start_extra: internal pulse 1 beyond W (P104-TIM-02, 0..2).
    end_extra: pout_n rise to BUSY fall (P104-END-01, 0..4).
    imm_end: deciding edge to BUSY fall when pout_n is high (P104-END-02, 0..4).
    input_sync: pin edge to the internal level (2).
    flag_lead: a forced-deceleration flag set this long before a pulse event still counts for it
    (P104-FDC-06, 0..4).
    queue_next: OBF fall to the next byte of a longer answer (P104-HSK-05, 0..4).
    reset_tick: origin of the quantum counter relative to the first edge with rst_n = 1.
    build_base, build_per_rate: ramp-table build, base + per_rate * (RL - RH) (P104-HSK-04, <= 40000), 3
    for RL = RH, which needs no table; `build_clk`, a function of (RL, RH, PA), replaces them. build_queue:
    added where two axes share the builder.
    ds_host: added to the times measured from a write event, ds_waited: from the end of a wait, ds_motor:
    from a pulse, a deciding edge or an input level (section 8, -0/+16).
    ds_window: added to the windows of P2104-DS-01..14, which count from the C-event.
    ds12_lag: pulse event to the edge on which its interval decides about P104-DS-12. Where an interval is
    slower than the one before, the core looks its rate up while it runs, seek_start and seek_per_rate clk a
    rate, and the mailbox opens when the look-up has passed the limit. The first one is known: seek_turn.
    """

    c_event: int = 2
    window_open: int = 1
    host_pins: int = 0
    int_pin: int = 1
    motor_pins: int = 1
    start_extra: int = 0
    end_extra: int = 0
    imm_end: int = 1
    input_sync: int = 2
    flag_lead: int = 0
    queue_next: int = 1
    reset_tick: int = 1
    build_base: int = 1954
    build_per_rate: int = 136
    build_clk: BuildClk | None = None
    build_queue: int = 1
    ds_host: int = 3
    ds_waited: int = 1
    ds_motor: int = 1
    ds_window: int = 1
    ds12_lag: int = 1
    seek_start: int = -2
    seek_turn: int = 1
    seek_per_rate: int = 3

    def build(self, rl: int, rh: int, pa: int) -> int:
        """Length of the ramp-table build in clk."""
        if self.build_clk is not None:
            return self.build_clk(rl, rh, pa)
        if rl == rh:
            return 3
        return self.build_base + self.build_per_rate * (rl - rh)


@dataclass(frozen=True)
class Timebase:
    """Conversion between XTAL cycles, quanta (4 XTAL cycles) and clk.

    clk_hz: frequency of clk, 8e6..200e6. xtal_hz: emulated crystal, 1e6..xtal_max. Raises ValueError outside.
    """

    clk_hz: int = 16_000_000
    xtal_hz: int = 16_000_000
    xtal_max: int = 16_000_000

    def __post_init__(self) -> None:
        if not 8_000_000 <= self.clk_hz <= 200_000_000:
            raise ValueError(f"clk_hz {self.clk_hz} is outside 8e6..200e6")
        if not 1_000_000 <= self.xtal_hz <= self.xtal_max:
            raise ValueError(f"xtal_hz {self.xtal_hz} is outside 1e6..{self.xtal_max // 1_000_000}e6")

    def cyc(self, cycles: int) -> int:
        """CYC(n): clk that cover n XTAL cycles, rounded up (P104-GEN-03)."""
        return -(-cycles * self.clk_hz // self.xtal_hz)

    def nearest(self, cycles: int) -> int:
        """clk nearest to n XTAL cycles, halves up (X and H of P104-INT-03)."""
        return (2 * cycles * self.clk_hz + self.xtal_hz) // (2 * self.xtal_hz)

    @property
    def w(self) -> int:
        """W = CYC(80): pulse width and direction set-up, 5 us at a 16 MHz crystal."""
        return self.cyc(80)

    @property
    def quantum(self) -> int:
        """XTAL cycles of a quantum: 4, or 5 where 4 would last less than 2 clk (8 MHz and a fast crystal)."""
        return 4 if 2 * self.clk_hz >= self.xtal_hz else 5

    def tick(self, n: int) -> int:
        """clk from the restart of the quantum counter to its tick n (P104-BCK-03)."""
        return self.cyc(self.quantum * n)

    def ticks_in(self, clk: int) -> int:
        """Number of the last tick at or before `clk` clk after the restart; 0 for clk < 0."""
        return max(0, clk * self.xtal_hz // (self.quantum * self.clk_hz))

    def seconds(self, clk: int) -> float:
        """Seconds of so many clk."""
        return clk / self.clk_hz


class QuantumCounter:
    """The one quantum counter of a part: restarted at an edge, runs on for ever (P104-BCK-03)."""

    def __init__(self, timebase: Timebase, origin: int) -> None:
        self._timebase = timebase
        self.origin = origin

    def restart(self, t: int) -> None:
        """Tick 0 is at edge t."""
        self.origin = t

    def edge_of(self, n: int) -> int:
        """Edge of tick n."""
        return self.origin + self._timebase.tick(n)

    def last_tick(self, t: int) -> int:
        """Number of the last tick at or before edge t."""
        return self._timebase.ticks_in(t - self.origin)


# Event queue of the models: callbacks ordered by clk edge, then by phase within the edge.
#
# A phase is a small integer that says which register of the part looks at which other before both change;
# each part lists its own. Callbacks of one edge and phase run in the order they were asked for.

Callback = Callable[[int], None]


class Event:
    """Handle of a scheduled callback; `cancel()` is allowed at any time."""

    __slots__ = ("action",)

    def __init__(self, action: Callback) -> None:
        self.action: Callback | None = action

    def cancel(self) -> None:
        """Forget the callback."""
        self.action = None


class Scheduler:
    """Heap of events. `now` is the last edge that was worked on completely, -1 before the first."""

    def __init__(self) -> None:
        self.now = -1
        self._heap: list[tuple[int, int, int, Event]] = []
        self._serial = 0

    def at(self, t: int, phase: int, action: Callback, kind: type[Event] = Event) -> Event:
        """Call `action(t)` at edge t in this phase. Raises ValueError for an edge already worked on."""
        if t <= self.now:
            raise ValueError(f"event for edge {t}, but edge {self.now} is done")
        event = kind(action)
        self._serial += 1
        heapq.heappush(self._heap, (t, phase, self._serial, event))
        return event

    def clear(self) -> None:
        """Cancel everything (reset)."""
        for *_, event in self._heap:
            event.cancel()
        self._heap.clear()

    def cancel(self, kind: type[Event]) -> None:
        """Cancel all events of a kind."""
        for *_, event in self._heap:
            if isinstance(event, kind):
                event.cancel()

    def next_edge(self) -> int | None:
        """Edge of the next event, None if there is none."""
        while self._heap and self._heap[0][3].action is None:
            heapq.heappop(self._heap)
        return self._heap[0][0] if self._heap else None

    def run_edge(self, t: int) -> None:
        """Run every event of edge t, also those that other events of this edge add."""
        while self._heap and self._heap[0][0] == t:
            action = heapq.heappop(self._heap)[3].action
            if action is not None:
                action(t)

    def run_until(self, t: int, after: Callback) -> None:
        """Run every event up to edge t, also those that are added meanwhile; `after` follows the events of
        each edge and may add some to it."""
        heap, pop = self._heap, heapq.heappop
        while heap:
            edge, _, _, event = heap[0]
            if edge > t:
                break
            if event.action is None:
                pop(heap)
                continue
            self.now = edge - 1
            while heap and heap[0][0] == edge:
                action = pop(heap)[3].action
                if action is not None:
                    action(edge)
            after(edge)
            while heap and heap[0][0] == edge:
                action = pop(heap)[3].action
                if action is not None:
                    action(edge)
        self.now = t


# Output edges: the record, and the log that a model writes and a comparison reads.


class Edge(NamedTuple):
    """Output `signal` takes `value` at rising clk edge `t` (visible just after that edge).

    Only an asynchronous reset changes outputs between edges; it is stamped with the next edge, so its
    edges may be seen up to one clk earlier on the pins.
    """

    t: int
    signal: str
    value: int


class EdgeLog:
    """Present levels of all outputs and the list of their changes, in time order.

    `initial` and `levels` map each output to its first and its present level; `edges` never holds a
    change to the same level, and at most one entry per signal and clk edge.
    """

    def __init__(self, initial: Mapping[str, int]) -> None:
        self.initial: dict[str, int] = dict(initial)
        self.levels: dict[str, int] = dict(initial)
        self.edges: list[Edge] = []

    def set(self, t: int, signal: str, value: int) -> None:
        """Drive `signal` to `value` at edge t. Raises KeyError for an unknown signal."""
        before = self.levels[signal]
        if before == value:
            return
        self.levels[signal] = value
        for place in range(len(self.edges) - 1, -1, -1):
            edge = self.edges[place]
            if edge.t != t:
                break
            if edge.signal == signal:
                # An asynchronous reset met a change of the same edge: only the outcome counts.
                del self.edges[place]
                if self.level_before(signal, place) == value:
                    return
                break
        self.edges.append(Edge(t, signal, value))

    def level_before(self, signal: str, place: int) -> int:
        """Level of `signal` before entry `place` of the list."""
        for edge in reversed(self.edges[:place]):
            if edge.signal == signal:
                return edge.value
        return self.initial[signal]

    def of(self, signal: str, since: int = 0) -> list[tuple[int, int]]:
        """Changes (t, value) of one signal from edge `since` on."""
        return [(e.t, e.value) for e in self.edges if e.signal == signal and e.t >= since]

    def falls(self, signal: str, since: int = 0) -> list[int]:
        """Edges on which a one-bit signal fell."""
        return [t for t, value in self.of(signal, since) if value == 0]

    def rises(self, signal: str, since: int = 0) -> list[int]:
        """Edges on which a one-bit signal rose."""
        return [t for t, value in self.of(signal, since) if value == 1]


def low_times(changes: list[tuple[int, int]]) -> list[int]:
    """Lengths in clk of the complete low phases in a list of (t, value) of an active-low signal."""
    pairs = zip(changes, changes[1:], strict=False)
    return [b - a for (a, low), (b, high) in pairs if low == 0 and high == 1]
