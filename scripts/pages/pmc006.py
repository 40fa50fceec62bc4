"""Kinds of tables and pictures for docs/pmc006/figures.yml, from the golden model of the PMC006B4."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Sequence
from functools import cache
from itertools import pairwise

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cocotb_tests.harness.model_bench import OnModel, on_model
from cocotb_tests.pmc006.builds import F8B
from cocotb_tests.pmc006.host import Host
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
from scripts.markdown import table
from scripts.pages.pictures.moves import Train, speeds
from scripts.pages.pictures.plots import BLUE, GREEN, GREY, RED
from scripts.pages.pictures.tables import spaced

CLK_HZ = F8B.clk_hz
LONGEST = 60_000  # ms
FAST = {"u": 3, "o": 3, "v": 3200}


async def new(settings: dict[str, int]) -> Host:
    """Return a controller with these settings."""
    host = await Host.start(OnModel(F8B))
    for letter, value in settings.items():
        await host.ask(letter, value)
    return host


async def finish(host: Host) -> list[int]:
    """Run to the end of the motion; return the edges of its steps."""
    await host.until("mon_busy", 0, LONGEST * 1000)
    return host.steps()


async def _moved(count: int, settings: dict[str, int]) -> list[int]:
    host = await new(settings)
    await host.ask("s", count)
    return await finish(host)


def move(count: int, **settings: int) -> Train:
    """Return a move; its settings are named by their letters."""
    return _train(on_model(_moved(count, settings)))


def _train(edges: Sequence[int]) -> Train:
    return Train([b - a for a, b in pairwise(edges)], CLK_HZ)


def moves(rows: Sequence[Sequence[int]]) -> str:
    """Return a table of moves with their times and highest speeds.

    Args:
        rows: steps, the settings L, S and v, and the ramp coefficient, which is used for both u and o.
    """
    found = []
    for count, start, stop, top, coefficient in rows:
        gaps = move(count, L=start, S=stop, v=top, u=coefficient, o=coefficient).intervals
        # Compute the speed from two intervals together, because a single interval is rounded to 1 µs.
        shortest = min(a + b for a, b in pairwise(gaps))
        fastest = _number(round(2 * CLK_HZ / shortest))
        limits, both = f"{start}, {stop}, {_number(top)}", f"{coefficient}, {coefficient}"
        found.append([_number(count), limits, both, f"{sum(gaps) * 1000 / CLK_HZ:.1f}", fastest])
    heads = ["Steps", "Start, stop, maximum pps", "u, o", "Time / ms", "Fastest pps"]
    return f"{table(heads, found)}\n\nTime from the first step to the last."


def _number(value: int) -> str:
    return spaced(value) if value > 9999 else str(value)


# ------------------------------------------------------------------------------------------- speed mode


async def _retargeted() -> tuple[list[int], list[tuple[int, str]]]:
    """Return the edges of the steps in speed mode, and (edge, text) of each instruction."""
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


def speed_mode() -> Figure:
    """Draw speed mode: changes of speed, its end, and a restart in the deceleration ramp."""
    edges, marks = on_model(_retargeted())
    figure, axes = plt.subplots(figsize=(9.2, 2.8), layout="constrained")
    speeds(axes, _train(edges), {"colour": "blue", "label": "speed"}, "time", 1, True)
    for t, text in marks:
        at = (t - edges[0]) / (CLK_HZ / 1000)
        axes.axvline(at, color=GREY, lw=0.8, ls=":")
        axes.text(at + 4, 3350, text, fontsize=8, color=GREY)
    axes.set(title="Speed mode, u = o = 3", xlabel="ms after step 1", ylabel="pps", ylim=(0, 3700))
    return figure


# ------------------------------------------------------------------------------------------------ times


async def _start() -> tuple[str, int]:
    host = await new(FAST)
    await host.ask("s", 300)
    e = host.e
    return "`s` to `mon_busy`", next(t for t in host.bench.golden.log.rises("mon_busy", e)) - e


async def _first_step() -> tuple[str, int]:
    host = await new(FAST | {"L": 2000, "S": 2000})
    await host.ask("s", 200)
    e = host.e
    edges = await finish(host)
    return "`s` to the start of the engine", round(edges[0] - e - CLK_HZ / 2000)


async def _stop() -> tuple[str, int]:
    host = await new(FAST | {"f": 1})
    await host.ask("s", 300)
    await host.ms(20)
    await host.pins(ext1=0)
    t = host.t - 1
    await host.ms(1)
    return "EXT1 to `mon_busy` low", next(edge for edge in host.bench.golden.log.falls("mon_busy", t)) - t


async def _output() -> tuple[str, int]:
    host = await new({})
    await host.ask("y", 8)
    return "`y` to `gpo`", host.bench.golden.log.of("gpo", host.e)[0][0] - host.e


CASES: tuple[Callable[[], Awaitable[tuple[str, int]]], ...] = (_start, _first_step, _stop, _output)


def times() -> str:
    """Return a table of latencies in cycles, counted from the last stop-bit sample or from a pin's change."""
    head = f"This core, at {CLK_HZ // 1_000_000} MHz, in cycles (from the stop bit or the pin):"
    return f"{head}\n\n{table(['', 'cycles'], [on_model(case()) for case in CASES])}"


