"""Bus accesses and the mailbox: STMC-BUS, STMC-BAD-09..13."""

from __future__ import annotations

from typing import Any

from cocotb.triggers import Timer

from cocotb_tests.harness import BUSY, COMMAND, D16, DATA, F16, IBF, OBF, STATUS, directed, rtl_only

from .env import C_EVENT_LATEST, PINS_LATEST, Env
from .expected_timing import F8X20, F200, INTERNAL, STANDARD

OFF = {"cs_n": 1, "rd_n": 1, "wr_n": 1}


async def strobe(env: Env, ps: int, gap_ps: int, **levels: int) -> None:
    """Make one host access that is asynchronous to `clk`.

    The levels last for `ps`; then the strobes are inactive for `gap_ps`.
    """
    env.bench.set_between_edges(**levels)
    await Timer(ps, "ps")
    env.bench.set_between_edges(**OFF)
    await Timer(gap_ps, "ps")


@directed("STMC-BUS-01", "STMC-BUS-02", "STMC-BUS-03", "STMC-BUS-04", "STMC-BUS-05")
async def stmc_bus_01_access_table(dut: Any) -> None:
    """For each combination of cs_n, a0 and strobes, only the selected register is accessed (STMC-BUS-01)."""
    env = await Env.start(dut, None)
    bench, host = env.bench, env.host
    env.check("STMC-BUS-04", "a0 = 0 writes data: error 3", await host.data(0x43), 0xB0)
    env.check("STMC-BUS-05", "a0 = 1 writes a command", await host.command(0x0A), 0x40)
    env.check("STMC-BUS-04", "a0 = 0 is its data", await host.data(0x14), 0x30)
    await host.command(0x81)
    env.check("STMC-BUS-03", "a0 = 1 reads status", await host.read(STATUS), OBF)
    env.check("STMC-BUS-02", "a0 = 0 reads data", await host.read(DATA), 0xCF)
    before = bench.edges("d_oe")
    for a0 in (0, 1):
        for levels in ({"rd_n": 0}, {"wr_n": 0}, {"rd_n": 0, "wr_n": 0}, {}):
            bench.set(a0=a0, d_i=0xC1, cs_n=1, **levels)
            await bench.clocks(6)
            bench.set(**OFF)
            await bench.clocks(6)
    bench.set(cs_n=0)
    await bench.clocks(6)
    bench.set(cs_n=1)
    await bench.clocks(12)
    env.check("STMC-BUS-01", "edges of d_oe with cs_n = 1", bench.edges("d_oe"), before)
    env.check("STMC-BUS-01", "status after accesses with cs_n = 1", await host.status(), 0x00)


@directed("STMC-BUS-06", "STMC-BUS-10", "STMC-BAD-12", exact="the data change with the end of the strobe")
async def stmc_bus_06_overlapping_strobes(dut: Any) -> None:
    """If a read strobe interrupts a write, the byte that was sampled before is stored once (STMC-BUS-06)."""
    env = await Env.start(dut, None)
    bench = env.bench
    since = bench.set(a0=COMMAND, d_i=0x0A, cs_n=0, wr_n=0)
    await bench.clocks(4)
    bench.set(rd_n=0, d_i=0xC1)
    await bench.clocks(14)
    env.check("STMC-BUS-06", "d_oe while both are low", bench.edges("d_oe", since), [])
    bench.set(**OFF)
    await bench.clocks(14)
    env.check("STMC-BUS-10", "status: only 0A was written", await env.host.status(), 0x40)
    first = bench.set(a0=STATUS, cs_n=0, rd_n=0)
    await bench.clocks(8)
    both = bench.set(wr_n=0, d_i=0xC1)
    await bench.clocks(8)
    bench.set(**OFF)
    await bench.clocks(14)
    (on, _), (off, _) = bench.edges("d_oe", first)
    env.window("STMC-BUS-20", "d_oe rise", on - first, 0, 4)
    env.window("STMC-BUS-06", "d_oe fall after wr_n joined", off - both, 0, 4)
    env.check("STMC-BUS-06", "status after the read", await env.host.status(), 0x40)


