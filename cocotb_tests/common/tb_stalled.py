"""Not tests of a block: what is said of blocks that never answer (tests/common/harness/test_stalled.py)."""

from __future__ import annotations

import cocotb

from ..harness import Block, Unit

BLOCKS = {"sync": Block("ppmc_sync", "d_i q1_o q2_o", {"ResetVal": 0})}


@cocotb.test()
async def waits_for_an_edge(dut):
    """An output that never rises, under a clock that runs by itself."""
    u = Unit(dut, "sync", BLOCKS, "q2_o", Unit.FREE)
    await u.reset()
    await u.run_until("q2_o", 1)


@cocotb.test()
async def polls(dut):
    """An output that never rises, looked at after each clk, in a function of its own."""
    u = Unit(dut, "sync", BLOCKS, "q2_o", 3_000)

    async def risen() -> None:
        while not await u.clk():
            pass

    await u.reset()
    await risen()
