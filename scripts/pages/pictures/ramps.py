"""Plots of ramps that parts with a rate register share: rates, profiles, forced deceleration."""

from __future__ import annotations

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from openppmc.model.motion.ramp import Ramp, index_profile
from scripts.pages.pictures.plots import BLUE, GREEN, GREY, RED, exact_period, svg

HIGH = 500_000
"""The faster internal base clock in Hz."""


def kpps(rate: int, base_hz: int) -> float:
    """Return the speed at a rate in kpps."""
    return base_hz / (rate + 1) / 1000


def ramps(small: Ramp, large: Ramp, rates: tuple[int, int], top: float) -> bytes:
    """Draw R(k) of a short ramp with the exact curve, and the speed of a long ramp.

    `rates` and `top` (kpps) are the ends of the two vertical axes.
    """
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained")
    index = range(small.pa + 1)
    fine = [step / 20 for step in range(small.pa * 20 + 1)]
    left.plot(fine, [exact_period(small, k) - 1 for k in fine], color=GREY, lw=1, label="x(k) - 1, exact")
    left.plot(index, small.rates(), "o", color=BLUE, ms=5, label="R(k), rounded")
    for k in index:
        left.annotate(str(small.rate(k)), (k, small.rate(k)), (0, 6), textcoords="offset points", ha="center")
    left.set(title=title("Rates", small), xlabel="ramp index k", ylabel="rate", ylim=rates)
    left.legend()
    index = range(large.pa + 1)
    exact = [HIGH / exact_period(large, k) / 1000 for k in index]
    right.plot(index, exact, color=GREY, lw=1, label="constant acceleration")
    speeds = [kpps(large.rate(k), HIGH) for k in index]
    right.step(index, speeds, where="mid", color=BLUE, lw=1.2, label="500 kHz / (R(k) + 1)")
    right.set(title=title("Speed", large), xlabel="ramp index k", ylabel="kpps", ylim=(0, top))
    right.legend()
    return svg(figure)


def title(what: str, of: Ramp) -> str:
    """Return the title of a plot about a ramp."""
    return f"{what}: RL = {of.rl}, RH = {of.rh}, PA = {of.pa}"


def draw(
    axes: Axes,
    indices: list[int],
    over_time: bool,
    color: str,
    label: str,
    of: Ramp,
    base_hz: int,
) -> None:
    """Draw the speed of each interval as a staircase over pulse numbers or over ms."""
    rates = [of.rate(k) for k in indices]
    edges = [0.0]
    for number, rate in enumerate(rates, 2):
        edges.append(edges[-1] + (rate + 1) / base_hz * 1000 if over_time else number)
    if not over_time:
        edges[0] = 1
    axes.stairs(
        [kpps(rate, base_hz) for rate in rates], edges, baseline=None, color=color, lw=1.5, label=label
    )


def forced(of: Ramp, base_hz: int, cases: dict[int, str], top: float, last: int, stops_at_rl: bool) -> bytes:
    """Draw forced decelerations of a long move.

    `top` (kpps) and `last` (pulse) are the ends of the axes.

    Args:
        cases: interval of the flag -> explanation.
        stops_at_rl: True if no pulse follows at rate RL.
    """
    figure, axes = plt.subplots(figsize=(9.2, 3.2), layout="constrained")
    draw(axes, index_profile(3 * last, of.pa)[: last - 1], False, GREY, "undisturbed", of, base_hz)
    for (interval, text), color in zip(cases.items(), (RED, BLUE, GREEN), strict=False):
        indices = index_profile(3 * last, of.pa, flagged_in=interval)
        speed = kpps(of.rate(indices[interval - 1]), base_hz)
        if stops_at_rl and of.rate(indices[interval - 1]) == of.rl:
            indices = indices[: interval - 1]
        draw(axes, indices, False, color, f"flagged in I({interval}): {text}", of, base_hz)
        axes.plot([interval + 0.5], [speed], "v", color=color, ms=8)
        axes.plot([len(indices) + 1], [kpps(of.rl, base_hz)], "s", color=color, ms=5)
    axes.set(title=f"{title('Forced deceleration', of)} (triangle: flag, square: last pulse)")
    clock = f"{base_hz // 1000} kHz base clock"
    axes.set(xlabel="pulse", ylabel=f"kpps ({clock})", ylim=(0, top), xlim=(0, last + 1))
    axes.legend(loc="lower right")
    return svg(figure)
