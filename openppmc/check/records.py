"""Records that test bench and comparison share: changes of inputs, edges of outputs."""

from __future__ import annotations

import hashlib
import json
from bisect import bisect_right
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple


class Change(NamedTuple):
    """Change of an input: pin `pin` has level `value` from edge `t` of the clock on.

    Edge t is the first edge that samples the level.
    """

    t: int
    pin: str
    value: int


class Edge(NamedTuple):
    """Change of an output: `signal` has level `value` immediately after edge `t` of the clock."""

    t: int
    signal: str
    value: int


class Access(NamedTuple):
    """One access of the host.

    Attributes:
        t: edge 0 of P104-BUS-05/06: for a read, the first edge with RS true; for a write, the first edge at
            which WS is false again.
        kind: "read" or "write"; on a bus with more than two registers, the text that a report contains.
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
    """Data of a run for a replay into a model and for a comparison."""

    part: str
    params: dict[str, object]
    seed: int = 0
    end: int = 0
    stimulus: list[Change] = field(default_factory=list)
    edges: list[Edge] = field(default_factory=list)
    accesses: list[Access] = field(default_factory=list)

    def to_json(self) -> str:
        """Return a JSON document. It consists of lists of lists, so that it is short."""
        return json.dumps({**self.__dict__, "version": 1})

    def digest(self) -> str:
        """Return a digest that is equal for equal recordings."""
        return hashlib.sha256(self.to_json().encode()).hexdigest()

    @classmethod
    def from_json(cls, text: str) -> Recording:
        """Return the recording of a JSON document of `to_json`."""
        data = json.loads(text)
        data.pop("version")
        data["stimulus"] = [Change(*row) for row in data["stimulus"]]
        data["edges"] = [Edge(*row) for row in data["edges"]]
        data["accesses"] = [Access(*row) for row in data["accesses"]]
        return cls(**data)


def by_signal(edges: Iterable[Edge], initial: Mapping[str, int]) -> dict[str, list[tuple[int, int]]]:
    """Return the changes (t, value) of each signal in `initial`.

    If a signal has several changes at one edge, only the last one is used. Repeated levels are omitted.
    """
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
    """Return the level at edge t, including a change at t.

    The search is a bisection because a recording may have 100 000 changes.
    """
    place = bisect_right(changes, t, key=lambda change: change[0])
    return changes[place - 1][1] if place else initial


def bit_changes(changes: list[tuple[int, int]], place: int, initial: int) -> list[tuple[int, int]]:
    """Return the changes (edge, level) of one bit of a port."""
    level, rows = initial >> place & 1, []
    for t, value in changes:
        if value >> place & 1 != level:
            level ^= 1
            rows.append((t, level))
    return rows


def steps(changes: list[tuple[int, int]]) -> list[int]:
    """Return the edges at which the phases (positive logic) change to another pattern.

    Off-times of a chopper are not changes of the pattern.
    """
    found, last = [], 0
    for t, pattern in changes:
        if pattern and last and pattern != last:
            found.append(t)
        last = pattern or last
    return found
