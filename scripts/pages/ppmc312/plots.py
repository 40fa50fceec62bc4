"""Plots of docs/ppmc312/README.md: tables and plans of the golden model; changes, origin from its pins."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import accumulate, pairwise

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from cocotb_tests.harness.model_bench import OnModel, on_model
from cocotb_tests.ppmc312.blocks import TF
from cocotb_tests.ppmc312.host import Host
from openppmc.model.ppmc312.stages import LAST, Table, build, curve, ramped
from scripts.pages.pictures.plots import BLUE, GREEN, GREY, RED, svg

F_HZ = 1_000_000
CLK = 16  # cycles of a tick
START, HIGH, PULSES = 1000, 200, 2000
LINEAR = build(START, START, HIGH, PULSES, PULSES)
SIGMOID = build(START, START, HIGH, PULSES, PULSES, sigmoid=True)
# Seven stages that become shorter, for a motor with less torque at high speed.
FREE = curve([200, 230, 270, 330, 430, 600, 1000], [500, 400, 350, 300, 250, 150, 50])
SMALL = curve([100, 200, 400], [5, 4, 3])
SIDES = build(START, 500, HIGH, PULSES, 1500)


def _stairs(axes: Axes, rates: Sequence[int], colour: str, label: str | None, start: float = 0.0) -> None:
    """Draw the speed of each interval in kpps over ms."""
    edges = [start + ticks / 1000 for ticks in accumulate(rates, initial=0)]
    axes.stairs([1000 / rate for rate in rates], edges, baseline=None, color=colour, lw=1.5, label=label)


def _up(table: Table) -> list[int]:
    """Return the rates of all pulses of an acceleration."""
    return [rate for rate, count in zip(table.rates, table.pa, strict=True) for _ in range(count)]


def tables() -> bytes:
    """Draw linear, sigmoid and free curve: speed over time, and pulses of each stage."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained")
    made = ((LINEAR, BLUE, "linear"), (SIGMOID, RED, "sigmoid"), (FREE, GREEN, "free curve, 7 stages"))
    for table, colour, label in made:
        _stairs(left, _up(table), colour, label)
        if table is not FREE:
            right.step(range(LAST + 1), table.pa, where="mid", color=colour, lw=1.2, label=label)
    left.set(title="2000 pulses from 1000 to 5000 pulses/s", xlabel="ms after pulse 1", ylabel="kpps")
    left.set_ylim(0, 5.5)
    left.legend(loc="lower right")
    right.set(title="Pulses of each stage", xlabel="stage", ylabel="pulses", ylim=(0, 30))
    right.legend(loc="lower right")
    return svg(figure)


