"""Noise on every input pin: short strobes, fast clocks, chattering switches."""

from __future__ import annotations

import random

from cocotb.triggers import Timer

from .bench import Bench

UNCOMPARED = "levels change between two edges of clk, where either of the two may see them first"
"""Why runs with this noise are not compared with the golden model."""


class Noise:
    """Drives random levels; each call of `make` goes on where the last one ended.

    strobes: active-low bus pins, each named as often as it shall be drawn. codes: bytes that shall come
    often. switches: all other pins; still: pins that keep their level.
    """

    def __init__(
        self, bench: Bench, strobes: tuple[str, ...], codes: tuple[int, ...], still: tuple[str, ...] = ()
    ) -> None:
        self.bench = bench
        self.rng = random.Random(f"noise {bench.seed}")
        self.still = {pin: bench.pins[pin] for pin in still}
        self._strobes = strobes
        self._codes = codes
        part = bench.part
        others = [pin for pin in part.inputs if pin not in (*part.bus_pins, part.clock, *still)]
        self._switches = tuple(others)

    def _levels(self) -> dict[str, int]:
        """A few pins with new levels; mostly bus pins, so that many bytes come through."""
        rng, part = self.rng, self.bench.part
        kind = rng.random()
        if kind < 0.75:
            byte = rng.choice((*self._codes, rng.getrandbits(8), 3, 4, 4, 0))
            strobe = rng.choice(self._strobes)
            return {"d_i": byte, "a0": rng.getrandbits(1), "cs_n": 0, strobe: rng.getrandbits(1)}
        if kind < 0.9:
            return {part.clock: rng.getrandbits(part.width(part.clock)), rng.choice(self._strobes): 1}
        pin = rng.choice(self._switches)
        width = part.width(pin)
        if width > 2:
            return {pin: rng.getrandbits(width)}
        return {pin: sum((rng.random() < 0.7) << place for place in range(width))}

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
        self.bench.set(**{**self.bench.part.inputs, **self.still})
        await self.bench.clocks(20)
