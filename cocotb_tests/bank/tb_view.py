"""Contract of ppmc_bank_axis_port (docs/bank/carrier.md), and the requirements of BANK-WIN-04 for strobes."""

from __future__ import annotations

from typing import Any

import cocotb

from ..harness import Block, BlockDriver, rng, same

AREA = "bank_view"
GROUPS = ("ppmc_bank_carrier",)
BLOCKS = {
    "view": Block("ppmc_bank_axis_port", "cs_ni wr_ni a_i:4 d_i:8 d_o:8 cs_no a_o:10 bank_d_i:8 axis_o:8"),
}
CHOICE = 3
AXES = 64
WRITE_CLK, READ_CLK, GAP_CLK = 4, 6, 4
STEADY = 2
"""Number of rising edges of `clk` that sample the address, including the first that samples the strobe
(BANK-WIN-04).
"""


class Bridge:
    """Strobes of UB-BUS-01 at the host side of ppmc_bank_axis_port.

    `seen` lists (cs_n, address) at the bank for every cycle.
    """

    def __init__(self, dut: Any) -> None:
        self.unit = BlockDriver(dut, "view", BLOCKS, "cs_no a_o d_o")
        self.seen: list[tuple[int, int]] = []

    async def _clk(self, **inputs: int) -> int:
        cs_n, address, data = await self.unit.clk(**inputs)
        self.seen.append((cs_n, address))
        return data

    async def access(self, a: int, value: int | None = None, shown: int = 0) -> int:
        """Make one access while the bank outputs the byte `shown`; return the byte on the bus in the last
        cycle.
        """
        data = 0
        await self._clk(a_i=a, d_i=value or 0, bank_d_i=shown)
        for _ in range(READ_CLK if value is None else WRITE_CLK):
            data = await self._clk(cs_ni=0, wr_ni=value is None)
        for _ in range(GAP_CLK - 1):
            await self._clk(cs_ni=1, wr_ni=1)
        return data

    def strobes(self) -> list[tuple[int, int]]:
        """Return (address, cycles) of the strobes at the bank.

        Raise AssertionError if an address is not stable.
        """
        found = []
        for n, (cs_n, address) in enumerate(self.seen):
            if cs_n:
                continue
            if self.seen[n - 1][0]:
                found.append((address, 0))
                around = [there for _, there in self.seen[n - STEADY + 1 : n + 1]]
                same(f"cycle {n}: address before the strobe", around, [address] * STEADY)
            same(f"cycle {n}: address in the strobe", address, found[-1][0])
            found[-1] = (address, found[-1][1] + 1)
        return found


async def start(dut: Any) -> Bridge:
    """Return a bridge in front of a ppmc_bank_axis_port that was reset."""
    bridge = Bridge(dut)
    await bridge.unit.reset(cs_ni=1, wr_ni=1)
    return bridge


@cocotb.test()
async def view_random_accesses(dut):
    """Each random access reaches the chosen axis; 0x3 chooses the axis and returns its number."""
    rand, bridge = rng(), await start(dut)
    axis, want = 0, []
    for _ in range(600):
        a, shown = rand.choice((CHOICE, rand.randrange(16))), rand.getrandbits(8)
        value = rand.choice((None, rand.randrange(AXES), rand.getrandbits(8)))
        got = await bridge.access(a, value, shown)
        if a == CHOICE:
            axis = axis if value is None else value
            same("0x3", bridge.unit.get("axis_o"), axis)
        elif axis < AXES:
            want.append((16 * axis + a, READ_CLK if value is None else WRITE_CLK))
        if value is None:
            same(f"axis {axis}, register {a}", got, axis if a == CHOICE else shown if axis < AXES else 0xFF)
    same("strobes at the bank", bridge.strobes(), want)
    assert len({address for address, _ in want}) > 100


@cocotb.test()
async def view_axes_that_the_window_lacks(dut):
    """If an axis of 64 to 255 is chosen, reads return FF, the bank receives no strobe, and 0x3 can still
    choose another axis.
    """
    bridge = await start(dut)
    for axis in (64, 128, 192, 255):
        await bridge.access(CHOICE, axis)
        same("register 0", await bridge.access(0, None, 0x5A), 0xFF)
        await bridge.access(1, 0x43)
        same("0x3", await bridge.access(CHOICE), axis)
    same("strobes", bridge.strobes(), [])
    await bridge.access(CHOICE, 63)
    same("register 0", await bridge.access(0, None, 0x5A), 0x5A)
    same("strobes", bridge.strobes(), [(0x3F0, READ_CLK)])


@cocotb.test()
async def view_reset(dut):
    """A reset of the bank chooses axis 0."""
    bridge = await start(dut)
    await bridge.access(CHOICE, 17)
    same("chosen", await bridge.access(CHOICE), 17)
    await bridge.unit.reset(cs_ni=1, wr_ni=1)
    same("after reset", await bridge.access(CHOICE), 0)
