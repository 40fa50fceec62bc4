"""Output edges: the record, and the log that a model writes and a comparison reads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple


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
