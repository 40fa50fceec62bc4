"""Plots of docs/ppmc2104/, computed with the golden model's ramp: rates, forced deceleration, two axes."""

from __future__ import annotations

from collections.abc import Callable

import matplotlib.pyplot as plt

from openppmc.model.motion.ramp import Ramp, index_profile
from scripts.pages.pictures.plots import BLUE, RED, svg
from scripts.pages.pictures.ramps import HIGH, draw, ramps, title
from scripts.pages.pictures.ramps import forced as forced_moves

RAMP = Ramp(99, 19, 10)  # the ramp of P2104-EX-01
PAIR = ((Ramp(127, 39, 200), 1000), (Ramp(255, 79, 100), 500))  # the coordinated move of the demo


def ramp() -> bytes:
    """Draw the ramp of P2104-EX-01 and that of the demo."""
    return ramps(RAMP, PAIR[0][0], (0, 110), 14)


def forced() -> bytes:
    """Draw decelerations: in the ramp, at constant and at start-up speed (P2104-EX-03, -EX-04, -FDC-02)."""
    cases = {5: "5 + 1 + 4 = 10 pulses", 20: "20 + 1 + 10 = 31 pulses", 1: "stops immediately, 1 pulse"}
    return forced_moves(RAMP, HIGH, cases, 29, 54, stops_at_rl=True)


def pair() -> bytes:
    """Draw two axes that start together and need the same time."""
    figure, axes = plt.subplots(figsize=(9.2, 3.2), layout="constrained")
    for number, ((of, pulses), color) in enumerate(zip(PAIR, (BLUE, RED), strict=True), 1):
        text = f"axis {number}: {pulses} pulses, {title('ramp', of)[6:]}"
        draw(axes, index_profile(pulses, of.pa), True, color, text, of, HIGH)
    axes.set(title="A straight line: half the pulses, half the speed, half the ramp")
    axes.set(xlabel="ms after pulse 1", ylabel="kpps", ylim=(0, 14.5))
    axes.legend(loc="lower center")
    return svg(figure)


PLOTS: dict[str, Callable[[], bytes]] = {"ramp": ramp, "forced": forced, "pair": pair}
