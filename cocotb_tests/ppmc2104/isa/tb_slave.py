"""ppmc_isa alone, with one part and no source register, as on the J105 board."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import Block, BlockDriver, rng, same

PORTS = "sa_i:10 aen_i ior_ni iow_ni sd_o:8 sd_oe_o irq_o cs_no:{n} a0_o d_i:{d} d_oe_i:{n} int_ni:{n}"
BLOCKS = {
    "one": Block("ppmc_isa", PORTS.format(n=1, d=8)),
    "three": Block("ppmc_isa", PORTS.format(n=3, d=24), {"Parts": 3, "Source": 1, "Base": 0x2F8}),
}


@cocotb.test()
async def isa_slave_one_part(dut: Any) -> None:
    """With one part at 3B0h, the addresses 3B0h and 3B1h select the part unless AEN is high; IOR enables the
    data bus.
    """
    unit = BlockDriver(dut, "one", BLOCKS, "cs_no a0_o sd_oe_o sd_o irq_o")
    await unit.reset(int_ni=1, ior_ni=1, iow_ni=1)
    for address in range(1024):
        for aen in (0, 1):
            mine = int(not aen and address >> 1 == 0x3B0 >> 1)
            for ior, iow in ((1, 1), (0, 1), (1, 0), (0, 0)):
                got = await unit.settle(sa_i=address, aen_i=aen, ior_ni=ior, iow_ni=iow, d_i=0xA5, d_oe_i=1)
                driven = int(mine and not ior and iow)
                same(
                    f"sa {address:03X}h aen {aen} ior {ior} iow {iow}",
                    got[:3],
                    (1 - mine, address & 1, driven),
                )
                same("sd_o", got[3], 0xA5)
    await unit.settle(sa_i=0x3B1, aen_i=0, ior_ni=0, iow_ni=1, d_oe_i=0)
    same("sd_oe_o without the part", unit.get("sd_oe_o"), 0)
    for level in (0, 0, 1, 0, 1, 1):
        await unit.clk(int_ni=level)
        same("irq_o after one cycle", (await unit.settle())[4], 1 - level)


@cocotb.test()
async def isa_slave_three_parts(dut: Any) -> None:
    """With three parts and the source register at 2F8h, each address belongs to at most one of them."""
    unit = BlockDriver(dut, "three", BLOCKS, "cs_no sd_oe_o sd_o")
    await unit.reset(int_ni=7, ior_ni=1, iow_ni=1)
    data, random = 0x332211, rng()
    for address in [*range(0x2F0, 0x308), *(random.randrange(1024) for _ in range(200))]:
        part = (address - 0x2F8) // 2 if 0x2F8 <= address < 0x2FE else None
        interrupts = random.randrange(8)
        await unit.clk(sa_i=address, ior_ni=1, d_i=data, d_oe_i=0, int_ni=interrupts)
        await unit.clk(ior_ni=0)
        got = await unit.settle(d_oe_i=0 if part is None else 1 << part)
        same(f"cs_no at {address:03X}h", got[0], 7 if part is None else 7 & ~(1 << part))
        same(f"sd_oe_o at {address:03X}h", got[1], int(part is not None or address == 0x2FE))
        if part is not None:
            same(f"sd_o at {address:03X}h", got[2], data >> 8 * part & 0xFF)
        elif address == 0x2FE:
            same("source", got[2], 7 & ~interrupts)
        await unit.clk(ior_ni=1, d_oe_i=0)


@cocotb.test()
async def isa_slave_write_of_the_source(dut: Any) -> None:
    """While an interrupt is pending, irq is low only during a write to the source register."""
    unit = BlockDriver(dut, "three", BLOCKS, "irq_o")
    await unit.reset(int_ni=5, ior_ni=1, iow_ni=1, aen_i=0, sa_i=0)
    await unit.clk()
    for address in (*range(0x2F8, 0x300), 0x3FE, 0x2EE, 0x0FE):
        for aen in (0, 1):
            for ior in (0, 1):
                arms = address == 0x2FE and not aen and ior
                await unit.clk(sa_i=address, aen_i=aen, ior_ni=1, iow_ni=1)
                same("irq before", await unit.settle(), 1)
                for _ in range(3):
                    await unit.clk(ior_ni=ior, iow_ni=0)
                    what = f"irq in a write of {address:03X}h, aen {aen}, ior {ior}"
                    same(what, await unit.settle(), int(not arms))
                await unit.clk(ior_ni=1, iow_ni=1)
                same("irq after", await unit.settle(), 1)
    await unit.clk(int_ni=7)
    await unit.clk(sa_i=0x2FE, iow_ni=0)
    await unit.clk(iow_ni=1)
    same("irq without a cause", await unit.settle(), 0)
    other = BlockDriver(dut, "one", BLOCKS, "irq_o")
    await other.reset(int_ni=0, ior_ni=1, iow_ni=1, aen_i=0, sa_i=0x3B2)
    for address in range(0x3B0, 0x3B8):
        await other.clk(sa_i=address, iow_ni=0)
        await other.clk()
        same(f"irq of a slave without source, write of {address:03X}h", await other.settle(), 1)
        await other.clk(iow_ni=1)
