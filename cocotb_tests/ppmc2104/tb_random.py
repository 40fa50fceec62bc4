"""Constrained-random hosts, compared with the golden model edge by edge."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import random_test, start_bench
from cocotb_tests.harness.player import describe
from cocotb_tests.harness.run_context import note
from cocotb_tests.ppmc2104.random_host import scenario
from cocotb_tests.ppmc2104.random_player import HostPlayer

from .bench import PPMC2104


@random_test(
    "P2104-GEN-07",
    "P2104-BUS-01",
    "P2104-BUS-02",
    "P2104-BUS-07",
    "P2104-STA-06",
    "P2104-ERR-04",
    "P2104-HSK-02",
    "P2104-CMD-03",
    "P2104-FSM-01",
    "P2104-BCK-03",
    "P2104-PRO-04",
    "P2104-TIM-04",
    "P2104-LIM-09",
    "P2104-INT-02",
    "P2104-BAD-23",
    "P2104-BAD-26",
    least=10,
)
async def p2104_random_host(dut: Any, seed: int) -> None:
    """During the transactions of a random host, all outputs change as in the golden model."""
    plan = scenario(seed)
    bench = await start_bench(dut, PPMC2104, **plan.pins)
    note(bench, describe(plan.actions))
    await HostPlayer(bench, plan).run()