# --------------------------------------------------------------------------------------------- currents

SHOWN = Case(cur=1000, mstep=16, full=1000, periods=1)
AGAINST = Case(cur=1000, mstep=16, full=1000, emf=6.0, periods=1)
REST_STEPS, REST_US = 4, 250
CURRENTS = (400, 1000, 1900)
SLOW = tuple(
    Case(mstep=mstep, full=full, scomp=300, periods=1) for mstep in (16, 2, 0) for full in (40, 100, 200)
)
"""With factor P = 300, the lead angle is 0, so these angles include the zeros of both references."""
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
    """Draw the ripple of the currents at standstill: the difference between currents and references."""
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


def currents() -> Figure:
    """Draw regulated currents: in motion, at standstill, and their spectrum."""
    figure, (left, middle, right) = plt.subplots(
        1, 3, figsize=(9.2, 3.3), layout="constrained", width_ratios=(5, 4, 4)
    )
    _currents(left)
    _rest(middle)
    _lines(right)
    return figure


def _percent(share: float) -> str:
    return f"{100 * share:.1f}"


def _left(both: tuple[Waves, Waves]) -> str:
    """Return the currents that remain at a reference of 0: after a positive and after a negative current."""
    if not any(0 in found.reference for found in both):
        return ""
    above, below = zip(*(residual_current(found) for found in both), strict=True)
    return f"{max(above):.2f}, {abs(min(below)):.2f}"


def currents_table() -> str:
    """Return a table: error and distortion in motion, current left at reference 0, ripple at standstill."""
    heads = ["Microsteps", "Current / A", "Full steps/s", "Back EMF / V", "Error, sine / %"]
    heads += ["Error, steps / %"]
    rows = []
    for case in (*SLOW, *RUNS):
        both = _cruise(case)
        found = [wave_metrics(waves, case.periods) for waves in both]
        motion = [case.mstep or 1, f"{found[0].amplitude:.2f}", case.full, f"{case.emf:.0f}"]
        worst = [_percent(max(one[place] for one in found)) for place in (1, 2, 3)]
        rows.append([*motion, *worst, _left(both)])
    words = []
    for cur in CURRENTS:
        found = holding(Case(cur=cur))[0]
        words.append(f"{1000 * ripple(found)[1]:.0f} mA at {found.reference[0]:.2f} A")
    rest = f"{', '.join(words[:-1])} and {words[-1]}"
    text = f"Ripple of a phase at standstill, peak to peak: {rest}."
    return f"{table([*heads, 'THD / %', 'Left at 0 / A'], rows)}\n\n{text}"
