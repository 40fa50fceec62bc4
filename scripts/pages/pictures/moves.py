"""Kinds of plots that show the speed of moves: moves in panels, ramps, forced deceleration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from openppmc.model.motion.ramp import Ramp, index_profile
from scripts.pages.pictures.kinds import made
from scripts.pages.pictures.plots import BLUE, COLOURS, GREY, exact_period

Entry = dict[str, Any]


@dataclass(frozen=True)
class Train:
    """Pulses of a move: the number of ticks in each interval, and the ticks per second.

    Attributes:
        first: number of the first pulse.
        cause: interval in which the move was changed, counted from 0. A triangle marks the speed of this
        interval.
        slowest: ticks of an interval at start-up speed. If it is given, a square marks the last pulse.
    """

    intervals: Sequence[int]
    hz: int
    first: int = 1
    cause: int | None = None
    slowest: int | None = None


def ramped(
    ramp: Sequence[int], hz: int, pulses: int, flagged_in: int | None = None, shown: int | None = None
) -> Train:
    """Return a move with a ramp (RL, RH, PA) of a base clock, and with a forced deceleration.

    Args:
        flagged_in: interval in which the deceleration is flagged, counted from 1.
        shown: number of intervals to show.
    """
    of = Ramp(*ramp)
    ticks = [of.rate(k) + 1 for k in index_profile(pulses, of.pa, flagged_in)][:shown]
    return Train(ticks, hz) if flagged_in is None else Train(ticks, hz, 1, flagged_in - 1, of.rl + 1)


def speeds(axes: Axes, train: Train, entry: Entry, over: str, unit: int, line: bool) -> None:
    """Draw the speed of each interval over ms or over the pulse number, as stairs or as a line."""
    colour = COLOURS[entry["colour"]]
    times = [ticks / (train.hz / 1000) for ticks in accumulate(train.intervals, initial=0)]
    edges = times if over == "time" else [train.first + n for n in range(len(times))]
    found = [train.hz / unit / ticks for ticks in train.intervals]
    if line:
        middles = [(begin + end) / 2 for begin, end in pairwise(edges)]
        axes.plot(middles, found, color=colour, lw=1.3, label=entry["label"])
    elif "label" in entry:
        axes.stairs(found, edges, baseline=None, color=colour, lw=1.5, label=entry["label"])
    if train.cause is not None:
        at = edges[0] + train.cause + 0.5 if over == "pulses" else edges[train.cause]
        ticks = (*train.intervals, train.slowest or 0)[train.cause]
        axes.plot([at], [train.hz / ticks / unit], "v", color=colour, ms=8, label=entry.get("mark"))
    if train.slowest:
        axes.plot([edges[-1]], [train.hz / train.slowest / unit], "s", color=colour, ms=5)


def moves(
    panels: Sequence[Entry], height: float = 3.3, sharey: bool = False, unit: int = 1000, line: bool = False
) -> Figure:
    """Draw panels side by side, each with the speeds of several moves.

    Args:
        panels: each with `axes` and `legend` (arguments of matplotlib), `over` (time or pulses), and `moves`.
            A move has `colour`, `label`, a `kind` that returns its Train, and the arguments of the kind.
            A move of one pulse has `mark` instead of `label`; of such a move, only the triangle is drawn.
        unit: number of pulses per second that is one unit of the vertical axis.
        line: True to draw a line through the middles of the intervals instead of stairs.
    """
    figure, (row,) = plt.subplots(
        1, len(panels), figsize=(9.2, height), layout="constrained", sharey=sharey, squeeze=False
    )
    for axes, panel in zip(row, panels, strict=True):
        for entry in panel["moves"]:
            rest = {name: value for name, value in entry.items() if name not in ("colour", "label", "mark")}
            speeds(axes, made(rest), entry, panel.get("over", "time"), unit, line)
        axes.set(**panel["axes"])
        if "legend" in panel:
            axes.legend(**panel["legend"])
    return figure


def ramps(small: Entry, large: Entry, offset: int = 1, unit: int = 1000) -> Figure:
    """Draw the intervals of a short ramp together with the exact curve, and the speed of a long ramp.

    Args:
        small: `ramp` (RL, RH, PA), `labels` of the two curves, `axes`, `legend` (arguments of matplotlib).
        large: the same entries as `small`, and the base clock `hz`.
        offset: 1 to show intervals as rates, 0 to show them in periods of the base clock.
        unit: number of pulses per second that is one unit of the right vertical axis.
    """
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained")
    of = Ramp(*small["ramp"])
    fine = [step / 20 for step in range(of.pa * 20 + 1)]
    values = [rate + 1 - offset for rate in of.rates()]
    exact, rounded = small["labels"]
    left.plot(fine, [exact_period(of, k) - offset for k in fine], color=GREY, lw=1, label=exact)
    left.plot(range(of.pa + 1), values, "o", color=BLUE, ms=5, label=rounded)
    for k, value in enumerate(values):
        left.annotate(str(value), (k, value), (0, 6), textcoords="offset points", ha="center")
    of, hz = Ramp(*large["ramp"]), large["hz"]
    index = range(of.pa + 1)
    exact, rounded = large["labels"]
    right.plot(index, [hz / exact_period(of, k) / unit for k in index], color=GREY, lw=1, label=exact)
    speeds = [hz / (rate + 1) / unit for rate in of.rates()]
    right.step(index, speeds, where="mid", color=BLUE, lw=1.2, label=rounded)
    for axes, entry in ((left, small), (right, large)):
        axes.set(**entry["axes"])
        axes.legend(**entry.get("legend", {}))
    return figure
