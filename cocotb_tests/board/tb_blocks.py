"""Contracts of ppmc_board_reset and ppmc_board_led_stretch, as stated in their headers."""

from __future__ import annotations

import cocotb

from cocotb_tests.harness import Block, BlockDriver, rng, same
from cocotb_tests.harness.blocks import NO_STAGES
from cocotb_tests.harness.collect import exact
from cocotb_tests.harness.jitter import jitters

RESETS = [(1_000_000, 20), (3_000_000, 7), (24_000_000, 2), (50_000_000, 1)]  # ClkHz, HoldUs
LED_CLK_HZ = 1_000_000
BLOCKS = {
    **{
        f"reset{i}": Block(
            "ppmc_board_reset", "clk_i lock_i req_ni rst_no", {"ClkHz": clk, "HoldUs": hold}, bare=True
        )
        for i, (clk, hold) in enumerate(RESETS)
    },
    "led": Block("ppmc_board_led_stretch", "on_i led_o", {"ClkHz": LED_CLK_HZ}),
}


async def clocks_to_release(unit: BlockDriver, limit: int) -> int:
    """Return the number of clock edges from now until rst_no is 1; at most `limit`."""
    for count in range(limit):
        if await unit.settle():
            return count
        await unit.clk()
    raise AssertionError(f"still in reset after {limit} cycles")


@cocotb.test()
async def board_reset_release(dut):
    """After power-on, loss of lock, or a bouncing button, the reset ends HoldUs to 2 * HoldUs µs after all
    inputs are inactive.
    """
    random, more = rng(), int(jitters())  # with JITTER=1, a change of the button may be one cycle late
    for i, (clk_hz, hold_us) in enumerate(RESETS):
        unit = BlockDriver(dut, f"reset{i}", BLOCKS, "rst_no")
        least = clk_hz // 1_000_000 * hold_us
        unit.put(lock_i=1, req_ni=1)
        unit.choose()
        if i == 0:  # the initial register values alone cause a reset, without a loss of lock
            first = await clocks_to_release(unit, 3 * least)
            assert least <= first <= 2 * least + 3, f"power-on: {first} cycles of {least}"
        for what in ("lock_i", "req_ni"):
            await unit.clk(lock_i=1, req_ni=1)
            for _ in range(5):  # the button bounces
                for level in (0, 1):
                    for _ in range(random.randrange(3, max(4, least)) + more):
                        await unit.clk(**{what: level})
                    if not level:
                        same(f"{what} low", await unit.settle(), 0)
            for _ in range(3 + more):
                await unit.clk(**{what: 0})
            unit.put(**{what: 1})
            count = await clocks_to_release(unit, 3 * least + 3 + more)
            assert least <= count <= 2 * least + 4 + more, f"{what} {clk_hz}: {count} cycles, least {least}"


@cocotb.test()
async def board_reset_assertion(dut):
    """lock_i = 0 resets immediately and without a clock. req_ni = 0 resets on the third edge that samples
    it; with JITTER=1, also on the fourth one.
    """
    clk_hz, hold_us = RESETS[2]
    unit = BlockDriver(dut, "reset2", BLOCKS, "rst_no")
    unit.put(lock_i=1, req_ni=1)
    unit.choose()
    await clocks_to_release(unit, 200)
    same("lock lost", await unit.settle(lock_i=0), 0)
    unit.put(lock_i=1)
    await clocks_to_release(unit, 3 * clk_hz // 1_000_000 * hold_us)
    edges = set()
    for _ in range(16):
        seen = [await unit.clk(req_ni=0) for _ in range(6)]
        edges.add(seen.index(0))
        same("levels before edges 1 to 6 with req_ni = 0", seen, sorted(seen, reverse=True))
        unit.put(req_ni=1)
        await clocks_to_release(unit, 3 * clk_hz // 1_000_000 * hold_us)
    same("edges that reset", edges, {3, 4} if jitters() else {3})


@exact(NO_STAGES)
@cocotb.test()
async def board_led_stretch(dut):
    """A single-cycle pulse lights the LED for 1/32 to 1/16 s; a new pulse during this time extends it."""
    unit = BlockDriver(dut, "led", BLOCKS, "led_o")
    await unit.reset()
    same("after reset", await unit.clk(on_i=0), 0)
    await unit.clk(on_i=1)
    lit, again = 0, LED_CLK_HZ // 64
    while await unit.clk(on_i=int(lit == again)):
        lit += 1
        assert lit < LED_CLK_HZ, "LED stays on"
    least = LED_CLK_HZ // 32
    assert least + again <= lit <= 2 * least + again + 2, f"{lit} cycles"
