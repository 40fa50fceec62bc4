"""Pictures of docs/bank/: the stages of a visit, and the cost of an axis."""

from __future__ import annotations

from collections.abc import Callable

import matplotlib.pyplot as plt

from scripts.measure.sizes import designs, figures, size_page
from scripts.pages.pictures.blocks import Arrow, Box, draw
from scripts.pages.pictures.plots import BLUE, GREEN, GREY, RED, svg

STAGES = (
    "0 address\nof the next axis",
    "1 RAM\nread its state",
    "2 compare\ncycles left < R ?",
    "3 plan\ndecisions",
    "4 update\nnew state",
    "5 write\nand command",
)
BOXES = {
    "bus": Box(0.35, 0, "host bus", "pin", 0.7, 0.4),
    "window": Box(6.1, 0, "ppmc_bank_window\ninput buffers, responses, registers of all axes", "host", 6.9),
    "scheduler": Box(0.32, 1.25, "ppmc_bank_scheduler\nvisited axis; GO,\nSTOP, reset", "plain", 1.95, 0.75),
    **{f"stage{n}": Box(2.1 + 1.4 * n, 1.25, text, "motion", 1.18) for n, text in enumerate(STAGES)},
    "state": Box(
        6.1,
        2.35,
        "block RAM\nstate of every axis · ramp tables, filled by one builder · lengths of intervals",
        "part",
        6.9,
    ),
    "motor_pins": Box(11.0, 1.25, "ppmc_bank_pins\none per axis;\ncommand, cycle", "motion", 1.45, 0.9),
    "switches": Box(11.0, 2.35, "limits, origin,\nalarm: every cycle", "pin", 1.25, 0.5),
    "pins": Box(12.5, 1.25, "pout_n, s,\ndir, hold", "pin", 0.9, 0.5),
}
ARROWS = (
    Arrow("bus", "window", both=True),
    Arrow("window", "stage1", "a byte", via=((3.5, 0.4), (3.5, 0.6))),
    Arrow("scheduler", "stage0"),
    *(Arrow(f"stage{n}", f"stage{n + 1}") for n in range(5)),
    Arrow("state", "stage1", "read", via=((3.5, 2.0), (3.5, 1.7))),
    Arrow("stage5", "state", "write", via=((9.1, 1.7), (9.1, 1.9))),
    Arrow("stage5", "motor_pins", "cmd"),
    Arrow("stage5", "window", "status, response", via=((9.1, 0.7), (9.1, 0.5))),
    Arrow("motor_pins", "stage2", "result of the previous command", via=((11.0, 0.62), (4.9, 0.62))),
    Arrow("switches", "motor_pins"),
    Arrow("motor_pins", "pins"),
)


def visit() -> bytes:
    """Draw the stages of a visit in the engine."""
    return svg(draw(BOXES, ARROWS, (10.6, 3.0)))


def axis_cost() -> bytes:
    """Draw COMB of an axis over the number of axes: bank, parts with similar axes, other designs."""
    found = figures.read()
    figure, axes = plt.subplots(figsize=(8.4, 4.6), layout="constrained")
    for name, color in (("plain", BLUE), ("tuned", RED)):
        known = [n for n in designs.BANKS if f"bank {n} ecp5 {name}" in found]
        values = [found[f"bank {n} ecp5 {name}"]["comb"] / n for n in known]
        axes.plot(known, values, "o-", color=color, label=f"ppmc_bank, {name}")
        if name == "plain":
            for n, value in zip(known, values, strict=True):
                axes.annotate(f"{value:.0f}", (n, value), (5, 5), textcoords="offset points", color=color)
    family, others = size_page.axis_costs(found)
    points = list(zip(*family.values(), strict=True)) or [(), ()]
    axes.plot(*points, "s-", color=GREEN, label="parts, plain")
    for title, (n, comb) in family.items():
        axes.annotate(f"{title}: {comb:.0f}", (n, comb), (6, 6), textcoords="offset points", color=GREEN)
    for title, comb in others.items():
        axes.axhline(comb, color=GREY, linewidth=0.8, linestyle=(0, (4, 3)))
        near = any(0 < other - comb < 0.1 * comb for other in others.values())
        side = "top" if near else "bottom"  # if two lines are close together, the lower one is named below
        axes.text(73, comb, f"{title}: {comb}", va=side, ha="right", size=7.5, color="#444444")
    axes.set(xscale="log", yscale="log", xlabel="axes", ylabel="COMB of an axis, ECP5")
    ticks = (1, 2, *designs.BANKS)
    axes.set_xticks(ticks, [str(n) for n in ticks])
    axes.set_yticks([50, 100, 200, 500, 1000, 2000], ["50", "100", "200", "500", "1000", "2000"])
    axes.minorticks_off()
    axes.set(xlim=(0.9, 74), ylim=(45, 2900))
    axes.legend(loc="lower left")
    axes.set_title("Cost of an axis over the number of axes (dashed: one axis of other designs, plain)")
    return svg(figure)


PLOTS: dict[str, Callable[[], bytes]] = {"visit": visit, "cost": axis_cost}
