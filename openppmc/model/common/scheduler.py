"""Event queue of the models: callbacks ordered by clk edge, then by phase within the edge.

A phase is a small integer that says which register of the part looks at which other before both change;
each part lists its own. Callbacks of one edge and phase run in the order they were asked for.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable

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
