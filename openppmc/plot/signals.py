"""Data for the picture of a run: pins, pulses, chapters and close-ups.

Times are edges of the clock.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

Changes = Sequence[tuple[int, int]]


@dataclass(frozen=True)
class Trace:
    """One pin.

    Attributes:
        name: name in the picture; a * marks an active-low pin.
        initial: level before the first change.
        changes: changes of the pin as (edge, level).
        colour: colour of the waveform, instead of the colour that follows from the name.
    """

    name: str
    initial: int
    changes: Changes
    colour: str = ""

    def within(self, begin: int, end: int) -> tuple[list[int], list[int]]:
        """Return edges and levels for a step plot from `begin` to `end`."""
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
    """Named interval in edges of the clock.

    Attributes:
        note: subtitle.
        marks: marked edges as (edge, text), only in close-ups.
        spans: marked times as (first edge, last edge, text), only in close-ups.
    """

    title: str
    begin: int
    end: int
    note: str = ""
    marks: Sequence[tuple[int, str]] = field(default=())
    spans: Sequence[tuple[int, int, str]] = field(default=())


@dataclass(frozen=True)
class Speed:
    """Curve of the speed: name in the legend, colour, and times of the pulses in cycles.

    If all names are empty, the picture has no legend.
    """

    name: str
    colour: str
    pulses: Sequence[int]


@dataclass(frozen=True)
class Run:
    """Content of the picture.

    Attributes:
        row_scale: relative height of the rows of pins; 1 = normal.
        unit: unit of the speed axis, which counts thousands per second.
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
    """Return the speed in pulses per second as step curves.

    Successive pulses belong to the same curve if their interval is at most `gap` cycles.
    """
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
