"""`make demo PART=pmc006`: the demo's test, the text of bus accesses, waveforms and picture."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import nan
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from cocotb_tests.pmc006.demo_program import BUILD, FINE, LEAD, MOTOR, MOVES, WAY
from openppmc.capture.pmc006.mnemonics import Pmc006Decoder
from openppmc.model.pmc006.bench.motor import BRIDGES, Winding
from openppmc.plot.motion import GREY, INK, PALE, bare
from scripts.demo.demos import Demo, View, signals
from scripts.demo.scenes import Changes, bit, frame_text, heading, pin, rises, subtitle

PHASES = {"a": "#0b6fb8", "b": "#c26a1b"}
REFERENCE, SWITCH, LAMP = "#6b7785", "#8c2d62", "#2f9e6e"
FULL_STEP = 128
"""One full step in units of the electrical angle."""
LOOKED = tuple(dict.fromkeys(name for pins in BRIDGES.values() for name in pins[:-1]))
By = Mapping[str, Mapping[str, Any]]


CHOPPER = (
    "m10, m11: half bridges, high = the supply\n"
    "cmp_a high: the current (blue) has reached its reference (grey)"
)


class Motor:
    """Both windings, simulated with the recorded levels of the half bridges up to edge `end`."""

    def __init__(self, comparison: Any, end: int) -> None:
        self.hz = int(comparison.recording.params["CLK_HZ"])
        self.windings = {name: Winding(MOTOR, name, 0.0, 0.0) for name in BRIDGES}
        levels = {name: comparison.initial[name] for name in LOOKED}
        changes = sorted(
            (t, name, value) for name in LOOKED for t, value in comparison.actual[name] if t < end
        )
        for (t, name, value), (after, *_) in pairwise([*changes, (end, "", 0)]):
            levels[name] = value
            if after != t:
                for winding in self.windings.values():
                    winding.on_outputs(t / self.hz, levels)

    def curve(self, name: str, begin: int, end: int, count: int = 1500) -> list[tuple[int, float, float]]:
        """Return `count` samples (edge, current in A, reference in A)."""
        winding = self.windings[name]
        edges = [begin + (end - begin) * n // (count - 1) for n in range(count)]
        return [(t, winding.current(t / self.hz), winding.reference(t / self.hz)) for t in edges]


class Step(NamedTuple):
    """A step at edge `t`: position in full steps, speed in full steps/s (nan at a motion's first step)."""

    t: int
    place: float
    speed: float


def way(steps: Sequence[int], forward: Changes, chapters: By, hz: int) -> list[Step]:
    """Return the position and the speed of the motor at each step."""
    fine = {f"move{micro}": micro for micro, _ in MOVES} | {"program": FINE}
    begins = sorted((chapters[key]["begin"], micro) for key, micro in fine.items())
    turns, found = [(0, 1), *forward], []
    place, before, last = 0.0, 0, 0
    for t in steps:
        micro = begins[bisect_right(begins, (t, 0)) - 1][1]
        sign = 1 if turns[bisect_right(turns, (t, 2)) - 1][1] else -1
        place += sign / micro
        rested = t - before > hz // 50 or sign != last
        found.append(Step(t, place, nan if rested else hz / (t - before) / micro))
        before, last = t, sign
    return found


def overview(axes: Axes, steps: Sequence[Step], comparison: Any, by_key: By, ms: float) -> None:
    """Draw position and speed for the whole demo, with the levels of the switch and the output."""
    speed = axes.twinx()
    xs = [step.t / ms for step in steps]
    speed.plot(xs, [step.speed for step in steps], color=PALE, linewidth=1.1, zorder=1)
    speed.set_ylim(0, 1500)
    axes.set_zorder(speed.get_zorder() + 1)
    axes.patch.set_visible(False)
    axes.plot(xs, [step.place for step in steps], color=INK, linewidth=1.8)
    axes.axhline(-LEAD, color=SWITCH, linewidth=0.8, linestyle=":")
    for chapter in by_key.values():
        if chapter["key"] != "set":
            axes.axvline(chapter["begin"] / ms, color=PALE, linewidth=0.8)
            y = 86 if chapter["key"] == "load" else 79
            axes.text(chapter["begin"] / ms + 6, y, chapter["title"], fontsize=9, color=INK)
    end = comparison.recording.end
    switch = [(t, 1 - level) for t, level in pin(comparison.recording.stimulus, "ext1")]
    for changes, colour, y, label in (
        (switch, SWITCH, -31, "EXT1: on the switch"),
        (bit(comparison.actual["gpo"], 0), LAMP, -38, "GPO1: homed, shuttling"),
        (bit(comparison.actual["gpo"], 1), LAMP, -45, "GPO2: at the far end"),
    ):  # fmt: skip
        for (t, level), (after, _) in pairwise([*changes, (end, 0)]):
            if level:
                axes.broken_barh([(t / ms, (after - t) / ms)], (y, 4.5), color=colour)
        axes.text(
            by_key["load"]["begin"] / ms - 8,
            y + 2,
            label,
            fontsize=8.5,
            color=colour,
            ha="right",
            va="center",
        )
    axes.set_ylim(-50, 95)
    axes.set_yticks([-LEAD, 0, 30, WAY])
    for each in (axes, speed):
        bare(each)
        each.set_xlim(0, end / ms)
    speed.set_yticks([0, 300, 500])
    speed.set_ylabel("full steps/s (grey)", fontsize=9, color=GREY, loc="bottom")
    axes.set_ylabel("full steps from the start", fontsize=9, color=GREY)
    axes.set_xlabel("ms", fontsize=9, color=GREY, labelpad=1)
    heading(axes, "Three equal moves over the line, then a program that homes and shuttles without a host")


def currents(axes: Axes, motor: Motor, begin: int, end: int, title: str, references: bool) -> None:
    """Draw both phases from `begin` to `end`."""
    scale = motor.hz / 1000
    for name, colour in PHASES.items():
        rows = motor.curve(name, begin, end)
        xs = [(t - begin) / scale for t, *_ in rows]
        axes.plot(xs, [now for _, now, _ in rows], color=colour, linewidth=1.2, label=f"phase {name.upper()}")
        if references:
            axes.step(xs, [to for *_, to in rows], where="post", color=REFERENCE, linewidth=0.9, zorder=1)
    bare(axes)
    axes.grid(axis="y", color=PALE, linewidth=0.8)
    axes.set_ylim(-1.75, 1.75)
    axes.set_xlim(0, (end - begin) / scale)
    heading(axes, title)
    axes.set_xlabel("ms", fontsize=9, color=GREY, labelpad=1)


def cycle(steps: Sequence[Step], chapter: Mapping[str, Any]) -> tuple[int, int]:
    """Return the first and the last edge of four full steps in the middle of a move."""
    inside = [step for step in steps if chapter["begin"] <= step.t < chapter["end"]]
    low = min(inside[0].place, inside[-1].place)
    middle = [step for step in inside if abs(step.place - low - WAY / 2) <= 2.001]
    return middle[0].t, middle[-1].t


def chopper(axes: Axes, motor: Motor, comparison: Any, begin: int) -> None:
    """Draw the current of phase A, its reference, and the half bridges."""
    us, end = motor.hz / 1e6, begin + motor.hz // 1800
    rows = motor.curve("a", begin, end, 3000)
    xs = [(t - begin) / us for t, *_ in rows]
    axes.plot(xs, [now for _, now, _ in rows], color=PHASES["a"], linewidth=1.2)
    axes.step(xs, [to for *_, to in rows], where="post", color=REFERENCE, linewidth=1.0)
    values = [value for _, *pair in rows for value in pair]
    low, high = min(values), max(values)
    span = high - low
    for row, name in enumerate(("m10", "m11", "cmp_a")):
        changes = comparison.actual.get(name) or pin(comparison.recording.stimulus, name)
        base, level = low - span * (0.35 + 0.3 * row), 0
        times, levels = [begin], []
        for t, value in changes:
            if t <= begin:
                level = value
            elif t < end:
                levels.append(level)
                times.append(t)
                level = value
        ys = [base + 0.2 * span * value for value in [*levels, level, level]]
        axes.step([(t - begin) / us for t in [*times, end]], ys, where="post", color=INK, linewidth=1.0)
        axes.text(-6, base + 0.1 * span, name, fontsize=8.5, color=INK, ha="right", va="center")
    bare(axes)
    axes.set_xlim(0, (end - begin) / us)
    axes.set_ylim(low - 1.1 * span, high + 0.1 * span)
    axes.set_yticks([round(low, 2), round(high, 2)])
    axes.set_xlabel("µs", fontsize=9, color=GREY, labelpad=1)
    heading(axes, "The chopper of phase A")
    axes.text(1, -0.16, CHOPPER, transform=axes.transAxes, fontsize=8.5, color=GREY, ha="right", va="top")


def draw(comparison: Any, chapters: Sequence[Mapping[str, Any]], path: Path) -> None:
    """Draw the picture of the compared recording into a PNG."""
    hz = int(comparison.recording.params["CLK_HZ"])
    by_key: By = {chapter["key"]: chapter for chapter in chapters}
    motor = Motor(comparison, by_key["load"]["begin"])
    steps = way(rises(list(comparison.actual["mon_step"])), list(comparison.actual["mon_dir"]), by_key, hz)
    plt.rcParams["font.family"] = "DejaVu Sans"
    figure = plt.figure(figsize=(16, 13), dpi=110, facecolor="white")
    rows = figure.add_gridspec(
        3, 1, height_ratios=(3.6, 2.4, 2.8), hspace=0.34, left=0.055, right=0.945, top=0.92, bottom=0.07
    )
    overview(figure.add_subplot(rows[0]), steps, comparison, by_key, hz / 1000)
    keys = [f"move{micro}" for micro, _ in MOVES]
    first = by_key[keys[1]]
    middle = figure.add_subplot(rows[1])
    currents(
        middle, motor, first["begin"], first["end"], f"Phase currents: {first['title']}", references=False
    )
    # The legend is next to the title, because the curves fill their axes.
    middle.legend(
        loc="lower right",
        bbox_to_anchor=(1, 0.98),
        frameon=False,
        fontsize=9,
        labelcolor=INK,
        ncols=2,
        borderaxespad=0,
    )
    middle.set_ylabel("A", fontsize=9, color=GREY)
    below = rows[2].subgridspec(1, 4, wspace=0.22)
    for place, (key, (micro, _)) in enumerate(zip(keys, MOVES, strict=True)):
        begin, end = cycle(steps, by_key[key])
        currents(
            figure.add_subplot(below[place]),
            motor,
            begin,
            end,
            f"One cycle, {micro} microsteps",
            references=True,
        )
    begin, end = cycle(steps, by_key[keys[2]])
    chopper(figure.add_subplot(below[3]), motor, comparison, begin + (end - begin) // 8)
    title = "PMC006B4: S-curves in microsteps, regulated currents, a program without a host"
    figure.text(0.055, 0.978, title, fontsize=16, fontweight="bold", color=INK, va="center")
    note = subtitle(comparison, hz).replace(" Pins with * are active low.", "")
    note += f" Motor: {MOTOR.ohm:g} Ω, {MOTOR.henry * 1e3:g} mH, {MOTOR.volt:g} V."
    figure.text(0.055, 0.957, note, fontsize=10, color=GREY, va="center")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)


VIEW = View(
    split={"gpo": [f"gpo{n}" for n in range(1, 6)], "gpi": [f"gpi{n}" for n in range(1, 6)]},
    motors={"motor": "mon_step"},
    groups=signals(
        line="host.access rxd txd de",
        motor="motor.speed_pps motor.pulses mon_step mon_dir mon_busy",
        currents="phase_a_ref phase_a_sign phase_b_ref phase_b_sign",
        bridges="bridge_a_en m10 m11 cmp_a bridge_b_en m20 m21 cmp_b",
        ports="ext1 gpo1 gpo2",
    ),
    pulses=rises,
    access=frame_text,
)

DEMO = Demo(
    name="pmc006",
    part="pmc006",
    module="cocotb_tests.pmc006.demo",
    test="demo_program",
    words=Pmc006Decoder(),
    view=VIEW,
    marks=("move4", "move16", "move32", "program"),
    own=draw,
    config=BUILD,
)
