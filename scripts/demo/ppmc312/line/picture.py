"""The picture of sixteen axes on one line: positions, transmissions over time, bits of three exchanges."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from openppmc.check.comparison import Comparison
from openppmc.plot.motion import GREY, INK, PALE, SPEED, bare, close_up
from openppmc.plot.signals import Run, Section, Trace
from scripts.demo.ppmc312.line.talk import Exchange, LineRun
from scripts.demo.ppmc312.line.waves import positions
from scripts.demo.scenes import heading, pin

MASTER = SPEED
REPLIES = {"busy": "#c26a1b", "ready": "#2f9e6e", "data": "#c0392b", "specific": "#7a4fa3"}
SHADES = plt.get_cmap("turbo")
CHARACTER = 960
"""Length of a character in cycles."""


def shade(number: int, count: int) -> Any:
    """Return the colour of a station."""
    return SHADES(0.06 + 0.88 * number / max(1, count - 1))


def ways(
    axes: Axes, run: LineRun, comparisons: Sequence[Comparison], span: tuple[int, int], ms: float
) -> None:
    """Draw the position of every axis from its pulses, with a dot for each position that was read."""
    read = {one.station: one for one in run.talk if one.code == 0x42}
    for number, comparison in enumerate(comparisons):
        rows = [(span[0], 0), *positions(comparison)]
        last = rows[-1][1]
        xs, ys = [t / ms for t, _ in rows], [where for _, where in rows]
        colour = shade(number, len(comparisons))
        axes.step([*xs, span[1] / ms + 1], [*ys, last], where="post", color=colour, linewidth=1.5)
        if number in read:
            axes.plot(read[number].end / ms, run.positions[number], "o", color=colour, markersize=4.5)
        axes.text(1.006, last, f"{number}: {run.positions[number]}", transform=axes.get_yaxis_transform(),
                  fontsize=8, color=INK, va="center")  # fmt: skip
    bare(axes)
    axes.grid(axis="y", color=PALE, linewidth=0.8)
    heading(
        axes, "Positions of sixteen axes, counted at their pulse outputs; dots: positions read over the line"
    )
    axes.set_ylabel("pulses", fontsize=9, color=GREY)


def traffic(axes: Axes, talk: Sequence[Exchange], count: int, ms: float) -> None:
    """Draw a row for each station: the frames that the master sends to it, and its replies."""
    rows: dict[str, list[tuple[int, float, float]]] = {}
    for one in talk:
        rows.setdefault("master", []).append((one.station, one.begin, one.sent_end))
        if one.answer:
            rows.setdefault(one.kind, []).append((one.station, one.replied, one.end))
    for name, colour in {"master": MASTER, **REPLIES}.items():
        label = "frame of the master" if name == "master" else f"it replies: {name}"
        for station, begin, end in rows.get(name, ()):
            axes.broken_barh(
                [(begin / ms, (end - begin) / ms)], (station - 0.4, 0.8), color=colour, label=label
            )
            label = ""
    axes.set_ylim(count - 0.4, -0.6)
    axes.set_yticks(range(count))
    bare(axes)
    axes.grid(axis="y", color=PALE, linewidth=0.6)
    axes.set_axisbelow(True)
    handles, labels = axes.get_legend_handles_labels()
    named = {text: handle for handle, text in zip(handles, labels, strict=True) if text}
    axes.legend(named.values(), named.keys(), loc="lower left", frameon=True, framealpha=0.9, edgecolor=PALE,
                fontsize=9, labelcolor=INK, ncols=1)  # fmt: skip
    heading(axes, "Who speaks when")
    axes.set_ylabel("station", fontsize=9, color=GREY)
    axes.set_xlabel("ms after reset", fontsize=9, color=GREY, labelpad=1)


def characters(one: Exchange) -> list[tuple[int, str]]:
    """Return (edge in the middle of a character, its text) for each character of both frames."""
    rows = []
    for begin, frame in ((one.begin, one.question), (one.replied, one.answer)):
        for place, byte in enumerate(frame):
            edge = place in (0, len(frame) - 1)
            text = f"{byte:02X}" if edge else f"'{chr(byte)}'"
            rows.append((begin + CHARACTER * place + CHARACTER // 2, text))
    return rows


def exchange(axes: Axes, run: LineRun, comparison: Comparison, one: Exchange, letter: str) -> None:
    """Draw the levels that the master and the station send, and their characters."""
    traces = [
        Trace("MASTER", 1, pin(run.recording.stimulus, "master"), MASTER),
        Trace("SND", 0, comparison.actual["snd"], "#7a4fa3"),
        Trace("TXD", 1, comparison.actual["txd"], REPLIES.get(one.kind, INK)),
    ]
    zoom = Section(one.meaning, one.begin - 400, one.end + 700, f"reply: {one.reply}")
    clk_hz = int(str(run.recording.params["CLK_HZ"]))
    close_up(axes, Run("", "", clk_hz, run.recording.end, traces, [], [], [], row_scale=2.2), zoom, letter)
    us = clk_hz / 1e6
    for t, text in characters(one):
        high = t < one.sent_end
        axes.text((t - zoom.begin) / us, 4.05 if high else -0.05, text, fontsize=6.5, ha="center",
                  va="bottom" if high else "top", color=INK)  # fmt: skip
    axes.set_ylim(-0.7, 4.6)


def chosen(talk: Sequence[Exchange]) -> list[Exchange]:
    """Return a start, a poll of a moving axis, and the poll that reports its stop."""
    start = next(one for one in talk if one.code == 0x83 and one.station == 4)
    polls = [one for one in talk if not one.code and one.station == 4 and one.begin > start.begin]
    return [start, *(next(one for one in polls if one.kind == kind) for kind in ("busy", "data"))]


def draw(run: LineRun, comparisons: Sequence[Comparison], path: Path) -> None:
    """Draw the picture into a PNG."""
    clk_hz = int(str(run.recording.params["CLK_HZ"]))
    by_key: Mapping[str, Mapping[str, Any]] = {chapter["key"]: chapter for chapter in run.chapters}
    span = by_key["start"]["begin"] - clk_hz // 1000, run.recording.end
    ms = clk_hz / 1000
    plt.rcParams["font.family"] = "DejaVu Sans"
    figure = plt.figure(figsize=(16, 13.6), dpi=110, facecolor="white")
    rows = figure.add_gridspec(
        3, 1, height_ratios=(4.6, 3.6, 2.2), hspace=0.24, left=0.055, right=0.945, top=0.925, bottom=0.045
    )
    upper, middle = figure.add_subplot(rows[0]), figure.add_subplot(rows[1])
    ways(upper, run, comparisons, span, ms)
    traffic(middle, [one for one in run.talk if one.begin >= span[0]], len(comparisons), ms)
    for axes in (upper, middle):
        axes.set_xlim(span[0] / ms, span[1] / ms + 1)
    below = rows[2].subgridspec(1, 3, wspace=0.2)
    for index, one in enumerate(chosen(run.talk)):
        exchange(figure.add_subplot(below[index]), run, comparisons[one.station], one, "ABC"[index])
    count = sum(comparison.edges_compared for comparison in comparisons)
    good = all(comparison.mismatch is None for comparison in comparisons)
    title = "PPMC-312 in serial mode: sixteen stations on one line"
    subtitle = (
        f"RTL in simulation at {clk_hz / 1e6:g} MHz, line at 83 333 bps. {count} edges of all outputs "
        f"compared with sixteen golden models: {'no difference' if good else 'DIFFERENT, see compare.txt'}. "
        f"The first {span[0] / ms:.0f} ms, in which the tables are built, are not shown."
    )
    figure.text(0.055, 0.978, title, fontsize=16, fontweight="bold", color=INK, va="center")
    figure.text(0.055, 0.957, subtitle, fontsize=10, color=GREY, va="center")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)
