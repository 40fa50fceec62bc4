"""Time in a model: crystal cycles, quanta, edges of `clk`, and the latencies of a core.

A core may choose its latencies within the bounds of the rules.

Rules: P104-GEN-02..04 (CYC, quantum), P104-BCK-03 (tick n of the quantum counter), P104-DS,
P2104-DS and STMC-DS (`ds_*`).
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

BuildClk = Callable[[int, int, int], int]


@dataclass(frozen=True)
class Latency:
    """Constants of one core, in cycles. The defaults are those of the RTL of this project.

    Attributes:
        c_event: from the write event to the C-event, at which the core consumes the byte, if the mailbox is
            open (P104-HSK-03, 0..8).
        window_open: from the end of a closed window to the C-event of a byte that waited.
        host_pins: from an internal change to the pins int_n, aux_n, auxo (0..2).
        int_pin: from a change of an interrupt latch to int_n, on parts with several latches (P2104-INT-03,
        -05, 0..2).
        motor_pins: from an internal change to the pins s, pout_n, hold, dir (0..2).
        start_extra: from the start edge to the internal pulse 1, in addition to W (P104-TIM-02, 0..2).
        end_extra: from the rising edge of pout_n to the falling edge of BUSY (P104-END-01, 0..4).
        imm_end: from the deciding edge to the falling edge of BUSY if pout_n is high (P104-END-02, 0..4).
        input_sync: from the edge that samples a pin to the internal level (2).
        flag_lead: shortest time from a forced-deceleration flag to a pulse event that the flag affects
            (P104-FDC-06, 0..4).
        queue_next: from the falling edge of OBF to the next byte of a longer answer (P104-HSK-05, 0..4).
        reset_tick: origin of the quantum counter relative to the first edge with rst_n = 1.
        build_base, build_per_rate: a ramp-table build takes base + per_rate * (RL - RH) cycles (P104-HSK-04,
            <= 40000). For RL = RH, which requires no table, it takes 3 cycles.
        build_clk: function of (RL, RH, PA) that replaces build_base and build_per_rate.
        build_queue: addition to the duration of a build on parts whose two axes share the builder.
        ds_host: addition to times measured from a write event (P104-DS, -0/+16).
        ds_waited: addition to times measured from the end of a wait (P104-DS, -0/+16).
        ds_motor: addition to times measured from a pulse, a deciding edge or an input level (P104-DS,
            -0/+16).
        ds_window: addition to the windows of P2104-DS-01..14, which count from the C-event.
        ds12_lag: from a pulse event to the edge that compares the length of the new interval with the limit
            of P104-DS-12.
        lookup_start, lookup_per_rate: if the next interval is slower than the running one, the core searches
            for its rate, one rate after the other. The search takes lookup_start, plus lookup_per_rate for
            each rate that it passes. With P104-DS-12, the mailbox opens when the search has passed the limit
            of that rule.
        lookup_first: duration of the search for the first slower interval, whose rate is already known.
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
    lookup_start: int = -2
    lookup_first: int = 1
    lookup_per_rate: int = 3

    def build(self, rl: int, rh: int, pa: int) -> int:
        """Return the length of the ramp-table build in cycles."""
        if self.build_clk is not None:
            return self.build_clk(rl, rh, pa)
        if rl == rh:
            return 3
        return self.build_base + self.build_per_rate * (rl - rh)


