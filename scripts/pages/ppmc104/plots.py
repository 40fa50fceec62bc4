"""Plots of docs/ppmc104/, computed with the golden model's ramp: rates, profiles, forced deceleration."""

from __future__ import annotations

from collections.abc import Callable

import matplotlib.pyplot as plt

from openppmc.model.motion.ramp import Ramp, index_profile
from scripts.pages.pictures.plots import BLUE, GREEN, RED, svg
from scripts.pages.pictures.ramps import draw, ramps
from scripts.pages.pictures.ramps import forced as forced_moves

CSEL_L = 125_000  # Hz, the base clock used in the speed plots of the small ramp
SMALL = Ramp(19, 9, 10)  # the ramp of P104-EX-04
LARGE = Ramp(199, 49, 100)  # the ramp of P104-EX-03


def ramp() -> bytes:
    """Draw the ramps of P104-EX-04 and P104-EX-03."""
    return ramps(SMALL, LARGE, (8, 21), 11)


def profile() -> bytes:
    """Draw trapezoidal and triangular profiles of the small ramp over pulses and time (P104-PRO-01…03)."""
    figure, both = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained", sharey=True)
    moves = ((40, BLUE, "N = 40, trapezoid"), (16, RED, "N = 16, one peak"), (9, GREEN, "N = 9, two peaks"))
    for axes, over_time in zip(both, (False, True), strict=True):
        for pulses, color, label in moves:
            draw(axes, index_profile(pulses, SMALL.pa), over_time, color, label, SMALL, CSEL_L)
    both[0].set(title="Over pulses", xlabel="pulse", ylabel="kpps (125 kHz base clock)", ylim=(0, 14.5))
    both[1].set(title="Over time", xlabel="ms after pulse 1")
    both[0].legend(loc="lower right")
    return svg(figure)


def forced() -> bytes:
    """Draw forced decelerations flagged in interval 4 and at constant speed (P104-EX-04 a and c)."""
    cases = {4: "4 + 1 + 3 = 8 pulses", 29: "29 + 1 + 10 = 40 pulses"}
    return forced_moves(SMALL, CSEL_L, cases, 14.5, 50, stops_at_rl=False)


PLOTS: dict[str, Callable[[], bytes]] = {"ramp": ramp, "profile": profile, "forced": forced}
