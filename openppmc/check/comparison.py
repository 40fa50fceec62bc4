"""Comparison of two lists of output edges: the edges of both lists, and the first difference."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from .pins import Pinned
from .records import Edge, Recording, by_signal, level_at

Waves = dict[str, list[tuple[int, int]]]
PULSES = "pout_n"
"""Output whose falling edges are pulses (P104-GEN-05)."""


@dataclass(frozen=True)
class Mismatch:
    """First difference of two lists of edges.

    Attributes:
        t: clock edge of the difference.
        signal: output that differs there.
        expected, actual: first change (t, value) of `signal` that differs: in the model, and on the other
        side. `None` means that this side has no further change.
        differing: all outputs that differ, in order of their first difference.
    """

    t: int
    signal: str
    expected: tuple[int, int] | None
    actual: tuple[int, int] | None
    differing: tuple[str, ...]


@dataclass(frozen=True)
class Comparison:
    """The output edges of a run, expected and actual, for a report or a picture.

    Attributes:
        pins: pins of the part.
        seen: name of the source whose edges were compared with the edges of the model.
    """

    recording: Recording
    initial: Mapping[str, int]
    expected: Waves
    actual: Waves
    mismatch: Mismatch | None
    pins: Pinned
    seen: str = "RTL"

    @property
    def edges_compared(self) -> int:
        """Number of output edges in the run."""
        return sum(len(changes) for changes in self.actual.values())

    @property
    def pulses(self) -> int:
        """Number of falling edges of `pout_n` of all axes; 0 for a part without that output."""
        level, found = self.initial.get(PULSES, 0), 0
        for _, now in self.actual.get(PULSES, ()):
            found += (level & ~now).bit_count()
            level = now
        return found


def compare_edges(
    expected: Iterable[Edge],
    actual: Iterable[Edge],
    initial: Mapping[str, int],
    end: int,
    resets: Iterable[int] = (),
) -> tuple[Waves, Waves, Mismatch | None]:
    """Compare two lists of output edges up to edge `end`.

    Args:
        initial: outputs to compare, with their levels before edge 0; other outputs are ignored.
        resets: times of the falling edges of `rst_n`.

    Returns:
        The changes of each signal in both lists, and the first difference or `None`.
    """
    snap = {t - 1: t for t in resets}
    sides = []
    for edges in (expected, actual):
        kept = [
            Edge(snap.get(e.t, e.t), e.signal, e.value) for e in edges if e.t <= end and e.signal in initial
        ]
        kept.sort(key=lambda edge: edge.t)
        sides.append(by_signal(kept, initial))
    return sides[0], sides[1], _first_difference(*sides)


def _first_difference(expected: Waves, actual: Waves) -> Mismatch | None:
    found: list[Mismatch] = []
    for signal, wanted in expected.items():
        got = actual[signal]
        if wanted == got:
            continue
        place = next(
            (i for i, (a, b) in enumerate(zip(wanted, got, strict=False)) if a != b),
            min(len(wanted), len(got)),
        )
        left = wanted[place] if place < len(wanted) else None
        right = got[place] if place < len(got) else None
        t = min(side[0] for side in (left, right) if side is not None)
        found.append(Mismatch(t, signal, left, right, ()))
    if not found:
        return None
    first = min(found, key=lambda m: m.t)
    names = tuple(m.signal for m in sorted(found, key=lambda m: m.t))
    return Mismatch(first.t, first.signal, first.expected, first.actual, names)


def differing_spans(comparison: Comparison, name: str) -> list[tuple[int, int]]:
    """Return the times at which the two sides differ in one output, as changes (t, level).

    While the level is 1, the two sides differ.
    """
    expected, actual = comparison.expected[name], comparison.actual[name]
    initial, spans, state = comparison.initial[name], [], 0
    for t in sorted({t for t, _ in expected} | {t for t, _ in actual}):
        now = int(level_at(expected, t, initial) != level_at(actual, t, initial))
        if now != state:
            spans.append((t, now))
            state = now
    return spans
