"""Plots of the manual, computed with the golden model's ramp: rates, profiles, forced deceleration."""

from __future__ import annotations

import io
from collections.abc import Callable
from math import sqrt

import matplotlib

matplotlib.use("svg")

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from openppmc.model.ramp import Ramp, index_profile

# Everything that would make two runs differ is fixed: ids, date, fonts as outlines.
STYLE = {
    "svg.hashsalt": "openppmc",
    "svg.fonttype": "path",
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "savefig.facecolor": "white",
}
BLUE, RED, GREEN, GREY = "#1f5fa8", "#c23b22", "#2b8a3e", "#888888"
CSEL_L = 125_000  # Hz, the base clock used in the speed plots of the small ramp
CSEL_H = 500_000
SMALL = Ramp(19, 9, 10)  # the ramp of P104-EX-04
LARGE = Ramp(199, 49, 100)  # the ramp of P104-EX-03


def _exact(of: Ramp, k: float) -> float:
    """x(k) of the ramp formula, in base clocks, not rounded."""
    a, b = (of.rl + 1) ** 2, (of.rh + 1) ** 2
    return 1 / sqrt(1 / a + (1 / b - 1 / a) * k / of.pa)


def _kpps(rate: int, base_hz: int) -> float:
    return base_hz / (rate + 1) / 1000


def _svg(figure: Figure) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    return buffer.getvalue()


def ramp() -> bytes:
    """R(k) of a short ramp as a staircase beside the exact curve, and the speed of a long one."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained")
    index = range(SMALL.pa + 1)
    fine = [step / 20 for step in range(SMALL.pa * 20 + 1)]
    left.plot(fine, [_exact(SMALL, k) - 1 for k in fine], color=GREY, lw=1, label="x(k) - 1, exact")
    left.plot(index, SMALL.rates(), "o", color=BLUE, ms=5, label="R(k), rounded")
    for k in index:
        left.annotate(str(SMALL.rate(k)), (k, SMALL.rate(k)), (0, 6), textcoords="offset points", ha="center")
    left.set(title="Rates: RL = 19, RH = 9, PA = 10", xlabel="ramp index k", ylabel="rate", ylim=(8, 21))
    left.legend()
    index = range(LARGE.pa + 1)
    exact = [CSEL_H / _exact(LARGE, k) / 1000 for k in index]
    right.plot(index, exact, color=GREY, lw=1, label="constant acceleration")
    speeds = [_kpps(LARGE.rate(k), CSEL_H) for k in index]
    right.step(index, speeds, where="mid", color=BLUE, lw=1.2, label="500 kHz / (R(k) + 1)")
    right.set(title="Speed: RL = 199, RH = 49, PA = 100", xlabel="ramp index k", ylabel="kpps", ylim=(0, 11))
    right.legend()
    return _svg(figure)


def _draw(axes: Axes, indices: list[int], over_time: bool, color: str, label: str) -> None:
    """Speed of each interval, as a staircase over pulse numbers or over ms."""
    rates = [SMALL.rate(k) for k in indices]
    edges = [0.0]
    for number, rate in enumerate(rates, 2):
        edges.append(edges[-1] + (rate + 1) / CSEL_L * 1000 if over_time else number)
    if not over_time:
        edges[0] = 1
    axes.stairs(
        [_kpps(rate, CSEL_L) for rate in rates], edges, baseline=None, color=color, lw=1.5, label=label
    )


def profile() -> bytes:
    """Trapezoid and triangles of the small ramp over pulses and over time (P104-PRO-01…03)."""
    figure, both = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained", sharey=True)
    moves = ((40, BLUE, "N = 40, trapezoid"), (16, RED, "N = 16, one peak"), (9, GREEN, "N = 9, two peaks"))
    for axes, over_time in zip(both, (False, True), strict=True):
        for pulses, color, label in moves:
            _draw(axes, index_profile(pulses, SMALL.pa), over_time, color, label)
    both[0].set(title="Over pulses", xlabel="pulse", ylabel="kpps (125 kHz base clock)", ylim=(0, 14.5))
    both[1].set(title="Over time", xlabel="ms after pulse 1")
    both[0].legend(loc="lower right")
    return _svg(figure)


def forced() -> bytes:
    """Forced decelerations flagged in interval 4 and on the plateau (P104-EX-04 a and c)."""
    figure, axes = plt.subplots(figsize=(9.2, 3.2), layout="constrained")
    _draw(axes, index_profile(60, SMALL.pa)[:49], False, GREY, "undisturbed")
    cases = (
        (4, RED, "flagged in I(4): 4 + 1 + 3 = 8 pulses"),
        (29, BLUE, "flagged in I(29): 29 + 1 + 10 = 40 pulses"),
    )
    for interval, color, label in cases:
        indices = index_profile(60, SMALL.pa, flagged_in=interval)
        _draw(axes, indices, False, color, label)
        speed = _kpps(SMALL.rate(indices[interval - 1]), CSEL_L)
        axes.plot([interval + 0.5], [speed], "v", color=color, ms=8)
        axes.plot([len(indices) + 1], [_kpps(SMALL.rl, CSEL_L)], "s", color=color, ms=5)
    axes.set(title="Forced deceleration: RL = 19, RH = 9, PA = 10 (triangle: flag, square: last pulse)")
    axes.set(xlabel="pulse", ylabel="kpps (125 kHz base clock)", ylim=(0, 14.5), xlim=(0, 51))
    axes.legend(loc="lower right")
    return _svg(figure)


PLOTS: dict[str, Callable[[], bytes]] = {
    "ppmc104_ramp": ramp,
    "ppmc104_profile": profile,
    "ppmc104_forced": forced,
}


def render(name: str) -> bytes:
    """The SVG of one plot of `PLOTS`."""
    with matplotlib.rc_context(STYLE):
        return PLOTS[name]()
