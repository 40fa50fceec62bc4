"""The pin changes that a part gets from a test and from its bench's top, in one list that only grows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .stimulus import Change


class Given:
    """`changes`: in order of time, whatever comes later stands behind what has been there before."""

    def __init__(self) -> None:
        self.changes: list[Change] = []
        self._driven = 0
        self._made: dict[str, tuple[int, tuple[int, int]]] = {}
        """Name -> how many of its rows are in the list, and the last of these."""

    def add(self, driven: Sequence[Change], made: Mapping[str, Sequence[tuple[int, int]]]) -> list[Change]:
        """What is new of both, which grow from call to call; the whole list.

        made: name -> (edge, level), first sampled by the edge behind it. The last level of the last edge may
        have changed since it was seen.
        """
        new, self._driven = list(driven[self._driven :]), len(driven)
        for name, rows in made.items():
            if not rows:
                continue
            count, last = self._made.get(name, (0, rows[0]))
            if count and rows[count - 1] != last:
                count -= 1
            new += [Change(t + 1, name, level) for t, level in rows[count:]]
            self._made[name] = len(rows), rows[-1]
        self.changes += sorted(new, key=lambda change: change.t)
        return self.changes
