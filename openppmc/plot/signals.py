"""What a picture of a run shows: pins, pulses, chapters and close-ups, as plain data in clk edges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

Changes = Sequence[tuple[int, int]]


@dataclass(frozen=True)
class Trace:
    """One pin: name as drawn (* = active low), level before the first change, changes (clk edge, level).

    `colour` overrides what the name stands for.
    """

    name: str
    initial: int
    changes: Changes
    colour: str = ""

    def within(self, begin: int, end: int) -> tuple[list[int], list[int]]:
        """Edges and levels for a step plot from `begin` to `end`."""
        level, times, levels = self.initial, [begin], []
        inside = []
        for t, value in self.changes:
            if t <= begin:
                level = value
            elif t < end:
                inside.append((t, value))
        levels.append(level)
        for t, value in inside:
            times.append(t)
            levels.append(value)
        return [*times, end], [*levels, levels[-1]]


@dataclass(frozen=True)
class Section:
    """A named stretch of time in clk edges.

    `note` is its subtitle, `marks` are (edge, text) and `spans` (edge, edge, text), drawn in close-ups only.
    """

    title: str
    begin: int
    end: int
    note: str = ""
    marks: Sequence[tuple[int, str]] = field(default=())
    spans: Sequence[tuple[int, int, str]] = field(default=())


@dataclass(frozen=True)
class Speed:
    """A curve of the speed: its name (empty: no legend), its colour, and the edges of the pulses, in clk."""

    name: str
    colour: str
    pulses: Sequence[int]


@dataclass(frozen=True)
class Run:
    """All that the picture shows. `row_scale` makes the rows of pins lower than usual.

    `unit` is that of the speed, thousands a second.
    """

    title: str
    subtitle: str
    clk_hz: int
    end: int
    traces: Sequence[Trace]
    speeds: Sequence[Speed]
    chapters: Sequence[Section]
    zooms: Sequence[Section]
    row_scale: float = 1.0
    unit: str = "kpps"


def speeds(pulses: Sequence[int], clk_hz: int, gap: int) -> list[tuple[list[int], list[float]]]:
    """Speed in pulses per second as step curves, one for each stretch of pulses closer than `gap` clk."""
    curves: list[tuple[list[int], list[float]]] = []
    times: list[int] = []
    values: list[float] = []
    for first, second in zip(pulses, pulses[1:], strict=False):
        if second - first > gap:
            if times:
                curves.append(([*times, first], [*values, values[-1]]))
            times, values = [], []
            continue
        times.append(first)
        values.append(clk_hz / (second - first))
    if times:
        curves.append(([*times, pulses[-1]], [*values, values[-1]]))
    return curves
