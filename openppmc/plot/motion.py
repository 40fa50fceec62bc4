"""Picture of a run: speed profile and pins over time.

An overview is above, and close-ups are below.

The input is plain data: for each signal, the level before the first edge and the changes (edge, level). The
picture shows only recorded pins, and no values that are computed from the commands of the host.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .signals import Run, Section, Trace, speeds

# Longest interval between two pulses of a motion in s. Pulses with a longer interval belong to different
# motions (rate 255 at 125 kHz is 2.048 ms).
SLOWEST = 2.1e-3

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
    "L3": "#8c2d62",
    "CNP": "#7a4fa3",
    "IRQ": "#c0392b",
}


def bare(axes: Axes) -> None:
    """Remove the frame, and all ticks except the ticks of the x axis."""
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    axes.spines["bottom"].set_color(PALE)
    axes.tick_params(colors=GREY, labelsize=8, length=3)


def draw_traces(
    axes: Axes, traces: Sequence[Trace], begin: int, end: int, scale: float, label_size: int = 9
) -> None:
    """Draw logic levels, stacked from top to bottom.

    x is in units of `scale` cycles from `begin` on.
    """
    count = len(traces)
    for row, trace in enumerate(traces):
        base = (count - 1 - row) * 1.5
        colour = trace.colour or COLOURS.get(trace.name.rstrip("*"), INK)
        times, levels = trace.within(begin, end)
        xs = [(t - begin) / scale for t in times]
        ys = [base + level for level in levels]
        idle = base + trace.name.endswith("*")  # fill between the idle level and the waveform
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
    """Draw the speed over time as filled curves, with a legend if the curves have names."""
    for curve in run.speeds:
        label = curve.name
        for times, values in speeds(curve.pulses, run.clk_hz, gap=round(SLOWEST * run.clk_hz)):
            xs = [(t - begin) / scale for t in times]
            ys = [value / 1000 for value in values]
            axes.fill_between(xs, 0, ys, step="post", color=curve.colour, alpha=0.18, linewidth=0)
            axes.step(xs, ys, where="post", color=curve.colour, linewidth=1.6, label=label or None)
            axes.plot([xs[0], xs[0]], [0, ys[0]], color=curve.colour, linewidth=1.6)
            axes.plot([xs[-1], xs[-1]], [0, ys[-1]], color=curve.colour, linewidth=1.6)
            label = ""
    if any(curve.name for curve in run.speeds):
        axes.legend(loc="center right", frameon=False, fontsize=9, labelcolor=INK)
    axes.set_xlim(0, (end - begin) / scale)
    axes.set_ylim(0, None)
    axes.margins(y=0.25)
    bare(axes)
    axes.grid(axis="y", color=PALE, linewidth=0.8)
    axes.set_axisbelow(True)


def overview(figure: Figure, rows: tuple[Axes, Axes], run: Run) -> None:
    """Draw the complete run: the speed above, the pins below, and the chapters as numbered bands."""
    scale = run.clk_hz / 1000
    speed, pins = rows
    draw_speed(speed, run, 0, run.end, scale)
    top = speed.get_ylim()[1] * 1.28
    speed.set_ylim(0, top)
    speed.set_ylabel(f"speed / {run.unit}", fontsize=9, color=GREY)
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
    """Draw a close-up of all pins, with times in µs from its beginning, and marked edges with their text."""
    scale = run.clk_hz / 1e6
    lift = 9 / (len(run.traces) * run.row_scale)  # constant distance of the titles from the axes
    title, note, marks = 1 + 0.115 * lift, 1 + 0.05 * lift, 1.5 / run.row_scale
    draw_traces(axes, run.traces, zoom.begin, zoom.end, scale, label_size=8)
    axes.set_xlabel("µs", fontsize=9, color=GREY, labelpad=1)
    axes.text(
        0,
        title,
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
        title,
        zoom.title,
        transform=axes.transAxes,
        fontsize=10.5,
        color=INK,
        fontweight="bold",
        va="center",
    )
    axes.text(0.035, note, zoom.note, transform=axes.transAxes, fontsize=8.5, color=GREY, va="center")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + marks)
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
    """Draw the picture of the run into a PNG file."""
    plt.rcParams["font.family"] = "DejaVu Sans"
    # The height in inches depends on the number of rows of pins in the overview and the close-ups; it is 11.6
    # for nine rows.
    rows = len(run.traces) / 9 * run.row_scale
    speed, pins, lower, gap, margins = 2.10531, 2.63163 * rows, 3.78955 * rows, 1.4495, (1.102, 0.522)
    height = round(speed + pins + lower + gap + sum(margins), 4)
    figure = plt.figure(figsize=(16, height), dpi=110, facecolor="white")
    count = max(len(run.zooms), 1)
    grid = figure.add_gridspec(
        2,
        1,
        height_ratios=(speed + pins, lower),
        hspace=gap * 2 / (speed + pins + lower),
        left=0.055,
        right=0.985,
        top=1 - margins[0] / height,
        bottom=margins[1] / height,
    )
    upper = grid[0].subgridspec(2, 1, height_ratios=(speed, pins), hspace=0.06)
    overview(figure, (figure.add_subplot(upper[0]), figure.add_subplot(upper[1])), run)
    below = grid[1].subgridspec(1, count, wspace=0.17)
    for index, zoom in enumerate(run.zooms):
        close_up(figure.add_subplot(below[index]), run, zoom, "ABCDEF"[index])
    figure.text(0.055, 1 - 0.3248 / height, run.title, fontsize=16, fontweight="bold", color=INK, va="center")
    figure.text(0.055, 1 - 0.6496 / height, run.subtitle, fontsize=10, color=GREY, va="center")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)
