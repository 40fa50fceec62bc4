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

from openppmc.model.motion.ramp import Ramp, index_profile

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
RAMP_B = Ramp(99, 19, 10)  # the ramp of P2104-EX-01
PAIR = ((Ramp(127, 39, 200), 1000), (Ramp(255, 79, 100), 500))  # the coordinated move of the demo


def exact_period(of: Ramp, k: float) -> float:
    """x(k) of the ramp formula, in base clocks, not rounded."""
    a, b = (of.rl + 1) ** 2, (of.rh + 1) ** 2
    return 1 / sqrt(1 / a + (1 / b - 1 / a) * k / of.pa)


def _kpps(rate: int, base_hz: int) -> float:
    return base_hz / (rate + 1) / 1000


def svg(figure: Figure) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    return buffer.getvalue()


def _ramps(small: Ramp, large: Ramp, rates: tuple[int, int], top: float) -> bytes:
    """R(k) of a short ramp as a staircase beside the exact curve, and the speed of a long one.

    `rates` and `top` (kpps) are the ends of the two vertical axes.
    """
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained")
    index = range(small.pa + 1)
    fine = [step / 20 for step in range(small.pa * 20 + 1)]
    left.plot(fine, [exact_period(small, k) - 1 for k in fine], color=GREY, lw=1, label="x(k) - 1, exact")
    left.plot(index, small.rates(), "o", color=BLUE, ms=5, label="R(k), rounded")
    for k in index:
        left.annotate(str(small.rate(k)), (k, small.rate(k)), (0, 6), textcoords="offset points", ha="center")
    left.set(title=_name("Rates", small), xlabel="ramp index k", ylabel="rate", ylim=rates)
    left.legend()
    index = range(large.pa + 1)
    exact = [CSEL_H / exact_period(large, k) / 1000 for k in index]
    right.plot(index, exact, color=GREY, lw=1, label="constant acceleration")
    speeds = [_kpps(large.rate(k), CSEL_H) for k in index]
    right.step(index, speeds, where="mid", color=BLUE, lw=1.2, label="500 kHz / (R(k) + 1)")
    right.set(title=_name("Speed", large), xlabel="ramp index k", ylabel="kpps", ylim=(0, top))
    right.legend()
    return svg(figure)


def _name(what: str, of: Ramp) -> str:
    return f"{what}: RL = {of.rl}, RH = {of.rh}, PA = {of.pa}"


def ramp() -> bytes:
    """The ramps of P104-EX-04 and P104-EX-03."""
    return _ramps(SMALL, LARGE, (8, 21), 11)


def ramp_2104() -> bytes:
    """The ramp of P2104-EX-01 and that of the demo."""
    return _ramps(RAMP_B, PAIR[0][0], (0, 110), 14)


def _draw(
    axes: Axes,
    indices: list[int],
    over_time: bool,
    color: str,
    label: str,
    of: Ramp = SMALL,
    base_hz: int = CSEL_L,
) -> None:
    """Speed of each interval, as a staircase over pulse numbers or over ms."""
    rates = [of.rate(k) for k in indices]
    edges = [0.0]
    for number, rate in enumerate(rates, 2):
        edges.append(edges[-1] + (rate + 1) / base_hz * 1000 if over_time else number)
    if not over_time:
        edges[0] = 1
    axes.stairs(
        [_kpps(rate, base_hz) for rate in rates], edges, baseline=None, color=color, lw=1.5, label=label
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
    return svg(figure)


def _forced(of: Ramp, base_hz: int, cases: dict[int, str], top: float, last: int, stops_at_rl: bool) -> bytes:
    """Forced decelerations of a long move, flagged in the intervals that `cases` names and explains.

    `top` (kpps) and `last` (pulse) are the ends of the axes. `stops_at_rl`: no pulse follows at rate RL.
    """
    figure, axes = plt.subplots(figsize=(9.2, 3.2), layout="constrained")
    _draw(axes, index_profile(3 * last, of.pa)[: last - 1], False, GREY, "undisturbed", of, base_hz)
    for (interval, text), color in zip(cases.items(), (RED, BLUE, GREEN), strict=False):
        indices = index_profile(3 * last, of.pa, flagged_in=interval)
        speed = _kpps(of.rate(indices[interval - 1]), base_hz)
        if stops_at_rl and of.rate(indices[interval - 1]) == of.rl:
            indices = indices[: interval - 1]
        _draw(axes, indices, False, color, f"flagged in I({interval}): {text}", of, base_hz)
        axes.plot([interval + 0.5], [speed], "v", color=color, ms=8)
        axes.plot([len(indices) + 1], [_kpps(of.rl, base_hz)], "s", color=color, ms=5)
    axes.set(title=f"{_name('Forced deceleration', of)} (triangle: flag, square: last pulse)")
    clock = f"{base_hz // 1000} kHz base clock"
    axes.set(xlabel="pulse", ylabel=f"kpps ({clock})", ylim=(0, top), xlim=(0, last + 1))
    axes.legend(loc="lower right")
    return svg(figure)


def forced() -> bytes:
    """Forced decelerations flagged in interval 4 and on the plateau (P104-EX-04 a and c)."""
    cases = {4: "4 + 1 + 3 = 8 pulses", 29: "29 + 1 + 10 = 40 pulses"}
    return _forced(SMALL, CSEL_L, cases, 14.5, 50, stops_at_rl=False)


def forced_2104() -> bytes:
    """Flagged in the ramp, on the plateau and at start-up speed (P2104-EX-03, P2104-EX-04, P2104-FDC-02)."""
    cases = {5: "5 + 1 + 4 = 10 pulses", 20: "20 + 1 + 10 = 31 pulses", 1: "stops at once, 1 pulse"}
    return _forced(RAMP_B, CSEL_H, cases, 29, 54, stops_at_rl=True)


def pair() -> bytes:
    """Two axes that start together and take the same time."""
    figure, axes = plt.subplots(figsize=(9.2, 3.2), layout="constrained")
    for number, ((of, pulses), color) in enumerate(zip(PAIR, (BLUE, RED), strict=True), 1):
        text = f"axis {number}: {pulses} pulses, {_name('ramp', of)[6:]}"
        _draw(axes, index_profile(pulses, of.pa), True, color, text, of, CSEL_H)
    axes.set(title="A straight line: half the pulses, half the speed, half the ramp")
    axes.set(xlabel="ms after pulse 1", ylabel="kpps", ylim=(0, 14.5))
    axes.legend(loc="lower center")
    return svg(figure)


PLOTS: dict[str, Callable[[], bytes]] = {
    "ppmc104/ramp": ramp,
    "ppmc104/profile": profile,
    "ppmc104/forced": forced,
    "ppmc2104/ramp": ramp_2104,
    "ppmc2104/forced": forced_2104,
    "ppmc2104/pair": pair,
}


def render(plot: Callable[[], bytes]) -> bytes:
    """The SVG of one plot, in the style of all."""
    with matplotlib.rc_context(STYLE):
        return plot()
