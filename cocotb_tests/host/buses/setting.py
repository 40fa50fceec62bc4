"""Start of each bus test: idle inputs, clock, reset."""

from __future__ import annotations

import os
import random
from typing import Any

import cocotb
from cocotb.handle import Immediate
from cocotb.triggers import RisingEdge, Timer

from cocotb_tests.harness import Config
from cocotb_tests.harness.sim_backend import sim_backend

INPUT_ENDS = ("awvalid", "awaddr", "wvalid", "wdata", "wstrb", "bready", "arvalid", "araddr", "rready")
INPUT_ENDS += ("cyc", "stb", "we", "adr", "sel", "datwr", "bus_q")
PREFIXES = ("model_axil", "part_axil", "model_wb", "part_wb")
PERIOD_PS = 62_500
TEN_LINES = Config("lines10", extra=(("ModelBits", 10),))
"""A build with 10 address lines, as many as a bank has."""


def count_of(dut: Any) -> int:
    """Return the number of registers that are accessible through the bridges with bare strobe pins."""
    return 1 << len(dut.model_wb_bus_a)


async def start(dut: Any) -> random.Random:
    """Set all inputs to 0 (int_n to 1), start clock and reset; return the random source of the test."""
    for prefix in PREFIXES:
        for end in INPUT_ENDS:
            if hasattr(dut, name := f"{prefix}_{end}"):
                getattr(dut, name).set(Immediate(0))
        if hasattr(dut, f"{prefix}_bus_int_n"):
            getattr(dut, f"{prefix}_bus_int_n").set(Immediate(1))
    dut.clk.set(Immediate(0))
    dut.rst_n.set(Immediate(1))
    await Timer(PERIOD_PS, "ps")
    dut.rst_n.value = 0
    await Timer(PERIOD_PS, "ps")
    # In contrast to the clock of cocotb, the clock of the backend enables assertions after its first rising
    # edge.
    sim_backend().clock(sim_backend().port("clk"), PERIOD_PS // 2)
    for _ in range(4):
        await RisingEdge(dut.clk)
    dut.rst_n.value = 1
    for _ in range(4):
        await RisingEdge(dut.clk)
    seed = int(os.environ.get("OPENPPMC_SEED", "1"))
    cocotb.log.info("seed %d", seed)
    return random.Random(seed)
