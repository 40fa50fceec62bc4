"""Tests of the board j105_stmc (rules J105-01 to J105-08, acceptance checks AC-46 and AC-47)."""

from __future__ import annotations

from typing import Any

from cocotb.triggers import Timer

from cocotb_tests.harness import F8, F16, IBF, OBF, directed, rtl_only
from cocotb_tests.harness.isa import Times

from .board import OTHER, BoardEnv
from .expected_timing import A, gaps
from .tb_acceptance_moves import W1

NANOSECONDS = "the ISA bus has cycles of nanoseconds, and the model only clk edges"


@rtl_only(NANOSECONDS)
@directed("AC-46", "J105-01", "J105-02", "J105-05", "J105-07")
async def j105_ac_46_a_move(dut: Any) -> None:
    """On the board, the stimulus of AC-05 results in the same steps; drv follows s, and irq is asserted
    (AC-46).
    """
    env = await BoardEnv.start(dut)
    bench = env.bench
    await env.init(0x1A, *A)
    env.check("AC-46", "irq", bench.level("irq"), 0)
    env.since = bench.now
    await env.host.run("c 43 d 13 d 00 d 00")
    end = await env.wait_end(600_000)
    env.window("J105-05", "last step to irq", end - env.pulses[-1], 0, 10)
    ticks = [round(gap * 48_675 / 16_000_000) for gap in env.intervals]
    env.check("AC-46", "gaps in ticks", ticks, W1)
    expected = [(t, level & 15) for t, level in bench.edges("s", env.since)]
    env.check("J105-07", "drv", bench.edges("drv", env.since), expected)
    env.check("AC-46", "irq", bench.level("irq"), 1)
    env.check("AC-46", "FIN", await env.finish(), 0x83)
    env.check("AC-46", "irq after 80", bench.level("irq"), 0)


@rtl_only(NANOSECONDS)
@directed("AC-46", "J105-01", "J105-03", builds=(F16, OTHER))
async def j105_01_addresses(dut: Any) -> None:
    """With aen low, only the two addresses of the board respond, of all addresses near them; with aen high,
    these two do not respond either (J105-01).
    """
    env = await BoardEnv.start(dut)
    master, base = env.master, env.base
    around = {base ^ bit for bit in (1 << n for n in range(1, 10))} | {base - 1, base + 2, base + 3}
    for address in sorted(around):
        await master.write(address & 0x3FF, 0x43)
        driven, _, _ = await master.read(address & 0x3FF)
        env.check("J105-01", f"sd_oe at {address:#x}", driven, 0)
    for address in (base, base + 1):
        await master.write(address, 0x43, aen=1)
        driven, _, _ = await master.read(address, aen=1)
        env.check("J105-01", f"sd_oe with aen at {address:#x}", driven, 0)
    env.check("J105-01", "status", await env.host.status(), 0)
    env.check("J105-01", "data register", await env.host.read(0), 0)
    env.check("J105-01", "a command", await env.host.command(0x42), 0xA0)
    env.check("J105-01", "a data byte", await env.host.data(0x42), 0xB0)


