"""Phase currents of docs/pmc006/README.md, regulated by the golden model in the windings of a motor."""

from __future__ import annotations

from functools import cache

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from openppmc.model.pmc006.bench.currents import (
    Case,
    Waves,
    cruising,
    holding,
    residual_current,
    ripple,
    spectrum,
    wave_metrics,
)
from scripts.pages.pictures.plots import BLUE, GREEN, GREY, RED, svg

SHOWN = Case(cur=1000, mstep=16, full=1000, periods=1)
AGAINST = Case(cur=1000, mstep=16, full=1000, emf=6.0, periods=1)
REST_STEPS, REST_US = 4, 250
CURRENTS = (400, 1000, 1900)
SLOW = tuple(
    Case(mstep=mstep, full=full, scomp=300, periods=1) for mstep in (16, 2, 0) for full in (40, 100, 200)
)
"""P 300 has a lead of 0 units here, so that the angle includes the zeros of both references."""
RUNS = (
    *(Case(cur=cur, full=full, periods=1) for full in (500, 800, 1000) for cur in CURRENTS),
    *(Case(cur=cur, full=1000, emf=6.0, periods=1) for cur in CURRENTS),
)


@cache
def _cruise(case: Case) -> tuple[Waves, Waves]:
    return cruising(case)


def _currents(axes: Axes) -> None:
    """Draw both phases over an electrical cycle."""
    for found, colour, name in zip(_cruise(SHOWN), (BLUE, RED), "AB", strict=True):
        ms = [1000 * t for t in found.time]
        axes.plot(ms, found.reference, color=GREY, lw=0.8, label="reference" if name == "A" else None)
        axes.plot(ms, found.current, color=colour, lw=1, label=f"phase {name}")
    axes.set(title="1000 full steps/s in 1/16 steps, 1 A", xlabel="ms", ylabel="A", ylim=(-1.25, 1.75))
    axes.legend(loc="upper center", ncols=3, fontsize=8, handlelength=1, columnspacing=1)


def _rest(axes: Axes) -> None:
    """Draw the ripple at standstill: the difference between currents and references."""
    for found, colour, name in zip(holding(SHOWN, REST_STEPS, REST_US), (BLUE, RED), "AB", strict=True):
        us = [1e6 * t for t in found.time]
        off = [1000 * (a - b) for a, b in zip(found.current, found.reference, strict=True)]
        label = f"{name}: {found.reference[0]:.2f} A"
        axes.plot(us, off, color=colour, lw=1, label=label)
    axes.set(title="At standstill: deviation", xlabel="µs", ylabel="mA", ylim=(-25, 35))
    axes.legend(loc="upper center", ncols=2, fontsize=8, handlelength=1, columnspacing=1)


def _lines(axes: Axes) -> None:
    """Draw the harmonics of the current of phase A, relative to the fundamental."""
    for case, shift, colour, label in (
        (SHOWN, -0.2, BLUE, "no back EMF"),
        (AGAINST, 0.2, GREEN, "6 V of back EMF"),
    ):
        sizes = spectrum(_cruise(case)[0].current, case.periods)
        share = [100 * size / sizes[0] for size in sizes[1:]]
        axes.bar(
            [number + shift for number in range(2, len(sizes) + 1)], share, 0.4, color=colour, label=label
        )
    axes.set(title="Harmonics of phase A", xlabel="order", ylabel="% of the fundamental", xlim=(1, 41))
    axes.legend(loc="upper right", fontsize=8)


def currents() -> bytes:
    """Draw regulated currents: in motion, at standstill, and their spectrum."""
    figure, (left, middle, right) = plt.subplots(
        1, 3, figsize=(9.2, 3.3), layout="constrained", width_ratios=(5, 4, 4)
    )
    _currents(left)
    _rest(middle)
    _lines(right)
    return svg(figure)


def _percent(share: float) -> str:
    return f"{100 * share:.1f}"


def _left(both: tuple[Waves, Waves]) -> str:
    """Return the remaining current at a reference of 0, approached from above and from below."""
    if not any(0 in found.reference for found in both):
        return ""
    above, below = zip(*(residual_current(found) for found in both), strict=True)
    return f"{max(above):.2f}, {abs(min(below)):.2f}"


def currents_table() -> str:
    """Return a table: error and distortion in motion, remaining current at 0, then ripple at standstill."""
    lines = [
        "| Microsteps | Current / A | Full steps/s | Back EMF / V | Error / % | Beside / % | THD / % |"
        " Left at 0 / A |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for case in (*SLOW, *RUNS):
        both = _cruise(case)
        found = [wave_metrics(waves, case.periods) for waves in both]
        asked = f"{case.mstep or 1} | {found[0].amplitude:.2f} | {case.full} | {case.emf:.0f}"
        worst = [_percent(max(one[place] for one in found)) for place in (1, 2, 3)]
        lines.append(f"| {asked} | {' | '.join(worst)} | {_left(both)} |")
    words = []
    for cur in CURRENTS:
        found = holding(Case(cur=cur))[0]
        words.append(f"{1000 * ripple(found)[1]:.0f} mA at {found.reference[0]:.2f} A")
    rest = f"{', '.join(words[:-1])} and {words[-1]}"
    return "\n".join([*lines, "", f"Ripple of a phase at standstill, peak to peak: {rest}."])


PLOTS = {"currents": currents}
