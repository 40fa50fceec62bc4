"""One random host per simulation; every output edge must be the golden model's."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.common.bench import Bench
from cocotb_tests.common.compare import check_against_model
from cocotb_tests.common.verifies import verifies
from cocotb_tests.ppmc104.random_host import scenario
from cocotb_tests.ppmc104.random_player import Player, describe


@cocotb.test()
@verifies(
    "P104-GEN-07",
    "P104-BUS-01",
    "P104-BUS-07",
    "P104-STA-06",
    "P104-ERR-01",
    "P104-HSK-02",
    "P104-CMD-04",
    "P104-FSM-01",
    "P104-BCK-03",
    "P104-PRO-04",
    "P104-TIM-04",
    "P104-LIM-09",
    "P104-BAD-19",
    "P104-BAD-23",
)
async def random_host(dut: Any) -> None:
    """Given a random host, when it has played its list, then all outputs changed as in the golden model."""
    plan = scenario(Bench(dut).seed)
    bench = await Bench.start(dut, **plan.pins)
    (bench.out / "scenario.txt").write_text(describe(plan.actions) + "\n", encoding="utf-8")
    await Player(bench, plan).play()
    result = check_against_model(bench)
    assert result.edges_compared > 10, f"the scenario did next to nothing ({result.edges_compared} edges)"
