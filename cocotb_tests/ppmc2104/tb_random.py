"""Random hosts, compared with the golden model edge by edge."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness.bench import Bench
from cocotb_tests.harness.compare import check_against_model
from cocotb_tests.harness.player import describe
from cocotb_tests.harness.seeds import each_seed
from cocotb_tests.harness.verifies import verifies
from cocotb_tests.ppmc2104.random_host import scenario
from cocotb_tests.ppmc2104.random_player import HostPlayer

from .bench import PPMC2104


@cocotb.test()
@verifies(
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
)
async def p2104_random_host(dut: Any) -> None:
    """Given a random host, when it has played its list, then all outputs changed as in the golden model."""

    async def play(seed: int) -> None:
        plan = scenario(seed)
        bench = await Bench.start(dut, PPMC2104, seed=seed, **plan.pins)
        (bench.out / "scenario.txt").write_text(describe(plan.actions) + "\n", encoding="utf-8")
        await HostPlayer(bench, plan).run()
        result = check_against_model(bench)
        assert result.edges_compared > 10, f"the scenario did next to nothing ({result.edges_compared} edges)"

    await each_seed("p2104_random_host", play)
