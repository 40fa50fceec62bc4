"""Addresses, AEN, lengths of accesses, resets, and the source register of isa_4axis."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import Timer

from cocotb_tests.harness import F8, F16, F25, configs

from ...harness.isa import Times
from .models import check_both
from .setting import BASE, ISA_4AXIS, PHASES, SOURCE, Setting

AUX = (0xC1, 0xD1, 0xE1, 0xF1)  # auxiliary output codes
AUX_LEVELS = {0xC1: 0b11, 0xD1: 0b10, 0xE1: 0b01, 0xF1: 0b00}
DATA_A, CODE_A, DATA_B, CODE_B = range(BASE, BASE + 4)


@cocotb.test()
@configs(F16, F8)
async def isa_registers(dut: Any) -> None:
    """After reset, each part responds at its addresses only (ISA-02, ISA-09)."""
    setting = await Setting.start(dut)
    bench, (a, b) = setting.bench, setting.hosts
    levels = ISA_4AXIS.reset_levels()
    got = {name: bench.level(name) for name in levels if name != "clk_o"}
    bench.check("ISA-09", "levels after reset", got, {n: v for n, v in levels.items() if n != "clk_o"})
    bench.check("ISA-02", "status of both", (await a.status(), await b.status()), (0, 0))
    await b.command(0xD1)
    bench.check("ISA-02", "auxo after D1 to part B", bench.level("auxo"), 0b1011)
    await a.command(0xE1)
    bench.check("ISA-02", "auxo after E1 to part A", bench.level("auxo"), 0b1001)
    await bench.align()
    bench.set(auxi=0b0110)
    await bench.clocks(8)
    bench.check("ISA-02", "AUXI of A and B", (await a.run("c C2 r"), await b.run("c C2 r")), ([2], [1]))
    bench.check("ISA-02", "data registers", (await a.read(0), await b.read(0)), (2, 1))
    await b.run("d 55")
    bench.check("ISA-02", "ERROR of B only", (await a.status(), await b.status()), (0x00, 0x80))
    check_both(bench, at_least=8)


@cocotb.test()
async def isa_other_addresses(dut: Any) -> None:
    """If the module has the base address 300h, accesses to other addresses do not drive the bus and change
    nothing.
    """
    setting = await Setting.start(dut)
    bench, master = setting.bench, setting.master
    await setting.hosts[0].run("c D1 c 42")
    await setting.hosts[1].run("c E1")
    since = bench.now
    for address in range(1024):
        if BASE <= address <= SOURCE:
            continue
        for code in (0xF1, 0x55):
            await master.write(address, code)
        driven, _, _ = await master.read(address)
        bench.check("ISA-01", f"sd_oe at {address:03X}h", driven, 0)
    for address in range(BASE, BASE + 8):
        await master.write(address, 0xF1, aen=1)
        driven, _, _ = await master.read(address, aen=1)
        bench.check("ISA-01", f"sd_oe at {address:03X}h with AEN", driven, 0)
    await master.write(SOURCE, 0xF1)
    bench.check("ISA-01", "sd_oe", bench.edges("sd_oe", since), [])
    bench.check("ISA-01", "auxo", bench.level("auxo"), 0b0110)
    a, b = setting.hosts
    bench.check("ISA-01", "status of A and B", (await a.status(), await b.status()), (0x80, 0x00))
    bench.check("ISA-01", "error of A: the one it had", await a.run("c 86 r"), [4])
    check_both(bench)


@cocotb.test()
@configs(F16, F8)
async def isa_short_cycles(dut: Any) -> None:
    """Accesses of 2 ns to 1.5 cycles, at any phase to `clk`, are each executed completely or not at all."""
    setting = await Setting.start(dut)
    bench, master, rng = setting.bench, setting.master, setting.bench.rng
    # The data changes with the strobe, so only the length of the strobe matters.
    master.times = Times(late=0)
    clk_ns = bench.period / 1000
    done = missed = 0
    shown = [0b11, 0b11]
    for _ in range(300):
        number, code = rng.randrange(2), rng.choice(AUX)
        length = rng.uniform(0.02, 1.5) * clk_ns
        await Timer(rng.randrange(0, bench.period, 2), "ps")
        await master.write((CODE_A, CODE_B)[number], code, command=length)
        await bench.clocks(12)
        level = bench.level("auxo") >> 2 * number & 3
        new = AUX_LEVELS[code]
        assert level in (shown[number], new), f"ISA-04: auxo {level:02b} after {code:02X}"
        if length >= clk_ns + 10:
            bench.check("ISA-04", f"auxo after a command of {length:.1f} ns", level, new)
        if new != shown[number]:
            done, missed = done + (level == new), missed + (level != new)
        shown[number] = level
        length = rng.uniform(0.02, 1.5) * clk_ns
        await Timer(rng.randrange(0, bench.period, 2), "ps")
        driven, byte, _ = await master.read((CODE_A, CODE_B)[number], command=length)
        if length >= clk_ns + 20:
            bench.check("ISA-05", f"sd_oe, status after {length:.1f} ns", (driven, byte & 0xFC), (1, 0))
    assert done > 20, f"{done} cycles done"
    assert missed > 20, f"{missed} cycles missed"
    check_both(bench, at_least=100)


@cocotb.test()
async def isa_both_commands(dut: Any) -> None:
    """If IOR and IOW are low together, the module drives nothing and stores nothing."""
    setting = await Setting.start(dut)
    bench = setting.bench
    for address in range(BASE, SOURCE + 1):
        since = bench.now
        bench.set(sa=address, sd_i=0xF1)
        await bench.clocks(2)
        bench.set(ior_n=0, iow_n=0)
        await bench.clocks(9)
        bench.set(ior_n=1, iow_n=1)
        await bench.clocks(9)
        bench.check("ISA-04", f"sd_oe at {address:03X}h", bench.edges("sd_oe", since), [])
    bench.check("ISA-04", "auxo", bench.level("auxo"), 0b1111)
    a, b = setting.hosts
    bench.check("ISA-04", "status", (await a.status(), await b.status()), (0, 0))
    check_both(bench)


@cocotb.test()
async def isa_address_moves_away(dut: Any) -> None:
    """If the address changes from part A to part B or to another device during a read of part A, or if AEN
    rises, part A stops driving the bus immediately.
    """
    setting = await Setting.start(dut)
    bench = setting.bench
    await setting.hosts[0].run("c 42")
    for away in ({"sa": 0x3F0}, {"aen": 1}, {"ior_n": 1}):
        await bench.align()
        bench.set(sa=CODE_A, aen=0)
        await bench.clocks(2)
        bench.set(ior_n=0)
        await bench.clocks(4)
        bench.check("ISA-05", "sd_oe, status of A", (bench.level("sd_oe"), bench.level("sd_o")), (1, 0x80))
        bench.set(**away)
        await Timer(2, "ps")
        bench.check("ISA-05", f"sd_oe after {away}", bench.level("sd_oe"), 0)
        await bench.clocks(4)
        bench.set(ior_n=1, aen=0)
        await bench.clocks(4)
    bench.set(sa=CODE_A)
    await bench.clocks(2)
    bench.set(ior_n=0)
    await bench.clocks(4)
    bench.set(sa=CODE_B)
    await bench.clocks(4)
    bench.check("ISA-05", "sd_oe, status of B", (bench.level("sd_oe"), bench.level("sd_o")), (1, 0x00))
    bench.set(ior_n=1)
    await bench.clocks(4)
    check_both(bench)


@cocotb.test()
async def isa_resets(dut: Any) -> None:
    """If RESET DRV or rst_n is asserted between two edges while both parts are in motion, all pins take their
    reset levels immediately.
    """
    setting = await Setting.start(dut)
    bench = setting.bench
    moved = ("pout_n", "dir", "hold", "auxo", *PHASES)
    for pin, on in (("reset_drv", 1), ("rst_n", 0)):
        for axis in (1, 4):
            await setting.set_up(axis, 0x02, 9, 4, 4)
            # A CCW move, so that the level of dir differs from its reset level.
            await setting.axes[axis].go(0x4D, rate=9)
        for host in setting.hosts:
            await host.command(0xF1)
        await setting.axes[4].pulse(3, 5)
        await Timer(1000, "ps")
        bench.set_between_edges(**{pin: on})
        await Timer(2, "ps")
        levels = ISA_4AXIS.reset_levels()
        for name in (*moved, "irq", "sd_oe"):
            bench.check("ISA-09", f"{name} in reset by {pin}", bench.level(name), levels[name])
        await bench.clocks(4)
        bench.set(**{pin: 1 - on})
        await bench.clocks(5)
        for host in setting.hosts:
            bench.check(
                "ISA-09", "status, error of a move after reset", await host.run("s c 42 s"), [0, 0x80]
            )
            await host.run("c 86 r")


@cocotb.test()
@configs(F16, F25)
async def isa_source_register(dut: Any) -> None:
    """A read of base + 4 returns which of the parts A and B have an interrupt, and is stable during the read
    (ISA-07).
    """
    setting = await Setting.start(dut, errint_n=0)
    bench, master, (a, b) = setting.bench, setting.master, setting.hosts

    async def source() -> int:
        driven, byte, _ = await master.read(SOURCE)
        bench.check("ISA-07", "sd_oe of the source register", driven, 1)
        return byte

    seen = [await source()]
    await a.command(0x87)
    seen.append(await source())
    await b.command(0x87)
    seen.append(await source())
    await a.run("c 86 r")
    seen.append(await source())
    await b.run("c 86 r")
    seen.append(await source())
    bench.check("ISA-07", "source: none, A, A and B, B, none", seen, [0, 1, 3, 2, 0])
    # An interrupt of A occurs during a long read.
    await setting.set_up(1, 0x02, 9, 4, 4)
    await setting.axes[1].go(0x44, n=100, rate=49)
    last = bench.now + 99 * bench.config.cyc(1600)
    await bench.until(last - bench.config.us(20))
    bench.set(sa=SOURCE)
    await bench.clocks(2)
    bench.set(ior_n=0)
    since = bench.now
    await bench.edge("irq", 1)
    await bench.clocks(20)
    bench.check("ISA-07", "source during the read", bench.level("sd_o"), 0)
    bench.check("ISA-07", "changes of sd_o", [t for t, _ in bench.edges("sd_o", since + 2)], [])
    bench.set(ior_n=1)
    await bench.clocks(4)
    bench.check("ISA-07", "source afterwards", await source(), 1)
    check_both(bench)
