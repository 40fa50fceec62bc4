"""The picture of the bank's demo: 32 speed profiles, and the first pulses of all axes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from openppmc.plot.motion import GREY, INK, PALE, bare
from scripts.demo.bank.moves import AXES, CLK_HZ, ORDERS, Order
from scripts.demo.scenes import micros, subtitle

MS = CLK_HZ / 1000  # cycles
US = CLK_HZ // 1_000_000  # cycles
COLUMNS = 8
PREDICTED = "#1b2733"


def colour(axis: int) -> tuple[float, ...]:
    """Return the colour of an axis: violet for fast axes, yellow-green for slow axes."""
    return tuple(colormaps["viridis"](0.85 * axis / (AXES - 1)))


def profile(times: Sequence[float]) -> tuple[list[float], list[float]]:
    """Return the times (ms) and speeds (kpps) of a step curve, from pulses in ms."""
    speeds = [1 / (b - a) for a, b in zip(times, times[1:], strict=False)]
    return list(times), [*speeds, *speeds[-1:]]


def panel(axes: Axes, one: Order, pulses: Sequence[int], first: int) -> None:
    """Draw the measured speed of an axis of the RTL as steps, and the predicted speed as a line."""
    axes.set_xlim(-1, 42)
    axes.set_ylim(0, 33)
    bare(axes)
    axes.tick_params(labelsize=7)
    xs, ys = profile([(t - first) / MS for t in pulses])
    axes.fill_between(xs, 0, ys, step="post", color=colour(one.axis), alpha=0.55, linewidth=0)
    foretold = one.predicted().seconds
    xs, ys = profile([t * 1000 for t in foretold])
    axes.step([0, *xs, xs[-1]], [0, *ys, 0], where="post", color=PREDICTED, linewidth=0.7)
    text = f"RL {one.rl}, RH {one.rh}, PA {one.pa}\n{'−' if one.signed < 0 else '+'}{one.pulses} pulses"
    axes.text(0, 1.0, f"axis {one.axis}", transform=axes.transAxes, fontsize=8, weight="bold", color=INK,
              va="top")  # fmt: skip
    axes.text(1.0, 1.0, text, transform=axes.transAxes, fontsize=6.5, color=GREY, va="top", ha="right")


def rows_of(axes: Axes) -> None:
    """Set up a row for each axis, with axis 0 at the top."""
    axes.set_ylim(AXES - 0.4, -0.6)
    axes.set_yticks(range(0, AXES, 4))
    bare(axes)
    axes.set_ylabel("axis", fontsize=9, color=GREY)


def heads(axes: Axes, title: str, note: str) -> None:
    """Write the title and the note of a close-up."""
    axes.text(0, 1.075, title, transform=axes.transAxes, fontsize=10.5, weight="bold", color=INK)
    axes.text(0, 1.025, note, transform=axes.transAxes, fontsize=8.5, color=GREY)


def train(axes: Axes, pulses: Sequence[Sequence[int]], first: int) -> None:
    """Draw all pulses of the first 3 ms, in which the pulses of the axes drift apart."""
    for axis, found in enumerate(pulses):
        near = [(t - first) / MS for t in found if t - first < 3 * MS]
        axes.eventplot(near, lineoffsets=axis, linelengths=0.8, colors=[colour(axis)], linewidths=0.7)
    rows_of(axes)
    axes.set_xlim(-0.05, 3)
    axes.set_xlabel("ms after pulse 1", fontsize=9, color=GREY)
    heads(axes, "The first 3 ms", "each line is a pulse: together at 0, then each axis on its own ramp")


def edge(axes: Axes, levels: Any, pulses: Sequence[Sequence[int]], first: int) -> None:
    """Draw the level of every pulse output in each cycle around the first falling edge."""
    span = range(-6, 7)
    for axis in range(AXES):
        found = [t for t, bits in levels if first + span[0] <= t <= first + span[-1]]
        xs, ys, now = [span[0]], [axis + 0.0], 0.0
        for t in found:
            bits = next(value for when, value in levels if when == t)
            now = 0.0 if bits >> axis & 1 else 0.62
            xs += [t - first]
            ys += [axis + now]
        axes.step([*xs, span[-1]], [*(y - 0.31 for y in ys), ys[-1] - 0.31], where="post",
                  color=colour(axis), linewidth=1.3)  # fmt: skip
    for n in span:
        axes.axvline(n, color=PALE, linewidth=0.6, zorder=0)
    rows_of(axes)
    axes.set_xlim(span[0], span[-1])
    axes.set_xticks(list(span))
    axes.set_xlabel("cycles after pulse 1", fontsize=9, color=GREY)
    firsts = {found[0] for found in pulses if found}
    skew = max(firsts) - min(firsts)
    heads(
        axes,
        f"The start, cycle by cycle: skew {skew} cycles",
        f"pout_n of {AXES} axes, one visit a cycle; a cycle is {micros(1, CLK_HZ)}",
    )


def offsets(axes: Axes, pulses: Sequence[Sequence[int]], first: int) -> None:
    """Draw the distribution of the differences between all pulses and their prediction."""
    found = Counter(
        edge - first - expected
        for one, train in zip(ORDERS, pulses, strict=True)
        for edge, expected in zip(train, one.predicted().clk, strict=False)
    )
    worst = max(map(abs, found), default=0)
    places = range(-max(3, worst), max(3, worst) + 1)
    axes.bar(places, [found[place] for place in places], width=0.6, color=colour(10), alpha=0.8)
    for place in places:
        axes.text(place, found[place], str(found[place]), ha="center", va="bottom", fontsize=9, color=INK)
    bare(axes)
    axes.set_yticks([])
    axes.set_xlabel("deviation in cycles", fontsize=9, color=GREY)
    heads(
        axes,
        f"All pulses: deviation of at most {worst} cycles",
        "edges at the RTL minus those predicted for a single PPMC-104",
    )


def frame(figure: Figure, comparison: Any) -> None:
    """Write the title of the whole picture."""
    figure.text(0.035, 0.977, "PPMC bank: 32 axes, 32 ramps, one GO", fontsize=16, weight="bold", color=INK)
    text = subtitle(comparison, CLK_HZ).removesuffix(" Pins with * are active low.")
    figure.text(0.035, 0.957, text, fontsize=10, color=GREY)
    key = "Filled: speed at the pins of the RTL, kpps over ms. Line: predicted from the initialisation bytes."
    figure.text(0.035, 0.94, key, fontsize=9, color=GREY)


def draw(comparison: Any, pulses: Sequence[Sequence[int]], first: int, path: Path) -> None:
    """Draw the picture into a PNG.

    Raises IndexError if an axis has no pulses.

    Args:
        first: edge at which all axes output their first pulse.
    """
    plt.rcParams["font.family"] = "DejaVu Sans"
    figure = plt.figure(figsize=(16, 15), dpi=110, facecolor="white")
    grid = figure.add_gridspec(
        2, 1, height_ratios=(7, 6), left=0.035, right=0.985, top=0.925, bottom=0.04, hspace=0.19
    )
    upper = grid[0].subgridspec(AXES // COLUMNS, COLUMNS, wspace=0.12, hspace=0.22)
    for one in ORDERS:
        row, column = divmod(one.axis, COLUMNS)
        axes = figure.add_subplot(upper[row, column])
        panel(axes, one, pulses[one.axis], first)
        axes.tick_params(labelbottom=row == AXES // COLUMNS - 1, labelleft=column == 0)
    lower = grid[1].subgridspec(1, 3, wspace=0.13)
    train(figure.add_subplot(lower[0]), pulses, first)
    edge(figure.add_subplot(lower[1]), comparison.actual["pout_n"], pulses, first)
    offsets(figure.add_subplot(lower[2]), pulses, first)
    frame(figure, comparison)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)
