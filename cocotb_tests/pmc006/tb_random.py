"""Random hosts, compared with the golden model on every clk; the free-running streams, compared as well."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness.bench import Bench
from cocotb_tests.harness.seeds import each_seed
from cocotb_tests.harness.tape import play
from cocotb_tests.harness.verifies import verifies

from . import random_host
from .bench import PMC006


@cocotb.test()
@verifies(
    "P006-FRM-02",
    "P006-FRM-03",
    "P006-FRM-07",
    "P006-UART-03",
    "P006-UART-05",
    "P006-STA-10",
    "P006-STA-14",
    "P006-STA-18",
    "P006-MOT-03",
    "P006-MOT-05",
    "P006-MOT-20",
    "P006-MOT-30",
    "P006-EXC-13",
    "P006-EXC-24",
    "P006-CHP-06",
    "P006-PRG-15",
    "P006-PRG-16",
    "P006-BAD-05",
    "P006-BAD-16",
    "P006-BAD-17",
    "P006-BAD-24",
)
async def p006_random_host(dut: Any) -> None:
    """Given random hosts, when the RTL gets their pins, then all outputs change as in the golden model."""
    bench = await Bench.start(dut, PMC006)

    async def one(seed: int) -> None:
        talker = random_host.play(seed, bench.config)
        result = await play(bench, talker.host.tape)
        assert result.edges_compared > 200, f"seed {seed} did next to nothing"

    await each_seed("p006_random_host", one)
