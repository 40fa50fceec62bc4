"""Plots of docs/stmc/README.md: moves of the golden model, from its pins."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import accumulate

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from openppmc.model.stmc.commands import profile
from scripts.pages.pictures.plots import BLUE, GREEN, GREY, RED, exact_period, svg
from scripts.pages.stmc.bench import little
from scripts.pages.stmc.tables import BOARD_HZ, CASES, INTERNAL_HZ, LONG_RAMP, STANDARD, Case, play

COLOURS = (BLUE, RED, GREEN)


def _case(name: str) -> Case:
    """Return the first worked move with this number."""
    return next(case for case in CASES if case.name == name)


def _title(what: str, ramp: tuple[int, int, int]) -> str:
    return f"{what}: D1 = {ramp[0]}, D2 = {ramp[1]}, PA = {ramp[2]}"


def _stairs(axes: Axes, gaps: list[int], over_time: bool, colour: str, label: str) -> None:
    """Draw the speed of each gap at 12.5 kHz, over step numbers or over ms."""
    edges = [ticks / INTERNAL_HZ * 1000 for ticks in accumulate(gaps, initial=0)]
    where = edges if over_time else list(range(len(gaps) + 1))
    speeds = [INTERNAL_HZ / gap for gap in gaps]
    axes.stairs(speeds, where, baseline=None, color=colour, lw=1.5, label=label)


def ramp() -> bytes:
    """Draw the levels of a short ramp, and the speed of the ramp in the data sheet."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained")
    slow, fast, count = STANDARD
    levels = range(count + 1)
    fine = [step / 20 for step in range(count * 20 + 1)]
    of = profile(*STANDARD)
    left.plot(fine, [exact_period(of, k) for k in fine], color=GREY, lw=1, label="exact")
    left.plot(levels, [rate + 1 for rate in of.rates()], "o", color=BLUE, ms=5, label="x(k), rounded")
    for k in levels:
        left.annotate(
            f"{of.rate(k) + 1}", (k, of.rate(k) + 1), (0, 6), textcoords="offset points", ha="center"
        )
    left.set(title=_title("Divisors", STANDARD), xlabel="level k", ylabel="divisor", ylim=(0, slow + 3))
    left.legend()
    long = profile(*LONG_RAMP)
    levels = range(long.pa + 1)
    right.plot(levels, [BOARD_HZ / exact_period(long, k) for k in levels], color=GREY, lw=1,
               label="constant acceleration")  # fmt: skip
    speeds = [BOARD_HZ / (rate + 1) for rate in long.rates()]
    right.step(levels, speeds, where="mid", color=BLUE, lw=1.2, label="48 675 Hz / x(k)")
    right.set(title=_title("Speed", LONG_RAMP), xlabel="level k", ylabel="steps/s", ylim=(0, 900))
    right.legend(loc="lower right")
    return svg(figure)


def moves() -> bytes:
    """Draw trapezoidal and triangular profiles: W1, W2, W3."""
    figure, both = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained", sharey=True)
    cases = (("W1", "trapezoid"), ("W2", "triangle, one top gap"), ("W3", "triangle, two top gaps"))
    for axes, over_time in zip(both, (False, True), strict=True):
        for (name, shape), colour in zip(cases, COLOURS, strict=True):
            made = play(_case(name))
            _stairs(axes, made.gaps, over_time, colour, f"{name}: {len(made.steps)} steps, {shape}")
    both[0].set_xticks(range(0, 20, 2))
    both[0].set(title="Over steps", xlabel="step", ylabel="steps/s at 12.5 kHz", ylim=(0, 2700))
    both[1].set(title="Over time", xlabel="ms after step 0")
    both[0].legend(loc="lower center", fontsize=8)
    return svg(figure)


def slowed() -> bytes:
    """Draw command 1 in the ramp, at top speed, and in gap 0: W14, W15, W17."""
    figure, axes = plt.subplots(figsize=(9.2, 3.2), layout="constrained")
    plain = replace(_case("W14"), data=little(99), gap=None, act=None)
    _stairs(axes, play(plain).gaps[:30], False, GREY, "undisturbed")
    for name, colour in zip(("W14", "W15", "W17"), (RED, BLUE, GREEN), strict=True):
        case = _case(name)
        made = play(case)
        gap = case.gap or 0
        count = len(made.steps)
        text = f"{name}, in gap {gap}: {count} step{'s' if count > 1 else ''}"
        running = INTERNAL_HZ / (made.gaps[gap] if gap < len(made.gaps) else STANDARD[0])
        if made.gaps:
            _stairs(axes, made.gaps, False, colour, text)
        axes.plot([gap + 0.5], [running], "v", color=colour, ms=8, label=None if made.gaps else text)
        axes.plot([count - 1], [INTERNAL_HZ / STANDARD[0]], "s", color=colour, ms=5)
    axes.set(title=_title("Command 1", STANDARD) + " (triangle: command, square: last step)")
    axes.set(xlabel="step", ylabel="steps/s at 12.5 kHz", ylim=(0, 2700), xlim=(-0.6, 30))
    axes.legend(loc="lower right")
    return svg(figure)


PLOTS: dict[str, Callable[[], bytes]] = {"ramp": ramp, "moves": moves, "slowed": slowed}
