"""`make demo PART=ppmc312`: the demo's test, the text of bus accesses, waveforms and picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from openppmc.capture.ppmc312.mnemonics import Ppmc312Decoder
from openppmc.plot.motion import GREY, INK, PALE, SPEED, bare, close_up, draw_speed
from openppmc.plot.signals import Run, Section, Speed, Trace, speeds
from scripts.demo.demos import Demo, View, signals
from scripts.demo.scenes import Levels, heading, micros, pin, register_text, rises, spans, subtitle

LINEAR, SIGMOID, FREE = SPEED, "#c0392b", "#2f9e6e"
RAMPS = (("linear", LINEAR), ("sigmoid", SIGMOID), ("free", FREE))
NAMES = {"linear": "linear", "sigmoid": "sigmoid", "free": "free curve"}
FORCED = "#c26a1b"
Chapters = Mapping[str, Mapping[str, Any]]


def within(edges: Sequence[int], chapter: Mapping[str, Any]) -> list[int]:
    """Return the edges that are within a chapter."""
    return [t for t in edges if chapter["begin"] <= t < chapter["end"]]


def kpps(axes: Axes) -> None:
    """Label the vertical axis of a speed."""
    axes.set_ylabel("kpps", fontsize=9, color=GREY)


def marks(axes: Axes, at: Sequence[tuple[float, str]], top: float) -> None:
    """Draw a vertical line and the name of each event."""
    for x, text in at:
        axes.plot([x, x], [0, top], color=GREY, linewidth=0.8, linestyle=(0, (3, 2)), zorder=0)
        axes.text(x, top, text, fontsize=8, color=INK, ha="center", va="bottom", linespacing=1.1)


def ramps(axes: Axes, pulses: Sequence[int], by_key: Chapters, clk_hz: int) -> None:
    """Draw the same move with three tables, each over the time after its pulse 1."""
    count = end = 0
    for key, colour in RAMPS:
        edges = within(pulses, by_key[key])
        count, end = len(edges), max(end, edges[-1] - edges[0])
        for times, values in speeds(edges, clk_hz, edges[-1]):
            xs = [(t - edges[0]) * 1000 / clk_hz for t in times]
            ys = [0, *(value / 1000 for value in values), 0]
            axes.step([xs[0], *xs, xs[-1]], ys, where="post", color=colour, linewidth=1.6, label=NAMES[key])
    axes.set_xlim(0, end * 1020 / clk_hz)
    axes.set_ylim(0, 140)
    bare(axes)
    axes.grid(axis="y", color=PALE, linewidth=0.8)
    axes.legend(loc="upper right", frameon=False, fontsize=9, labelcolor=INK)
    heading(axes, f"{count} pulses with three tables, 25 to 125 kpps, 1150 pulses of ramp each")
    axes.set_xlabel("ms after pulse 1", fontsize=9, color=GREY, labelpad=1)
    kpps(axes)


def override(
    axes: Axes, pulses: Sequence[int], chapter: Mapping[str, Any], pressed: int, clk_hz: int
) -> None:
    """Draw the continuous motion whose speed changes at two positions and with an event pin."""
    edges = within(pulses, chapter)
    moved = Speed("", FORCED, [t - edges[0] for t in edges])
    end = moved.pulses[-1]
    draw_speed(axes, Run("", "", clk_hz, end, [], [moved], [], []), 0, round(end * 1.02), clk_hz / 1000)
    points = [
        (moved.pulses[399] / clk_hz * 1e3, "position 400:\nramp to 125 kpps"),
        (moved.pulses[1899] / clk_hz * 1e3, "position 1900:\n62.5 kpps immediately"),
        ((pressed - edges[0]) / clk_hz * 1e3, "event 0:\ndecelerate, stop"),
    ]
    axes.set_ylim(0, 165)
    marks(axes, points, 133)
    heading(axes, "Instructions that wait for positions and for an event pin")
    axes.set_xlabel("ms after pulse 1", fontsize=9, color=GREY, labelpad=1)
    kpps(axes)


def zero_return(
    axes: Axes, pulses: Sequence[int], chapter: Mapping[str, Any], changes: Levels, begin: int, clk_hz: int
) -> None:
    """Draw the signed speed over the position, and the range of positions in which the switch is closed."""
    turned = next(t for t, level in changes["dir"] if level == 0 and t > chapter["begin"])
    position, where, speed = begin, [], []
    for first, second in pairwise(within(pulses, chapter)):
        sign = -1 if first < turned else 1
        position += sign
        if (first < turned) == (second < turned):
            where.append(position)
            speed.append(sign * clk_hz / (second - first) / 1000)
    split = next(index for index, value in enumerate(speed) if value > 0)
    for part, colour, text in (
        (slice(0, split), SPEED, "out, CCW"),
        (slice(split, None), SIGMOID, "back, CW"),
    ):
        axes.plot(where[part], speed[part], color=colour, linewidth=1.6, label=text)
    closed = [where[0] - sum(1 for t in within(pulses, chapter) if t < edge) + 1
              for edge, _ in changes["org_n"][:2]]  # fmt: skip
    axes.axvspan(closed[1], closed[0], color=FREE, alpha=0.18, linewidth=0, label="origin switch closed")
    axes.axhline(0, color=GREY, linewidth=0.8)
    bare(axes)
    axes.grid(axis="y", color=PALE, linewidth=0.8)
    axes.set_ylim(-140, 60)
    axes.legend(loc="upper right", frameon=False, fontsize=9, labelcolor=INK)
    heading(axes, f"High-speed zero return: stops at {position + 1}")
    axes.set_xlabel("position", fontsize=9, color=GREY, labelpad=1)
    kpps(axes)


def traces(
    outputs: Levels, initial: Mapping[str, int], stimulus: Sequence[Any], names: Sequence[str]
) -> list[Trace]:
    """Return the rows of a close-up, one for each pin."""
    shown = {"pout": "POUT", "dir": "DIR", "irq_n": "IRQ*", "evt0_n": "EVT0*", "org_n": "ORG*", "we_n": "WE*"}
    return [
        Trace(
            shown[name],
            initial.get(name, 1),
            outputs[name] if name in outputs else pin(stimulus, name),
            {"IRQ*": "#c0392b", "ORG*": FREE, "EVT0*": FORCED}.get(shown[name], ""),
        )
        for name in names
    ]


def start(outputs: Levels, pulses: Sequence[int], chapter: Mapping[str, Any], clk_hz: int) -> Section:
    """Return the close-up of the move to the left, from the instruction to the first pulses."""
    us = clk_hz // 1_000_000
    first = within(pulses, chapter)[:3]
    turned = next(t for t in rises(list(outputs["dir"])) if chapter["begin"] < t)
    return Section(
        "instruction to pulse 1",
        chapter["begin"] - 2 * us,
        first[-1] + 10 * us,
        f"DIR changes {micros(first[0] - turned, clk_hz)} before pulse 1",
        spans=spans(first, clk_hz),
    )


def jump(outputs: Levels, pulses: Sequence[int], chapter: Mapping[str, Any], clk_hz: int) -> Section:
    """Return the close-up of the change of speed at position 1900."""
    us = clk_hz // 1_000_000
    edges = within(pulses, chapter)
    shown = edges[1897:1903]
    done = next(t for t, level in outputs["irq_n"] if level == 0 and t > edges[1899]) - edges[1899]
    return Section(
        "125 to 62.5 kpps at position 1900 (third pulse)",
        shown[0] - 4 * us,
        shown[-1] + 6 * us,
        f"executed and answered {micros(done, clk_hz)} later; takes effect at the pulse after that",
        spans=spans(shown, clk_hz),
    )


def turn(outputs: Levels, pulses: Sequence[int], chapter: Mapping[str, Any], clk_hz: int) -> Section:
    """Return the close-up of the reversal of the zero return."""
    us = clk_hz // 1_000_000
    turned = next(t for t, level in outputs["dir"] if level == 0 and t > chapter["begin"])
    edges = within(pulses, chapter)
    around = [t for t in edges if t < turned][-2:] + [t for t in edges if t >= turned][:2]
    return Section(
        "zero return reverses",
        around[0] - 10 * us,
        around[-1] + 20 * us,
        f"DIR {micros(around[2] - turned, clk_hz)} before the first pulse back",
        spans=spans(around, clk_hz),
    )


def draw(comparison: Any, chapters: Sequence[Mapping[str, Any]], path: Path) -> None:
    """Draw the picture of the compared recording into a PNG."""
    recording, outputs, initial = comparison.recording, comparison.actual, comparison.initial
    clk_hz = int(recording.params["CLK_HZ"])
    by_key = {chapter["key"]: chapter for chapter in chapters}
    pulses = rises(list(outputs["pout"]))
    stimulus = recording.stimulus
    plt.rcParams["font.family"] = "DejaVu Sans"
    figure = plt.figure(figsize=(16, 12.6), dpi=110, facecolor="white")
    rows = figure.add_gridspec(
        3, 1, height_ratios=(3.6, 3.6, 2.6), hspace=0.34, left=0.055, right=0.985, top=0.92, bottom=0.045
    )
    ramps(figure.add_subplot(rows[0]), pulses, by_key, clk_hz)
    middle = rows[1].subgridspec(1, 2, wspace=0.12)
    pressed = pin(stimulus, "evt0_n")[0][0]
    override(figure.add_subplot(middle[0]), pulses, by_key["override"], pressed, clk_hz)
    levels = {"dir": outputs["dir"], "org_n": pin(stimulus, "org_n")}
    zero_return(figure.add_subplot(middle[1]), pulses, by_key["return"], levels, 2500, clk_hz)
    below = rows[2].subgridspec(1, 3, wspace=0.2)
    zooms = (
        (start(outputs, pulses, by_key["sigmoid"], clk_hz), ("we_n", "irq_n", "dir", "pout")),
        (jump(outputs, pulses, by_key["override"], clk_hz), ("irq_n", "dir", "pout")),
        (turn(outputs, pulses, by_key["return"], clk_hz), ("org_n", "dir", "pout")),
    )
    for index, (zoom, names) in enumerate(zooms):
        shown = traces(outputs, initial, stimulus, names)
        run = Run("", "", clk_hz, recording.end, shown, [], [], [], row_scale=7 / len(names))
        close_up(figure.add_subplot(below[index]), run, zoom, "ABC"[index])
    title = "PPMC-312: three kinds of ramps, changes in motion, zero return"
    figure.text(0.055, 0.978, title, fontsize=16, fontweight="bold", color=INK, va="center")
    figure.text(0.055, 0.955, subtitle(comparison, clk_hz), fontsize=10, color=GREY, va="center")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)


VIEW = View(
    split={"auxo_n": [f"auxo{n}_n" for n in range(6)], "auxi": [f"auxi{n}" for n in range(8)]},
    motors={"motor": "pout"},
    groups=signals(
        host="host.access cs_n rs we_n oe_n d_i d_o d_oe irq_n",
        motor="motor.speed_pps motor.pulses pout dir cd_n",
        switches="evt0_n org_n fl_n bl_n run alm_n",
    ),
    pulses=rises,
    access=register_text,
)

DEMO = Demo(
    name="ppmc312",
    part="ppmc312",
    module="cocotb_tests.ppmc312.demo",
    test="demo_blocks",
    words=Ppmc312Decoder(),
    view=VIEW,
    marks=("free", "sigmoid", "linear", "override", "return"),
    own=draw,
)
