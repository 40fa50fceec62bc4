"""Records shared by bench and comparator: pin changes in, edges out. Plain data, no simulator."""

from __future__ import annotations

import hashlib
import json
from bisect import bisect_right
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple


class Change(NamedTuple):
    """Input pin `pin` has level `value` from clk edge `t` on (edge t is the first that samples it)."""

    t: int
    pin: str
    value: int


class Edge(NamedTuple):
    """Output `signal` has level `value` from clk edge `t` on (visible just after that edge)."""

    t: int
    signal: str
    value: int


class Access(NamedTuple):
    """One host access; `t` is edge 0 of P104-BUS-05/06: first edge with RS true, or with WS false again.

    kind: "read" or "write", or on a bus with more registers than two what the report shall show.
    """

    t: int
    kind: str
    reg: int
    byte: int

    def __str__(self) -> str:
        if self.kind not in ("read", "write"):
            name = self.kind
        elif self.kind == "write":
            name = "command" if self.reg else "data   "
        else:
            name = "status " if self.reg else "read   "
        return f"{self.t:>9} {name} {self.byte:02X}"


@dataclass
class Recording:
    """All that a run leaves: enough to replay it into a model and to compare."""

    part: str
    params: dict[str, object]
    seed: int = 0
    end: int = 0
    stimulus: list[Change] = field(default_factory=list)
    edges: list[Edge] = field(default_factory=list)
    accesses: list[Access] = field(default_factory=list)

    def to_json(self) -> str:
        """One JSON document; lists of lists, so that it stays short."""
        return json.dumps({**self.__dict__, "version": 1})

    def digest(self) -> str:
        """The same for recordings that do not differ in anything."""
        return hashlib.sha256(self.to_json().encode()).hexdigest()

    @classmethod
    def from_json(cls, text: str) -> Recording:
        """Inverse of `to_json`."""
        data = json.loads(text)
        data.pop("version")
        data["stimulus"] = [Change(*row) for row in data["stimulus"]]
        data["edges"] = [Edge(*row) for row in data["edges"]]
        data["accesses"] = [Access(*row) for row in data["accesses"]]
        return cls(**data)


def by_signal(edges: Iterable[Edge], initial: Mapping[str, int]) -> dict[str, list[tuple[int, int]]]:
    """Per signal of `initial` the real changes (t, value): same-edge doubles merged, repeats dropped."""
    lists: dict[str, list[tuple[int, int]]] = {name: [] for name in initial}
    for t, signal, value in edges:
        changes = lists[signal]
        if changes and changes[-1][0] == t:
            changes[-1] = (t, value)
        else:
            changes.append((t, value))
    for name, changes in lists.items():
        level = initial[name]
        kept = []
        for t, value in changes:
            if value != level:
                kept.append((t, value))
                level = value
        lists[name] = kept
    return lists


def level_at(changes: list[tuple[int, int]], t: int, initial: int) -> int:
    """Level at t, changes at t included, by bisection: recordings have a hundred thousand of them."""
    place = bisect_right(changes, t, key=lambda change: change[0])
    return changes[place - 1][1] if place else initial


def bit_changes(changes: list[tuple[int, int]], place: int, initial: int) -> list[tuple[int, int]]:
    """Changes (edge, level) of one bit of a port."""
    level, rows = initial >> place & 1, []
    for t, value in changes:
        if value >> place & 1 != level:
            level ^= 1
            rows.append((t, level))
    return rows


def steps(changes: list[tuple[int, int]]) -> list[int]:
    """Edges on which phases (positive logic) go on to another pattern; a chopper's off-times do not count."""
    found, last = [], 0
    for t, pattern in changes:
        if pattern and last and pattern != last:
            found.append(t)
        last = pattern or last
    return found