@rtl_only(NANOSECONDS)
@directed("J105-03", "J105-04", builds=(F16, F8))
async def j105_03_bus_is_released_at_once(dut: Any) -> None:
    """If ior_n, sa or aen ends a read at any phase to clk, sd_oe falls immediately (J105-03)."""
    env = await BoardEnv.start(dut)
    bench = env.bench
    await env.host.command(0xC0)
    for part in range(8):
        for end in ({"ior_n": 1}, {"aen": 1}, {"sa": 0x000}):
            await bench.align()
            await Timer(bench.period * part // 16 * 2 + 2, "ps")
            bench.set_between_edges(sa=env.base + 1, aen=0)
            await Timer(100_000, "ps")
            bench.set_between_edges(ior_n=0)
            await Timer(600_000 + 2, "ps")
            await bench.align()
            await Timer(bench.period // 8 * 2 + 2, "ps")
            got = bench.level("sd_oe"), bench.level("sd_o")
            bench.set_between_edges(**end)
            await Timer(4, "ps")
            env.check("J105-03", f"sd_oe after {end}", bench.level("sd_oe"), 0)
            env.check("J105-04", "sd_oe and status", got, (1, 0x80))
            bench.set_between_edges(ior_n=1)
            await bench.align()
            await bench.clocks(6)
            bench.set_between_edges(aen=0)
            await bench.clocks(2)


@rtl_only(NANOSECONDS)
@directed("AC-47", "J105-06", builds=(F16,))
async def j105_ac_47_step_clock(dut: Any) -> None:
    """At divisor 141 on 48.675 kHz, the intervals of 21 steps are exact, without drift (AC-47)."""
    env = await BoardEnv.start(dut)
    await env.init(0x1A, 141, 141, 0)
    env.since = env.bench.now
    await env.host.run("c 43 d 14 d 00 d 00")
    await env.wait_end(1_500_000)
    steps = env.pulses
    env.check("AC-47", "steps", len(steps), 21)
    env.window("AC-47", "sum of the gaps", steps[-1] - steps[0], 926_963, 926_966)
    for gap in env.intervals:
        env.window("AC-47", "gap", gap, 46_346, 46_350)


@rtl_only(NANOSECONDS)
@directed("J105-06", "J105-08", builds=(F8, OTHER))
async def j105_06_other_clocks(dut: Any) -> None:
    """With other core clocks and step clocks, each step of a ramp occurs at the time that EXT_HZ determines
    (J105-06).
    """
    env = await BoardEnv.start(dut)
    ext_hz = int(dict(env.cfg.extra).get("EXT_HZ", 48_675))
    await env.init(0x1A, 20, 5, 8)
    env.since = env.bench.now
    await env.host.run("c 43 d 0B d 00 d 00")
    await env.wait_end(2_000_000)
    ticks = 0
    for step, gap in zip(env.pulses[1:], gaps(12), strict=True):
        ticks += gap
        exact = ticks * env.cfg.clk_hz / ext_hz
        env.window(
            "J105-06", f"step after {ticks} ticks", step - env.pulses[0], int(exact) - 2, int(exact) + 3
        )


@rtl_only(NANOSECONDS)
@directed("J105-07", "J105-02", "J105-06")
async def j105_07_drivers(dut: Any) -> None:
    """With 5 phases, negative logic and the chopper, drv equals s[4:1], during steps and at standstill
    (J105-07).
    """
    env = await BoardEnv.start(dut)
    bench = env.bench
    for code in (0x2F, 0x22, 0x2E):
        await bench.align()
        bench.set(rst_n=0)
        await bench.clocks(3)
        bench.set(rst_n=1)
        await bench.clocks(6)
        await env.init(code, 9, 3, 3)
        await env.move(0x44, 4, 2)
        await bench.clocks(6_000)
        await env.finish()
    expected: list[tuple[int, int]] = []
    last = 0
    for t, level in bench.edges("s"):
        if level & 15 != last:
            last = level & 15
            expected.append((t, last))
    env.check("J105-07", "edges of drv", bench.edges("drv"), expected)
    env.check("J105-07", "edges seen", len(expected) > 20, True)


@rtl_only(NANOSECONDS)
@directed("J105-05", "STMC-MOT-09")
async def j105_05_interrupt(dut: Any) -> None:
    """irq rises at the end of a motion only if bit 4 of its code is 0; irq falls when code 80 is accepted,
    not when the answer to this code is read (J105-05).
    """
    env = await BoardEnv.start(dut)
    await env.init(0x0A, 9, 3, 3)
    await env.move(0x52)
    env.check("J105-05", "irq", env.bench.edges("irq"), [])
    await env.move(0x42)
    await env.bench.clocks(4)
    env.check("J105-05", "irq", env.bench.level("irq"), 1)
    await env.host.command(0x80)
    env.check("J105-05", "irq after 80", env.bench.level("irq"), 0)
    env.check("J105-05", "FIN", await env.host.read_data(), 0x82)


@rtl_only(NANOSECONDS)
@directed("J105-02", "STMC-BAD-13")
async def j105_02_short_cycles(dut: Any) -> None:
    """Accesses of 2 ns to 5 cycles, at any phase to clk, are executed completely or not at all (J105-02)."""
    env = await BoardEnv.start(dut)
    bench, master, rng = env.bench, env.master, env.bench.rng
    # The data changes with the strobe, so only the length of the strobe matters.
    master.times = Times(late=0)
    clk_ns = bench.period / 1000
    done = missed = 0
    for _ in range(150):
        await env.host.command(0xC0)
        length = rng.choice((rng.uniform(0.02, 1.5), rng.uniform(0.02, 5.0))) * clk_ns
        await Timer(rng.randrange(0, bench.period, 2), "ps")
        await master.write(env.base + 1, 0x0A, command=length)
        await bench.clocks(12)
        status = await env.host.status()
        env.check("STMC-BAD-13", f"status {status:#x} is 80 or 40", status in (0x80, 0x40), True)
        if length >= 3 * clk_ns:
            env.check("J105-02", f"status after a write of {length:.0f} ns", status, 0x40)
        done, missed = done + (status == 0x40), missed + (status == 0x80)
        await env.host.command(0x81)
        await Timer(rng.randrange(0, bench.period, 2), "ps")
        await master.read(env.base, command=length)
        await bench.clocks(12)
        gone = not await env.host.status() & OBF
        short = length < 5 * clk_ns
        env.check("STMC-BAD-13", f"byte gone after {length:.0f} ns", gone or short, True)
        env.check("STMC-BAD-13", "byte", await env.host.read(0), 0xCF)
    env.check("STMC-BAD-13", f"{done} done, {missed} missed", done > 20 and missed > 20, True)


@rtl_only(NANOSECONDS)
@directed("J105-01", "STMC-INI-07", "STMC-BAD-12")
async def j105_01_cycles_in_the_table_build(dut: Any) -> None:
    """Accesses to other addresses, accesses masked by aen, and illegal accesses do not disturb a table build
    (J105-01).
    """
    env = await BoardEnv.start(dut)
    bench, master = env.bench, env.master
    await env.host.init(0x1A, 255, 1, 60)
    for n in range(12):
        await master.write((env.base ^ 1 << n % 9 + 1) + 1, 0x42)
        await master.write(env.base + 1, 0x40, aen=1)
        await master.read(env.base + 1, aen=1)
        await bench.align()
        bench.set(sa=env.base + 1, sd_i=0x42)
        await bench.clocks(2)
        bench.set(ior_n=0, iow_n=0)
        await bench.clocks(6)
        bench.set(ior_n=1, iow_n=1)
        await bench.clocks(6)
        env.check("J105-01", "status in the build", await env.host.status(), 0)
    env.check("STMC-INI-07", "a byte waits for the build", await env.host.write(1, 0x80) > 0, True)
    env.check("STMC-INI-07", "IBF", await env.host.status(), IBF)
    await env.host.poll(IBF, 0, 40_000)
    env.check("STMC-INI-07", "FIN", await env.host.read(0), 0x80)
    env.since = bench.now
    await env.host.run("c 43 d 03 d 00 d 00")
    await env.wait_end(600_000)
    ticks = [round(gap * 48_675 / 16_000_000) for gap in env.intervals]
    env.check("J105-01", "gaps in ticks", ticks, gaps(4, (255, 1, 60)))


@rtl_only(NANOSECONDS)
@directed("STMC-INP-01", "STMC-HLD-01", "STMC-CHP-01", "STMC-DS-03", "J105-07", builds=(OTHER,))
async def j105_all_parameters(dut: Any) -> None:
    """If all parameters have other values, codes and times follow these parameters (J105-07, STMC-DS-03)."""
    env = await BoardEnv.start(dut)
    bench = env.bench
    await env.init(0x2A, 9, 3, 3)
    env.check("STMC-INP-01", "inputs by the code of related devices", await env.inputs(), 0xCF)
    await env.move(0x42)
    end = await env.wait_end()
    delay = env.cfg.cyc(2_500)
    env.window("STMC-HLD-01", "hold", await bench.edge("hold", 1) - end, delay - 2, delay + 16)
    await bench.clocks(env.cfg.cyc(3 * 1_012))
    slack = env.cfg.cyc(4) + 1
    for level, clk in env.stretches(end)[1:]:
        nominal = env.cfg.cyc(401 if level else 611)
        env.window("STMC-CHP-01", f"cycles of s = {level}", clk, nominal - slack, nominal + slack)