@directed("STMC-BUS-10", exact="the data change with the end of the strobe")
async def stmc_bus_10_what_ends_a_write(dut: Any) -> None:
    """If the data changes when wr_n, cs_n or rd_n ends a write, the byte before the change is stored
    (STMC-BUS-10).
    """
    env = await Env.start(dut, None)
    bench = env.bench
    for n, levels in enumerate(({"wr_n": 1}, {"cs_n": 1}, {"rd_n": 0}, {"wr_n": 1, "cs_n": 1})):
        bench.set(a0=DATA, d_i=0xFF, cs_n=0, wr_n=0)
        await bench.clocks(2)
        bench.set(a0=COMMAND, d_i=0x0A)
        await bench.clocks(2)
        bench.set(**levels, a0=DATA, d_i=0xC1)
        await bench.clocks(4)
        bench.set(**OFF)
        await bench.clocks(14)
        env.check("STMC-BUS-10", f"status of end {n}", await env.host.status(), 0x40)
        await env.host.command(0xC0)


@rtl_only("strobes at any phase to clk, and the model counts in cycles")
@directed("STMC-BUS-11", builds=(F16, F8X20, F200))
async def stmc_bus_11_shortest_cycles(dut: Any) -> None:
    """In the shortest legal accesses, at any phase to clk, no byte is missed (STMC-BUS-11)."""
    env = await Env.start(dut, None)
    bench = env.bench
    clk = bench.period
    for part in range(8):
        await bench.align()
        await Timer(clk * part // 16 * 2 + 2 * (clk // 64), "ps")
        # The levels are invalid until 2 cycles before the rise of the strobe.
        bench.set_between_edges(a0=0, d_i=0x55, cs_n=0, wr_n=0)
        await Timer(clk + 2, "ps")
        await strobe(env, 2 * clk, 12 * clk, a0=1, d_i=0x0A, cs_n=0, wr_n=0)
        await strobe(env, 3 * clk, 12 * clk, a0=0, d_i=20 + part, cs_n=0, wr_n=0)
        await strobe(env, 3 * clk, 12 * clk, a0=0, d_i=5, cs_n=0, wr_n=0)
        bench.set_between_edges(a0=1, cs_n=0, rd_n=0)
        await Timer(5 * clk, "ps")
        got = bench.level("d_oe"), bench.level("d_o")
        bench.set_between_edges(**OFF)
        await Timer(3 * clk, "ps")
        env.check("STMC-BUS-11", f"(d_oe, status), phase {part}/8", got, (1, 0x20))


@directed("STMC-BUS-12", "STMC-BUS-13")
async def stmc_bus_12_ibf_and_effects(dut: Any) -> None:
    """When IBF falls, the status contains every effect of the byte, and the pins follow within their limit
    (STMC-BUS-12, STMC-BUS-13).
    """
    env = await Env.start(dut)
    bench, host = env.bench, env.host
    script = ((1, 0x43, 0x30), (0, 9, 0x20), (0, 0, 0x10), (0, 0, BUSY), (1, 0x40, 0x00), (1, 0x81, OBF))
    for delay in range(1, 16):
        for reg, byte, after in script:
            since = bench.now
            edge0 = await host.write(reg, byte, gap=delay)
            status = await host.status()
            taken = not status & IBF
            env.check(
                "STMC-BUS-12", f"IBF {delay} cycles after the rise", taken or delay < C_EVENT_LATEST, True
            )
            if not taken:
                status = await host.poll(IBF, 0)
            if byte != 0x40:
                env.check("STMC-BUS-13", f"status of {byte:#x} after {delay} cycles", status, after)
            if after == BUSY:
                await bench.until(max(bench.now, edge0 + PINS_LATEST))
                env.check("STMC-BUS-13", "hold", bench.level("hold"), 0)
            if byte == 0x81:
                env.check("STMC-INP-01", "inputs", await host.read(DATA), 0xCF)
            if byte == 0x40:
                await env.idle()
                env.check("STMC-MOT-10", "int_n", bench.level("int_n"), 0)
                env.check("STMC-STP-01", "steps", bench.edges("s", since), [])


@directed("STMC-BUS-14", "STMC-BAD-09")
async def stmc_bus_14_newest_byte_wins(dut: Any) -> None:
    """Of two writes that are at least 5 cycles apart, without polling, the newer one is always accepted
    (STMC-BUS-14).
    """
    env = await Env.start(dut, None)
    for apart in range(5, 16):
        await env.reset()
        edge0 = await env.host.write(COMMAND, 0x0A, gap=2)
        await env.bench.until(max(env.bench.now, edge0 + apart - 3))
        await env.host.write(DATA, 0x14, strobe=3)
        status = await env.host.poll(IBF, 0)
        env.check("STMC-BUS-14", f"status of {apart} cycles", status in (0x30, 0xB0), True)
        if apart >= C_EVENT_LATEST:
            env.check("STMC-BUS-12", f"status of {apart} cycles", status, 0x30)


@directed("STMC-BUS-20")
async def stmc_bus_20_read_cycle(dut: Any) -> None:
    """In status reads of many lengths, d_o is valid in time and does not change (STMC-BUS-20)."""
    env = await Env.start(dut)
    bench = env.bench
    for length in (5, 6, 9, 40):
        await env.go(0x42)
        first = bench.set(a0=STATUS, cs_n=0, rd_n=0)
        await bench.clocks(4)
        byte = bench.level("d_o")
        env.check("STMC-BUS-20", "d_oe", bench.level("d_oe"), 1)
        await bench.clocks(length - 4)
        last = bench.set(rd_n=1) if length & 1 else bench.set(cs_n=1)
        await bench.clocks(8)
        bench.set(**OFF)
        (_, _), (off, _) = bench.edges("d_oe", first)
        env.window("STMC-BUS-20", "d_oe fall", off - last, 0, 4)
        env.check("STMC-BUS-20", "changes of d_o", bench.edges("d_o", first + 5), [])
        env.check("STMC-BUS-20", "status", byte & ~BUSY, 0)
        await env.idle()
        await bench.clocks(4)


@directed("STMC-BUS-21", "STMC-BUS-22", "STMC-BAD-10", "STMC-REM-02", "STMC-ST-04")
async def stmc_bus_21_answers(dut: Any) -> None:
    """During reads of answers of one and of three bytes, OBF falls and rises once per byte (STMC-BUS-21)."""
    env = await Env.start(dut)
    bench, host = env.bench, env.host
    await env.go(0x44, 0x030201, 3)
    await env.in_gap(2)
    await env.halt()
    left = 0x030201 - 3 - 1
    await host.command(0x83)
    for n in range(3):
        for _ in range(3):
            env.check("STMC-BUS-21", "OBF after status reads", await host.status() & OBF, OBF)
        env.check("STMC-REM-02", f"byte {n}", await host.read(DATA), left >> 8 * n & 0xFF)
        await bench.clocks(8)
    env.check("STMC-BUS-21", "OBF", await host.status() & OBF, 0)
    for _ in range(2):
        env.check("STMC-BUS-22", "last byte again", await host.read(DATA), left >> 16)
    env.check("STMC-BUS-22", "status", await host.status(), 0)


@rtl_only("strobes at any phase to clk, and the model counts in cycles")
@directed("STMC-BAD-13")
async def stmc_bad_13_short_strobes(dut: Any) -> None:
    """Strobes that are too short, at any phase, cause either no write or one complete write (STMC-BAD-13)."""
    env = await Env.start(dut)
    bench = env.bench
    clk = bench.period
    for part in range(16):
        for length in (clk // 4, clk // 2, clk, 3 * clk // 2):
            await env.host.command(0xC0)
            await bench.align()
            await Timer(clk * part // 32 * 2 + 2 * (clk // 64), "ps")
            await strobe(env, length // 2 * 2, 12 * clk, a0=1, d_i=0x1A, cs_n=0, wr_n=0)
            await bench.align()
            status = await env.host.status()
            env.check("STMC-BAD-13", f"status {status:#x} is 80 or 40", status in (0x80, 0x40), True)
    await env.host.init(*STANDARD)
    await env.move(0x42)
    env.check("STMC-BAD-13", "a step still runs", len(env.pulses), 1)


@directed("STMC-BUS-12", "STMC-BUS-13", "STMC-DS-14", builds=(D16,))
async def stmc_bus_13_datasheet(dut: Any) -> None:
    """In DATASHEET, reads and errors at standstill take as little time as in FAST (STMC-BUS-13,
    STMC-DS-14).
    """
    env = await Env.start(dut, INTERNAL, clock=0)
    for byte, after in ((0x81, OBF), (0xC0, 0x80 | OBF), (0x43, 0x30 | OBF), (0x83, OBF), (0x40, 0x80 | OBF)):
        await env.host.write(COMMAND, byte, gap=C_EVENT_LATEST)
        env.check("STMC-BUS-13", f"status of {byte:#x}", await env.host.status(), after)
