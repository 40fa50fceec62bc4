"""Contract of ppmc312_interval: for each base clock, the times at which pulses are scheduled, and the lengths
of the pulses.
"""

from __future__ import annotations

import random
from fractions import Fraction
from math import ceil

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, RisingEdge, Timer
from cocotb.utils import get_sim_time

from openppmc.model.ppmc312.stages import DIVIDERS

from ...harness import BlockDriver, rng, same
from . import stage_types
from .stage_types import CLOCKS

AREA, GROUPS, BLOCKS = stage_types.AREA, stage_types.GROUPS, stage_types.BLOCKS
XTAL = 16_000_000
LONGEST = 12_000
"""Maximum interval in cycles."""


class Bench:
    """Instance of the block with a running clock; times are numbers of its rising edges."""

    def __init__(self, u: BlockDriver) -> None:
        self.u = u
        self.clock = Clock(u.pins["clk_i"], 2, "step", impl="gpi")
        self.rises: list[int] = []
        self.falls: list[int] = []

    async def __aenter__(self) -> Bench:
        await self.u.reset(first_i=1)
        self.clock.start()
        self.since = get_sim_time("step")
        self.tasks = [cocotb.start_soon(self.record(RisingEdge, self.rises))]
        self.tasks.append(cocotb.start_soon(self.record(FallingEdge, self.falls)))
        return self

    async def __aexit__(self, *_: object) -> None:
        self.clock.stop()
        for task in self.tasks:
            task.cancel()
        await Timer(1, "step")

    @property
    def now(self) -> int:
        """Number of the last rising edge."""
        return int(get_sim_time("step") - self.since) // 2

    async def record(self, edge: type, times: list[int]) -> None:
        """Append the times of an edge of high_o to `times`, without end."""
        while True:
            await edge(self.u.pins["high_o"])
            times.append(self.now)

    async def strobe(self, **inputs: int) -> int:
        """Apply inputs for the next edge, then 0; return the number of that edge."""
        self.u.put(**inputs)
        await RisingEdge(self.u.pins["clk_i"])
        self.u.put(**dict.fromkeys(inputs, 0))
        return self.now

    async def fire(self, rate: int) -> int:
        """Fire the next pulse in the cycle in which it is scheduled; return its edge."""
        await Timer(1, "step")  # ready_o follows the inputs
        if not self.u.get("ready_o"):
            await RisingEdge(self.u.pins["ready_o"])
        at = await self.strobe(fire_i=1, rate_i=rate)
        self.u.put(first_i=0, rate_i=0xFFFF)
        return at


def some_rates(rand: random.Random, tick: Fraction, count: int) -> list[int]:
    """Return rates with intervals of at least 4 cycles: short ones, one near the pulse width, and longer
    ones.
    """
    least, most = max(2, ceil(4 / tick)), max(3, int(LONGEST / tick))
    around = int(10e-6 * XTAL / 16e6 * 16e6 / tick) if tick else 0
    picks = (lambda: least + rand.randrange(5), lambda: rand.randint(least, most), lambda: around)
    return [min(max(rand.choice(picks)(), least), min(most, 0xFFFF)) for _ in range(count)]


@cocotb.test()
@cocotb.parametrize(clk=list(CLOCKS))
async def interval_exact(dut, clk):
    """For every internal base clock, pulse 1 occurs after the set-up time, and all other pulses occur without
    drift.
    """
    rand = rng()
    u = BlockDriver(dut, f"interval{clk // 1_000_000}", BLOCKS, limit=BlockDriver.FREE)
    width = ceil(Fraction(80 * clk, XTAL))
    for base, divider in DIVIDERS.items():
        tick = Fraction(divider * clk, XTAL)
        rates = some_rates(rand, tick, 24 if base < 4 else 6)
        async with Bench(u) as bench:
            u.put(base_i=base)
            await Timer(2 * rand.randint(1, 60), "step")  # start at any phase of the prescaler
            armed = await bench.strobe(arm_i=1)
            edges = [await bench.fire(rate) for rate in rates]
            await Timer(2 * width + 4, "step")
        where = f"base clock {base}, rates {rates}"
        same(f"{where}: pulse 1", edges[0] - armed, width)
        total, due, low = 0, [], []
        for rate in rates:
            start = ceil(total * tick)
            due.append(start)
            low.append(min(start + width, ceil((total + rate // 2) * tick)))
            total += rate
        same(f"{where}: pulses", [edge - edges[0] for edge in edges], due)
        same(f"{where}: rises", bench.rises, edges)
        same(f"{where}: falls", [edge - edges[0] for edge in bench.falls], low)


@cocotb.test()
async def interval_shortest(dut):
    """Intervals below 4 cycles last 4 cycles; the next interval is counted from the actual pulse."""
    u = BlockDriver(dut, "interval8", BLOCKS)
    rates = [2, 2, 3, 2, 100, 3, 4, 5, 2, 7, 50]
    async with Bench(u) as bench:
        await bench.strobe(arm_i=1)
        edges = [await bench.fire(rate) for rate in rates]
    gaps = [b - a for a, b in zip(edges, edges[1:], strict=False)]
    same("gaps", gaps, [max(4, rate) for rate in rates[:-1]])


@cocotb.test()
async def interval_external(dut):
    """With clock edges at a pin, a pulse follows the R-th edge after the edge of the previous pulse, R being
    its rate.

    The delay from the edge to the pulse is less than 3 cycles. A pulse ends after half of these edges or
    after its width, even if the clock stops.
    """
    rand = rng()
    for clk, base in ((8_000_000, 6), (16_000_000, 7), (50_000_000, 6)):
        u = BlockDriver(dut, f"interval{clk // 1_000_000}", BLOCKS)
        width = ceil(Fraction(80 * clk, XTAL))
        rates = [2, 3, 2, 5, 40, 2, 9, rand.randint(2, 90), rand.randint(2, 90), 7]
        edges: list[int] = []
        ticks: list[int] = []
        async with Bench(u) as bench:
            u.put(base_i=base, extck_i=base == 7)

            async def clock(bench=bench, u=u, base=base, ticks=ticks) -> None:
                """Drive edges of both directions; record the edge of `clk_i` that samples each active
                edge.
                """
                slow = False
                while True:
                    for level in (base == 6, base == 7):
                        slow = not slow if rand.random() < 0.1 else slow
                        await Timer(2 * rand.choice((2, 2, 3, 9, 30) if slow else (2, 2, 3)), "step")
                        u.put(extck_i=level)
                        if level == (base == 6):
                            ticks.append(bench.now + 1)

            await Timer(3, "step")  # between two edges of `clk_i`
            task = cocotb.start_soon(clock())
            armed = await bench.strobe(arm_i=1)
            for rate in rates:
                edges.append(await bench.fire(rate))
            task.cancel()
            await Timer(2 * width + 8, "step")
        lag = 2
        first = next(n for n, at in enumerate(ticks) if at + lag >= armed + width)
        want, low, n = [], [], first
        for rate in rates:
            want.append(ticks[n] + lag)
            half = ticks[n + rate // 2] + lag if n + rate // 2 < len(ticks) else want[-1] + width
            low.append(min(want[-1] + width, half))
            n += rate
        same(f"{clk} Hz, base {base}: pulses", edges, want)
        same(f"{clk} Hz, base {base}: falls", bench.falls, low)
