"""A picture of a run: speed profile and pins over time, an overview above and close-ups below.

Input is plain data: per signal the level before the first edge and the changes (clk edge, level). Nothing is
computed from the host's commands, so the picture shows what the pins did.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

SLOWEST = 2.1e-3  # s; pulses farther apart belong to different motions (rate 255 at 125 kHz is 2.048 ms)

Changes = Sequence[tuple[int, int]]

INK, GREY, PALE = "#1b2733", "#6b7785", "#dfe4ea"
SPEED = "#0b6fb8"
COLOURS = {
    "S1": "#1b7f79",
    "S2": "#2f9e6e",
    "S3": "#6aa84f",
    "S4": "#a8a032",
    "S5": "#a9b0b8",
    "POUT": INK,
    "DIR": "#7a4fa3",
    "HOLD": "#c26a1b",
    "INT": "#c0392b",
    "L1": "#8c2d62",
}


@dataclass(frozen=True)
class Trace:
    """One pin: name as drawn (* = active low), level before the first change, changes (clk edge, level)."""

    name: str
    initial: int
    changes: Changes

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
class Run:
    """All that the picture shows. `pulses` are the edges of the pulses, in clk."""

    title: str
    subtitle: str
    clk_hz: int
    end: int
    traces: Sequence[Trace]
    pulses: Sequence[int]
    chapters: Sequence[Section]
    zooms: Sequence[Section]


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


def bare(axes: Axes) -> None:
    """No frame, no ticks but those of x."""
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    axes.spines["bottom"].set_color(PALE)
    axes.tick_params(colors=GREY, labelsize=8, length=3)


def draw_traces(
    axes: Axes, traces: Sequence[Trace], begin: int, end: int, scale: float, label_size: int = 9
) -> None:
    """Logic levels stacked from top to bottom, x in units of `scale` clk from `begin` on."""
    count = len(traces)
    for row, trace in enumerate(traces):
        base = (count - 1 - row) * 1.5
        colour = COLOURS.get(trace.name.rstrip("*"), INK)
        times, levels = trace.within(begin, end)
        xs = [(t - begin) / scale for t in times]
        ys = [base + level for level in levels]
        idle = base + trace.name.endswith("*")  # what is filled is the active level
        axes.fill_between(xs, idle, ys, step="post", color=colour, alpha=0.18, linewidth=0)
        dense = len(times) > 400
        axes.step(
            xs, ys, where="post", color=colour, linewidth=0.35 if dense else 1.3, solid_joinstyle="miter"
        )
        axes.text(
            -0.008,
            base + 0.5,
            trace.name,
            transform=axes.get_yaxis_transform(),
            ha="right",
            va="center",
            fontsize=label_size,
            color=colour,
            fontweight="bold",
        )
    axes.set_ylim(-0.4, count * 1.5 - 0.1)
    axes.set_yticks([])
    axes.set_xlim(0, (end - begin) / scale)
    bare(axes)


def draw_speed(axes: Axes, run: Run, begin: int, end: int, scale: float) -> None:
    """Speed over time, filled."""
    for times, values in speeds(run.pulses, run.clk_hz, gap=round(SLOWEST * run.clk_hz)):
        xs = [(t - begin) / scale for t in times]
        ys = [value / 1000 for value in values]
        axes.fill_between(xs, 0, ys, step="post", color=SPEED, alpha=0.18, linewidth=0)
        axes.step(xs, ys, where="post", color=SPEED, linewidth=1.6)
        axes.plot([xs[0], xs[0]], [0, ys[0]], color=SPEED, linewidth=1.6)
        axes.plot([xs[-1], xs[-1]], [0, ys[-1]], color=SPEED, linewidth=1.6)
    axes.set_xlim(0, (end - begin) / scale)
    axes.set_ylim(0, None)
    axes.margins(y=0.25)
    bare(axes)
    axes.grid(axis="y", color=PALE, linewidth=0.8)
    axes.set_axisbelow(True)


def overview(figure: Figure, rows: tuple[Axes, Axes], run: Run) -> None:
    """The whole run: speed above, pins below, chapters as numbered bands."""
    scale = run.clk_hz / 1000
    speed, pins = rows
    draw_speed(speed, run, 0, run.end, scale)
    top = speed.get_ylim()[1] * 1.28
    speed.set_ylim(0, top)
    speed.set_ylabel("speed / kpps", fontsize=9, color=GREY)
    draw_traces(pins, run.traces, 0, run.end, scale)
    pins.set_xlabel("time after reset / ms", fontsize=9, color=GREY, loc="right", labelpad=2)
    speed.tick_params(labelbottom=False)
    for index, chapter in enumerate(run.chapters):
        left, right = chapter.begin / scale, chapter.end / scale
        for axes in rows:
            if index % 2 == 0:
                axes.axvspan(left, right, color="#f4f6f8", zorder=-5, linewidth=0)
            axes.axvline(left, color=PALE, linewidth=0.8, zorder=-4)
        speed.text(
            (left + right) / 2,
            top * 0.985,
            chapter.title,
            ha="center",
            va="top",
            fontsize=9,
            color=INK,
            linespacing=1.25,
        )
    for index, zoom in enumerate(run.zooms):
        middle = (zoom.begin + zoom.end) / 2 / scale
        pins.annotate(
            "ABCDEF"[index],
            (middle, 0),
            xycoords=("data", "axes fraction"),
            xytext=(0, -32),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=9,
            color="white",
            fontweight="bold",
            bbox={"boxstyle": "circle,pad=0.25", "color": SPEED},
            arrowprops={"arrowstyle": "-", "color": SPEED, "linewidth": 1},
        )


def close_up(axes: Axes, run: Run, zoom: Section, letter: str) -> None:
    """One zoom: all pins, times in µs from its beginning, marked edges with what happens there."""
    scale = run.clk_hz / 1e6
    draw_traces(axes, run.traces, zoom.begin, zoom.end, scale, label_size=8)
    axes.set_xlabel("µs", fontsize=9, color=GREY, labelpad=1)
    axes.text(
        0,
        1.115,
        letter,
        transform=axes.transAxes,
        fontsize=9,
        color="white",
        fontweight="bold",
        ha="center",
        va="center",
        bbox={"boxstyle": "circle,pad=0.25", "color": SPEED},
    )
    axes.text(
        0.035,
        1.115,
        zoom.title,
        transform=axes.transAxes,
        fontsize=10.5,
        color=INK,
        fontweight="bold",
        va="center",
    )
    axes.text(0.035, 1.05, zoom.note, transform=axes.transAxes, fontsize=8.5, color=GREY, va="center")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 1.5)
    for t, text in zoom.marks:
        x = (t - zoom.begin) / scale
        axes.plot([x, x], [low, high], color=GREY, linewidth=0.8, linestyle=(0, (3, 2)), zorder=0)
        axes.text(x, high + 0.1, text, fontsize=8, color=INK, ha="center", va="bottom", linespacing=1.1)
    for first, second, text in zoom.spans:
        left, right = (first - zoom.begin) / scale, (second - zoom.begin) / scale
        for x in (left, right):
            axes.plot([x, x], [low, high + 0.3], color=GREY, linewidth=0.6, linestyle=(0, (3, 2)), zorder=0)
        arrow = {"arrowstyle": "<->", "color": GREY, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (right, high + 0.25), xytext=(left, high + 0.25), arrowprops=arrow)
        axes.text((left + right) / 2, high + 0.45, text, fontsize=8, color=INK, ha="center", va="bottom")


def draw(run: Run, path: Path) -> None:
    """Draw the run into a PNG."""
    plt.rcParams["font.family"] = "DejaVu Sans"
    figure = plt.figure(figsize=(16, 11.6), dpi=110, facecolor="white")
    count = max(len(run.zooms), 1)
    grid = figure.add_gridspec(
        2, 1, height_ratios=(1.25, 1), hspace=0.34, left=0.055, right=0.985, top=0.905, bottom=0.045
    )
    upper = grid[0].subgridspec(2, 1, height_ratios=(1, 1.25), hspace=0.06)
    overview(figure, (figure.add_subplot(upper[0]), figure.add_subplot(upper[1])), run)
    lower = grid[1].subgridspec(1, count, wspace=0.17)
    for index, zoom in enumerate(run.zooms):
        close_up(figure.add_subplot(lower[index]), run, zoom, "ABCDEF"[index])
    figure.text(0.055, 0.972, run.title, fontsize=16, fontweight="bold", color=INK, va="center")
    figure.text(0.055, 0.944, run.subtitle, fontsize=10, color=GREY, va="center")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)
