"""Drives one block instance of a generated wrapper, cycle by cycle.

The wrapper is one top module with many instances, whose ports are called <instance>_<port>.
"""

from __future__ import annotations

import linecache
import os
import random
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, RisingEdge, Timer
from cocotb.utils import get_sim_time


@dataclass(frozen=True)
class Block:
    """An instance: module, ports as "name[:width[:cast type]]", and parameters.

    Names that end in _i or _ni are inputs. clk_i and rst_ni are added unless `bare` is set.
    """

    module: str
    text: str
    params: Mapping[str, int] = field(default_factory=dict)
    bare: bool = False

    @property
    def ports(self) -> list[tuple[str, int, str]]:
        """(name, width, cast type or "") of every port."""
        words = self.text.split() if self.bare else ["clk_i", "rst_ni", *self.text.split()]
        cells = [(word + "::").split(":", 2) for word in words]
        return [(name, int(width or 1), cast.strip(":")) for name, width, cast in cells]


def is_input(port: str) -> bool:
    """Return whether the test drives this port."""
    return port.endswith(("_i", "_ni"))


def wrapper_text(top: str, blocks: Mapping[str, Block]) -> str:
    """Return the SystemVerilog of the top module.

    Only one instance is clocked: the signal `chosen` of the module holds its number, counted from 1.
    """
    # Inputs start at random levels. Because only the chosen instance is clocked, no assertion of another
    # instance fires.
    pins, body = [], ["  logic [7:0] chosen = 8'd0;"]
    for number, (name, block) in enumerate(blocks.items(), 1):
        links = []
        for port, width, cast in block.ports:
            kind = "input wire logic" if is_input(port) else "output logic"
            pins.append(f"    {kind} [{width - 1}:0] {name}_{port}")
            if port == "clk_i":
                links.append(f".clk_i({name}_clk_i && chosen == 8'd{number})")
                continue
            links.append(f".{port}({cast}'({name}_{port}))" if cast else f".{port}({name}_{port})")
        values = ", ".join(f".{key}({value})" for key, value in block.params.items())
        body.append(f"  {block.module} #({values}) u_{name} ({', '.join(links)});")
    return "\n".join([f"module {top} (", ",\n".join(pins), ");", *body, "endmodule", ""])


FOLDER = Path(__file__).resolve().parents[1]


def rng() -> random.Random:
    """Return the random source of the running test.

    Its seed is shown in the failure message and set with --seed.
    """
    return random.Random(int(os.environ.get("OPENPPMC_SEED", "1")))


def same(what: str, got: object, want: object) -> None:
    """Assert that both values are equal; the message contains both."""
    assert got == want, f"{what}: got {got}, want {want}"


def _test_frame() -> FrameType:
    """Return the outermost stack frame of this project's code in the running test."""
    frame = sys._getframe(1)
    while frame.f_back is not None and FOLDER in Path(frame.f_back.f_code.co_filename).parents:
        frame = frame.f_back
    return frame


async def _end(test: FrameType, clk: int) -> None:
    """Fail the running test after `clk` cycles (two time steps each); name the line that waits."""
    await Timer(2 * clk, "step")
    file, line = test.f_code.co_filename, test.f_lineno
    waiting = linecache.getline(file, line).strip()
    place = f"{Path(file).name}:{line}: {waiting}"
    raise AssertionError(f"not finished within {clk} cycles; the test waits in {place}")


class BlockDriver:
    """Driver of one instance. `edges` counts the rising edges of `clk` since reset.

    The first driver that a test creates limits the duration of the test, because a block that does not
    respond would stall it for minutes. The limit is LIMIT cycles, or FREE if the clock runs freely, which is
    thirty times as fast.
    """

    LIMIT, FREE = 250_000, 1_500_000
    """Limits in cycles: about twice the duration of the longest tests, or 30 s."""
    _limited: FrameType | None = None
    """Stack frame of the test whose duration is already limited."""

    def __init__(
        self, dut: Any, name: str, blocks: Mapping[str, Block], watch: str = "", limit: int = LIMIT
    ) -> None:
        """Connect to an instance.

        Args:
            watch: outputs that `clk` returns, in this order.
            limit: limit of the test, for the sum of the cycles of all its drivers.
        """
        block = blocks[name]
        self.chosen, self.number = dut.chosen, list(blocks).index(name) + 1
        self.pins = {port: getattr(dut, f"{name}_{port}") for port, _, _ in block.ports}
        self.inputs = [port for port, _, _ in block.ports if is_input(port)]
        self.watch = [self.pins[port] for port in watch.split()]
        self.edges = 0
        if BlockDriver._limited is not (test := _test_frame()):
            BlockDriver._limited = test
            cocotb.start_soon(_end(test, limit))

    def get(self, port: str) -> int:
        """Return the present level of a port."""
        return int(self.pins[port].value)

    def put(self, **inputs: int) -> None:
        """Set inputs; the levels take effect at the next wait."""
        for port, value in inputs.items():
            self.pins[port].value = int(value)

    def choose(self) -> None:
        """Connect the clock to this instance."""
        self.pins["clk_i"].value = 0
        self.chosen.value = self.number

    async def reset(self, **inputs: int) -> None:
        """Reset for three cycles, then release the reset; all inputs except `inputs` are 0."""
        self.put(**{port: 0 for port in self.inputs})
        self.put(**inputs)
        self.choose()
        for level in (0, 0, 0, 1):
            self.put(rst_ni=level)
            if not level:
                await self.clk()
        self.edges = 0

    async def settle(self, **inputs: int) -> Any:
        """Set inputs and let combinational logic settle, without a clock edge; return the watched outputs."""
        self.put(**inputs)
        await Timer(1, "step")
        values = [int(pin.value) for pin in self.watch]
        return values[0] if len(values) == 1 else tuple(values)

    async def clk(self, **inputs: int) -> Any:
        """Make one rising edge that samples these inputs; return the watched outputs before the edge."""
        values = await self.settle(**inputs)
        self.pins["clk_i"].value = 1
        await Timer(1, "step")
        self.pins["clk_i"].value = 0
        self.edges += 1
        return values

    async def run_until(self, port: str, level: int) -> int:
        """Run the clock freely until an output has this level; return the number of edges, at least one.

        Use it for long waits: it is thirty times as fast as `clk`.
        """
        await self.settle()  # lets the low level of clk_i, set in the previous cycle, take effect
        clock = Clock(self.pins["clk_i"], 2, "step", impl="gpi")
        clock.start()
        since = get_sim_time("step")
        await (RisingEdge if level else FallingEdge)(self.pins[port])
        took = int(get_sim_time("step") - since) // 2 + 1
        clock.stop()
        await Timer(1, "step")
        await self.settle(clk_i=0)
        return took
