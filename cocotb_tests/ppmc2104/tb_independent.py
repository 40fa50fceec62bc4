"""Axis 2 executes the same instructions with and without traffic to axis 1; its waveforms must be equal."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import repeat
from typing import Any

from cocotb_tests.harness import DutBench, HostBus, random_test, start_bench
from cocotb_tests.ppmc2104.random_pairs import SLOT, Pair, Write, pair, traffic

from .bench import PPMC2104

WAVES = ("pout_n[2]", "dir[2]", "hold[2]", "s2_n")
# Longest legal table build of axis 2 (READY), and duration of an instruction of axis 1 with all its bytes
# (INSTRUCTION), in cycles.
READY, INSTRUCTION = 40_000, 80


class Run:
    """One of the two runs, which starts with a reset."""

    def __init__(self, bench: DutBench, plan: Pair, beside: Iterator[list[Write] | tuple[str, int]]) -> None:
        self.bench = bench
        self.plan = plan
        self.host = HostBus(bench)
        self.beside = beside

    async def play(self) -> dict[str, list[tuple[int, int]]]:
        """Run the plan; return the edges of axis 2, counted from the reset."""
        bench, plan = self.bench, self.plan
        await bench.align()
        bench.set(**{**PPMC2104.inputs, "busc": plan.busc})
        origin = await bench.reset(settle=8)
        await self.send(plan.setting)
        clock = bench.external_clock(repeat(plan.period), "extck[2]") if plan.period else None
        begin = origin + READY
        await bench.until(begin)
        for place, slot in enumerate(plan.slots):
            begin = origin + READY + SLOT * place
            await self.fill(begin)
            await self.send(slot.writes)
            for at, name, value in slot.events:
                await self.fill(begin + at)
                if name == "code":
                    await self.send(((1, value),))
                else:
                    bench.set(**{name: value})
        await self.fill(begin + SLOT)
        if clock:
            clock.cancel()
        return {name: [(t - origin, v) for t, v in bench.edges(name, origin)] for name in WAVES}

    async def send(self, writes: Any) -> None:
        for reg, byte in writes:
            await self.host.write(reg, byte, gap=8)

    async def fill(self, until: int) -> None:
        """Send instructions to axis 1 as long as each is complete before edge `until`, then wait for this
        edge.
        """
        bench = self.bench
        while bench.now + INSTRUCTION + 70 < until:
            thing = next(self.beside, None)
            if thing is None:
                break
            if isinstance(thing, list):
                await self.send(thing)
                await self.host.read(len(thing) % 2)
                await bench.clocks(bench.rng.randint(0, 40))
            else:
                bench.set(**{thing[0]: thing[1]})
                await bench.clocks(bench.rng.randint(1, 60))
        await bench.until(until)


@random_test("P2104-OPR-10", "P2104-BCK-05", "P2104-STP-06", "P2104-LIM-02", "P2104-HSK-05", least=1)
async def p2104_axis_2_alone_and_with_axis_1(dut: Any, seed: int) -> None:
    """Traffic to axis 1 between the accesses to axis 2 does not change the edges of axis 2
    (P2104-OPR-10).
    """
    plan = pair(seed)
    bench = await start_bench(dut, PPMC2104, busc=plan.busc)
    alone = await Run(bench, plan, iter(())).play()
    before = len(bench.accesses)
    things = traffic(bench.seed, 40 * len(plan.slots) * 5)
    beside = await Run(bench, plan, iter(things)).play()
    assert len(bench.accesses) > 4 * before, "hardly any traffic"
    for name in WAVES:
        bench.check("P2104-OPR-10", f"edges of {name} beside a working axis 1", beside[name], alone[name])
    assert len(alone["pout_n[2]"]) > 3, "axis 2 did next to nothing"