def shapes() -> bytes:
    """Draw trapezoidal and triangular profiles, and those with one side only."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained", sharey=True)
    cases = ((5000, BLUE), (3000, RED), (1000, GREEN))
    names = {0x00: "trapezoid", 0x10: "triangle", 0x20: "only down", 0x40: "only up"}
    for axes, table, pulses in ((left, LINEAR, cases), (right, SIDES, (*cases[:2], (200, GREEN)))):
        for count, colour in pulses:
            plan = ramped(table, HIGH, count)
            rates = [step.rate for step in plan.steps()]
            _stairs(axes, rates, colour, f"N = {count}: {plan.kind:02X}, {names[plan.kind]}")
        axes.set(xlabel="ms after pulse 1")
        axes.legend(loc="upper right", fontsize=8)
    left.set(title="Start and stop at 1000 pulses/s", ylabel="kpps", ylim=(0, 7.2))
    right.set(title="Start at 1000, stop at 2000 pulses/s")
    return svg(figure)


async def _played(block: str, number: int, change: str) -> list[int]:
    """Return the intervals in ticks of a move in which `change` is sent after pulse `number`."""
    host = await Host.start(OnModel(), *TF)
    await host.ask(block)
    if change:
        await host.pulse(number, 40)
        await host.issue(change)
    for _ in range(2000):
        if host.bench.golden.next_event is None or len(host.bench.rises("pout")) >= SHOWN:
            break
        await host.step()
    edges = host.bench.rises("pout")[:SHOWN]
    return [(b - a) // CLK for a, b in pairwise(edges)]


SHOWN = 46  # pulses of a continuous motion


def changes() -> bytes:
    """Draw instructions 87, 88, 81 in a motion with the table TF."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained", sharey=True)
    endless = (
        ("03 04 86 00 0190", 10, "03 04 87 00 0064", BLUE, "86 at 400, then 87 to 100"),
        ("03 04 86 00 0064", 20, "03 04 88 00 012C", RED, "86 at 100, then 88 to 300"),
        ("03 04 85 00 0000", 24, "03 02 81 00", GREEN, "85, then 81"),
    )
    counted = (
        ("03 08 82 00 0000 0000001E", 0, "", GREY, "82, N = 30, undisturbed"),
        ("03 08 82 00 0000 0000001E", 15, "03 04 88 00 00C8", BLUE, "88 to 200 in interval 15"),
        ("03 08 82 00 0000 0000001E", 15, "03 02 81 00", GREEN, "81 in interval 15: 27 pulses"),
    )
    for axes, cases in ((left, endless), (right, counted)):
        for block, number, change, colour, label in cases:
            intervals = on_model(_played(block, number, change))
            _stairs(axes, intervals, colour, label)
            if change:
                at = sum(intervals[: number - 1]) / 1000
                axes.plot([at], [1000 / intervals[number - 1]], "v", color=colour, ms=8)
        axes.set(xlabel="ms after pulse 1")
        axes.legend(loc="upper right", fontsize=8)
    left.set(title="Continuous motion (triangle: change)", ylabel="kpps", ylim=(0, 16))
    right.set(title="30 pulses", xlim=(0, 7.5))
    return svg(figure)


async def _returned(switch: int, free: int, out: int) -> list[int]:
    """Return the pulses of a zero return with `out` pulses in phase 1; the switch is that of `origin`."""
    host = await Host.start(OnModel(), *TF)
    await host.ask("03 04 11 00 0000")
    await host.pulse(switch)
    await host.pins(org_n=0)
    await host.pulse(switch + free)
    await host.pins(org_n=1)
    await host.pulse(out + out - switch - free)
    await host.pins(org_n=0)
    await host.response()
    return host.bench.rises("pout")


def origin() -> bytes:
    """Draw a zero return: speed and position over time."""
    switch, free = 24, 4  # pulses until the switch closes; width of the switch in pulses
    out = switch + 12
    edges = on_model(_returned(switch, free, out))
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.0), layout="constrained")
    there, back = edges[:out], edges[out:]
    for part, colour, label in ((there, BLUE, "out"), (back, RED, "back")):
        rates = [(b - a) // CLK for a, b in pairwise(part)]
        sign = 1 if part is there else -1
        begin = (part[0] - edges[0]) / CLK / 1000
        times = [begin + ticks / 1000 for ticks in accumulate(rates, initial=0)]
        left.stairs(
            [sign * 1000 / rate for rate in rates], times, baseline=None, color=colour, lw=1.5, label=label
        )
    where = [*range(1, out + 1), *range(out - 1, out - 1 - len(back), -1)]
    right.plot([(edge - edges[0]) / CLK / 1000 for edge in edges], where, ".", color=GREY, ms=5)
    right.axhspan(switch, switch + free, color=GREEN, alpha=0.25, label="org_n = L")
    left.axhline(0, color=GREY, lw=0.8)
    left.set(title="Speed", xlabel="ms after pulse 1", ylabel="kpps", ylim=(-5, 13))
    left.legend(loc="upper right")
    right.set(title="Position", xlabel="ms after pulse 1", ylabel="POS", ylim=(0, 40))
    right.legend(loc="lower center")
    return svg(figure)


PLOTS: dict[str, Callable[[], bytes]] = {
    "tables": tables,
    "shapes": shapes,
    "changes": changes,
    "return": origin,
}
