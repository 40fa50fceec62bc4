"""Noise on every input pin of the PPMC-104: short strobes, fast clocks, chattering switches."""

from __future__ import annotations

import random

from cocotb.triggers import Timer

from cocotb_tests.common.bench import Bench
from cocotb_tests.common.part import PPMC104

BUS = ("cs_n", "rd_n", "wr_n", "a0", "d_i")
SWITCHES = ("csel", "vsel", "l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n", "auxi")
BYTES = (
    0x0A,
    0x1A,
    0x2A,
    0x1E,
    0x40,
    0x41,
    0x42,
    0x43,
    0x44,
    0x4D,
    0x46,
    0x47,
    0xC0,
    0xC3,
    0xC6,
    0x84,
    0x86,
    0x80,
)


class Noise:
    """Drives random levels; each call of `make` goes on where the last one ended."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.rng = random.Random(f"noise {bench.seed}")

    def _levels(self) -> dict[str, int]:
        """A few pins with new levels; mostly bus pins, so that many bytes come through."""
        rng = self.rng
        kind = rng.random()
        if kind < 0.75:
            byte = rng.choice((*BYTES, rng.getrandbits(8), 3, 4, 4, 0))
            strobe = rng.choice(("wr_n", "wr_n", "wr_n", "rd_n", "cs_n"))
            return {"d_i": byte, "a0": rng.getrandbits(1), "cs_n": 0, strobe: rng.getrandbits(1)}
        if kind < 0.9:
            return {"clock": rng.getrandbits(1), rng.choice(BUS[:3]): 1}
        pin = rng.choice(SWITCHES)
        return {pin: rng.getrandbits(4) if pin == "auxi" else int(rng.random() < 0.7)}

    async def make(self, clocks: int) -> None:
        """Noise for about `clocks` clk: changes 0.1 to 60 clk apart, at any moment between edges."""
        rng, bench = self.rng, self.bench
        end = bench.now + clocks
        while bench.now < end:
            bench.set_between_edges(**self._levels())
            gap = rng.choice((0.1, 0.4, 1, 1, 2, 2, 3, 7, 20, 60))
            steps = max(2, int(gap * bench.period * rng.random()))
            # Never on a clk edge itself: which side of it a change falls on would be a race.
            offset = (bench.sim_time() + steps - bench.edge_time(0)) % bench.period
            await Timer(steps + (2 if offset < 2 or offset == bench.period - 1 else 0), "ps")

    async def stop(self) -> None:
        """All inputs to their idle levels; 20 clk for the last byte."""
        await self.bench.align()
        self.bench.set(**PPMC104.inputs)
        await self.bench.clocks(20)