@dataclass(frozen=True)
class Timebase:
    """Conversion between crystal cycles, quanta (4 crystal cycles) and cycles.

    Args:
        clk_hz: frequency of `clk`, 8e6..200e6.
        xtal_hz: emulated crystal, 1e6..xtal_max.

    Raises:
        ValueError: a frequency is out of range.
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
        """Return CYC(n): the cycles that cover n crystal cycles, rounded up (P104-GEN-03)."""
        return -(-cycles * self.clk_hz // self.xtal_hz)

    def nearest(self, cycles: int) -> int:
        """Return the number of cycles nearest to n crystal cycles; a half is rounded up.

        The times X and H of P104-INT-03 are such numbers.
        """
        return (2 * cycles * self.clk_hz + self.xtal_hz) // (2 * self.xtal_hz)

    @property
    def w(self) -> int:
        """W = CYC(80): pulse width, and direction set-up time; 5 us at a 16 MHz crystal."""
        return self.cyc(80)

    @property
    def quantum(self) -> int:
        """Crystal cycles of a quantum.

        The number is 4, except that it is 5 if 4 crystal cycles would be shorter than 2 cycles of `clk` (8
        MHz and a fast crystal).
        """
        return 4 if 2 * self.clk_hz >= self.xtal_hz else 5

    def tick(self, n: int) -> int:
        """Return the number of cycles from the restart of the quantum counter to its tick n (P104-BCK-03)."""
        return self.cyc(self.quantum * n)

    def ticks_in(self, clk: int) -> int:
        """Return the number of the last tick that occurs at most `clk` cycles after the restart.

        The result is 0 if clk < 0.
        """
        return max(0, clk * self.xtal_hz // (self.quantum * self.clk_hz))

    def seconds(self, clk: int) -> float:
        """Return the duration of `clk` cycles in s."""
        return clk / self.clk_hz


class QuantumCounter:
    """Quantum counter of a part. It can be restarted at an edge, but it never stops (P104-BCK-03)."""

    def __init__(self, timebase: Timebase, origin: int) -> None:
        self._timebase = timebase
        self.origin = origin

    def restart(self, t: int) -> None:
        """Restart the counter: tick 0 is at edge t."""
        self.origin = t

    def edge_of(self, n: int) -> int:
        """Return the edge of tick n."""
        return self.origin + self._timebase.tick(n)

    def last_tick(self, t: int) -> int:
        """Return the number of the last tick at or before edge t."""
        return self._timebase.ticks_in(t - self.origin)


# Event queue of the models: callbacks are ordered by edge of `clk`, then by phase within the edge. A phase is
# a small integer; each part has a list of its phases. The order of the phases defines which callbacks read
# the state of another block before it changes. Callbacks of the same edge and phase run in the order in which
# they were scheduled.

Callback = Callable[[int], None]


class Event:
    """Handle of a scheduled callback. `cancel()` may be called at any time."""

    __slots__ = ("action",)

    def __init__(self, action: Callback) -> None:
        self.action: Callback | None = action

    def cancel(self) -> None:
        """Cancel the callback."""
        self.action = None


class Scheduler:
    """Heap of events.

    `now` is the last edge that was simulated completely; it is -1 before the first edge.
    """

    def __init__(self) -> None:
        self.now = -1
        self._heap: list[tuple[int, int, int, Event]] = []
        self._serial = 0

    def at(self, t: int, phase: int, action: Callback, kind: type[Event] = Event) -> Event:
        """Call `action(t)` at edge t in this phase.

        Raises ValueError for an edge that was already simulated.
        """
        if t <= self.now:
            raise ValueError(f"event for edge {t}, but edge {self.now} is done")
        event = kind(action)
        self._serial += 1
        heapq.heappush(self._heap, (t, phase, self._serial, event))
        return event

    def clear(self) -> None:
        """Cancel all events (reset)."""
        for *_, event in self._heap:
            event.cancel()
        self._heap.clear()

    def cancel(self, kind: type[Event]) -> None:
        """Cancel all events of a kind."""
        for *_, event in self._heap:
            if isinstance(event, kind):
                event.cancel()

    def next_edge(self) -> int | None:
        """Return the edge of the next event, `None` if there is no event."""
        while self._heap and self._heap[0][3].action is None:
            heapq.heappop(self._heap)
        return self._heap[0][0] if self._heap else None

    def run_edge(self, t: int) -> None:
        """Run every event of edge t, including those that other events of this edge add."""
        while self._heap and self._heap[0][0] == t:
            action = heapq.heappop(self._heap)[3].action
            if action is not None:
                action(t)

    def run_until(self, t: int, after: Callback) -> None:
        """Run every event up to edge t, including events that are added during the run.

        `after` is called after the events of each edge, and may add events to this edge.
        """
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


# Output edges, and the log of output edges that a model writes and a comparison reads.


class Edge(NamedTuple):
    """Change of output `signal` to `value` at rising edge `t` of `clk`.

    The new value is visible just after that edge.

    An asynchronous reset may change outputs between two edges. Such a change has the time of the next edge,
    although the pin changes up to one cycle earlier.
    """

    t: int
    signal: str
    value: int


class EdgeLog:
    """Current levels of all outputs, and the list of their changes in order of time.

    `initial` and `levels` map each output to its first level and to its current level. Each entry of `edges`
    is a change to another level; there is at most one entry per signal and edge of `clk`.
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
                # An asynchronous reset coincides with a change at this edge, so only the final level is
                # recorded.
                del self.edges[place]
                if self.level_before(signal, place) == value:
                    return
                break
        self.edges.append(Edge(t, signal, value))

    def level_before(self, signal: str, place: int) -> int:
        """Return the level of `signal` before entry `place` of the list."""
        for edge in reversed(self.edges[:place]):
            if edge.signal == signal:
                return edge.value
        return self.initial[signal]

    def of(self, signal: str, since: int = 0) -> list[tuple[int, int]]:
        """Return the changes (t, value) of one signal from edge `since` on."""
        return [(e.t, e.value) for e in self.edges if e.signal == signal and e.t >= since]

    def falls(self, signal: str, since: int = 0) -> list[int]:
        """Return the falling edges of a one-bit signal."""
        return [t for t, value in self.of(signal, since) if value == 0]

    def rises(self, signal: str, since: int = 0) -> list[int]:
        """Return the rising edges of a one-bit signal."""
        return [t for t, value in self.of(signal, since) if value == 1]


def low_times(changes: list[tuple[int, int]]) -> list[int]:
    """Return the lengths of the complete low phases of a signal, in cycles.

    Args:
        changes: list of (t, value).
    """
    pairs = zip(changes, changes[1:], strict=False)
    return [b - a for (a, low), (b, high) in pairs if low == 0 and high == 1]
