"""Test cases for reports about blocks that never respond (tests/common/harness/test_stalled.py).

They test no block.
"""

from __future__ import annotations

import cocotb

from ..harness import Block, BlockDriver

BLOCKS = {"sync": Block("ppmc_sync", "d_i q1_o q2_o", {"ResetVal": 0})}


@cocotb.test()
async def waits_for_an_edge(dut):
    """The clock runs freely while the test waits for an output that never rises."""
    u = BlockDriver(dut, "sync", BLOCKS, "q2_o", BlockDriver.FREE)
    await u.reset()
    await u.run_until("q2_o", 1)


@cocotb.test()
async def polls(dut):
    """After each cycle, a separate function polls an output that never rises."""
    u = BlockDriver(dut, "sync", BLOCKS, "q2_o", 3_000)

    async def risen() -> None:
        while not await u.clk():
            pass

    await u.reset()
    await risen()
