"""Drives one block instance of a wrapper clk by clk."""

from __future__ import annotations

import os
import random
from collections.abc import Mapping
from typing import Any

from cocotb.triggers import Timer

from .wrapper import Block, is_input


def rng() -> random.Random:
    """Random source of the running test; the seed is in the failure message and in --seed."""
    return random.Random(int(os.environ.get("OPENPPMC_SEED", "1")))


def same(what: str, got: object, want: object) -> None:
    """Assertion with both values in the message."""
    assert got == want, f"{what}: got {got}, want {want}"


class Unit:
    """One instance. `edges` counts the rising clk edges since reset."""

    def __init__(self, dut: Any, name: str, blocks: Mapping[str, Block], watch: str = "") -> None:
        """watch: outputs that `clk` returns, in this order."""
        block = blocks[name]
        self.chosen, self.number = dut.chosen, list(blocks).index(name) + 1
        self.pins = {port: getattr(dut, f"{name}_{port}") for port, _, _ in block.ports}
        self.inputs = [port for port, _, _ in block.ports if is_input(port)]
        self.watch = [self.pins[port] for port in watch.split()]
        self.edges = 0

    def get(self, port: str) -> int:
        """Level of a port now."""
        return int(self.pins[port].value)

    def put(self, **inputs: int) -> None:
        """Set inputs; they stand from the next wait on."""
        for port, value in inputs.items():
            self.pins[port].value = int(value)

    def choose(self) -> None:
        """Give the clock to this instance."""
        self.pins["clk_i"].value = 0
        self.chosen.value = self.number

    async def reset(self, **inputs: int) -> None:
        """All inputs 0 but the given ones, three clk of reset, release."""
        self.put(**{port: 0 for port in self.inputs})
        self.put(**inputs)
        self.choose()
        for level in (0, 0, 0, 1):
            self.put(rst_ni=level)
            if not level:
                await self.clk()
        self.edges = 0

    async def settle(self, **inputs: int) -> Any:
        """Set inputs and let the logic follow; no clk edge. Returns the watched outputs."""
        self.put(**inputs)
        await Timer(1, "step")
        values = [int(pin.value) for pin in self.watch]
        return values[0] if len(values) == 1 else tuple(values)

    async def clk(self, **inputs: int) -> Any:
        """One rising edge that samples these inputs; returns the watched outputs as they stood before it."""
        values = await self.settle(**inputs)
        self.pins["clk_i"].value = 1
        await Timer(1, "step")
        self.pins["clk_i"].value = 0
        self.edges += 1
        return values
