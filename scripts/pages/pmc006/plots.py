"""Plots of docs/pmc006/README.md: speed of moves, from the steps of the golden model at its pins."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from cocotb_tests.harness.model_bench import OnModel, on_model
from cocotb_tests.pmc006.builds import F8B
from cocotb_tests.pmc006.host import Host
from scripts.pages.pictures.plots import BLUE, GREEN, GREY, RED, svg

CLK_HZ = F8B.clk_hz
LONGEST = 60_000  # ms
Settings = dict[str, int]
FAST = {"u": 3, "o": 3, "v": 3200}


async def new(settings: Settings) -> Host:
    """Return a controller with these settings."""
    host = await Host.start(OnModel(F8B))
    for letter, value in settings.items():
        await host.ask(letter, value)
    return host


async def finish(host: Host) -> list[int]:
    """Run to the end of the motion; return the edges of its steps."""
    await host.until("mon_busy", 0, LONGEST * 1000)
    return host.steps()


async def made(count: int, settings: Settings) -> list[int]:
    """Run a move; return the edges of its steps."""
    host = await new(settings)
    await host.ask("s", count)
    return await finish(host)


def steps(count: int, **settings: int) -> list[int]:
    """Return the edges of the steps of a move."""
    return on_model(made(count, settings))


def _speed(axes: Axes, edges: Sequence[int], colour: str, label: str) -> None:
    """Draw the speed over time; the speed of each interval is at its middle."""
    ms = [(a + b) / 2 / (CLK_HZ / 1000) for a, b in pairwise(edges)]
    pps = [CLK_HZ / (b - a) for a, b in pairwise(edges)]
    axes.plot(ms, pps, color=colour, lw=1.3, label=label)


def _from(edges: Sequence[int]) -> list[int]:
    return [edge - edges[0] for edge in edges]


def moves() -> bytes:
    """Draw short and long moves, and the same distance with several coefficients."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.2, 3.3), layout="constrained")
    for count, colour in ((200, GREY), (300, GREEN), (600, RED), (1500, BLUE)):
        _speed(left, _from(steps(count, **FAST)), colour, f"{count} steps")
    left.set(title="u = o = 3, up to 3200 pps", xlabel="ms after step 1", ylabel="pps", ylim=(0, 4200))
    left.legend(loc="upper right", fontsize=8)
    for coefficient, colour in ((5, GREEN), (3, RED), (1, BLUE)):
        edges = steps(8000, u=coefficient, o=coefficient, v=5000)
        _speed(right, _from(edges), colour, f"u = o = {coefficient}")
    right.set(title="8000 steps up to 5000 pps", xlabel="ms after step 1", ylim=(0, 6600))
    right.legend(loc="upper right", fontsize=8)
    return svg(figure)


async def retargeted() -> tuple[list[int], list[tuple[int, str]]]:
    """Return the edges of the steps in speed mode, and edge and text of each instruction."""
    host = await new(FAST | {"v": 3000})
    await host.ask("N", 1)
    begin, marks = host.mark, []
    for pause, letter, value in (
        (300, "v", 1200),
        (250, "v", 3000),
        (250, "N", 0),
        (90, "N", 1),
        (200, "N", 0),
    ):
        await host.ms(pause)
        marks.append((host.t, f"{letter} {value}"))
        await host.ask(letter, value)
    host.mark = begin
    return await finish(host), marks


def retarget() -> bytes:
    """Draw speed mode: changes of speed, its end, and a restart in the deceleration ramp."""
    edges, marks = on_model(retargeted())
    figure, axes = plt.subplots(figsize=(9.2, 2.8), layout="constrained")
    _speed(axes, _from(edges), BLUE, "speed")
    for t, text in marks:
        at = (t - edges[0]) / (CLK_HZ / 1000)
        axes.axvline(at, color=GREY, lw=0.8, ls=":")
        axes.text(at + 4, 3350, text, fontsize=8, color=GREY)
    axes.set(title="Speed mode, u = o = 3", xlabel="ms after step 1", ylabel="pps", ylim=(0, 3700))
    return svg(figure)


PLOTS = {"moves": moves, "speed_mode": retarget}
