"""Bus accesses, ports, synchronisers and reset (P104-BUS, P104-PORT-02..04, P104-TIM-01,
P104-BAD-08/09/18).
"""

from __future__ import annotations

import cocotb
from cocotb.triggers import Timer, ValueChange
from cocotb.utils import get_sim_time

from cocotb_tests.harness import COMMAND, DATA, F8, F16, F50, F100, IBF, STATUS, directed, rtl_only

from .env import PINS_LATEST, Env
from .expected_timing import INIT_A


async def strobe(env: Env, ps: int, gap_ps: int, **levels: int) -> None:
    """Make one host access that is asynchronous to `clk`.

    The levels last for `ps`; then the strobes are inactive for `gap_ps`.
    """
    env.bench.set_between_edges(**levels)
    await Timer(ps, "ps")
    env.bench.set_between_edges(cs_n=1, wr_n=1, rd_n=1)
    await Timer(gap_ps, "ps")


def off_edge(env: Env, part: int) -> int:
    """Return the duration of this number of eighths of a cycle as an even number of ps.

    A small offset avoids the edges of `clk`.
    """
    return env.bench.period * part // 16 * 2 + 2 * (env.bench.period // 64)


@directed("P104-BUS-01", "P104-GEN-01")
async def p104_bus_01_register_map(dut):
    """For each combination of cs_n, a0 and strobes, only the selected register is accessed (P104-BUS-01)."""
    env = await Env.start(dut, None)
    bench, host = env.bench, env.host
    env.check("P104-BUS-01", "a0 = 0 writes data: error 3", await host.data(0x86), 0xB0)
    env.check("P104-BUS-01", "a0 = 1 writes a command", await host.command(0x86), 0x10)
    env.check("P104-BUS-01", "0x86 takes the data", await host.data(0x05), 0x00)
    await host.command(0x81)
    env.check("P104-BUS-01", "a0 = 1 reads status", await host.read(STATUS), 0x01)
    env.check("P104-BUS-01", "a0 = 0 reads data", await host.read(DATA), 0xCF)
    before = bench.edges("d_oe")
    for a0 in (0, 1):
        for levels in ({"rd_n": 0}, {"wr_n": 0}, {"rd_n": 0, "wr_n": 0}, {}):
            bench.set(a0=a0, d_i=0xC1, cs_n=1, **levels)
            await bench.clocks(6)
            bench.set(rd_n=1, wr_n=1)
            await bench.clocks(6)
    env.check("P104-BUS-01", "edges of d_oe with cs_n = H", bench.edges("d_oe"), before)
    bench.set(cs_n=0)
    await bench.clocks(6)
    bench.set(cs_n=1)
    await bench.clocks(12)
    env.check("P104-BUS-01", "status after accesses with cs_n = H", await host.status(), 0x00)
    env.check("P104-BUS-01", "aux_n", bench.edges("aux_n"), [])


@directed("P104-BUS-02", "P104-BAD-08", exact="both strobes end at the same edge")
async def p104_bus_02_overlapping_strobes(dut):
    """If a read strobe interrupts a write, the byte that was sampled before is stored once (P104-BUS-02)."""
    env = await Env.start(dut, None)
    bench = env.bench
    since = bench.set(a0=COMMAND, d_i=0x86, cs_n=0, wr_n=0)
    await bench.clocks(3)
    bench.set(rd_n=0, d_i=0xC1)
    await bench.clocks(14)
    env.check("P104-BUS-02", "d_oe while both are low", bench.edges("d_oe", since), [])
    bench.set(cs_n=1, rd_n=1, wr_n=1)
    await bench.clocks(12)
    env.check("P104-BUS-02", "status: only 0x86 was stored", await env.host.status(), 0x10)
    env.check("P104-BUS-02", "aux_n", bench.edges("aux_n"), [])
    await env.host.data(0xFF)
    first = bench.set(a0=STATUS, cs_n=0, rd_n=0)
    await bench.clocks(8)
    both = bench.set(wr_n=0, d_i=0xC1)
    await bench.clocks(8)
    bench.set(cs_n=1, rd_n=1, wr_n=1)
    await bench.clocks(12)
    (on, _), (off, _) = bench.edges("d_oe", first)
    env.window("P104-BUS-02", "d_oe fall after wr_n joined", off - both, 0, 2)
    env.window("P104-BUS-02", "d_oe rise", on - first, 0, 2)
    env.check("P104-BUS-02", "status after the read", await env.host.status(), 0x00)
    env.check("P104-BUS-02", "aux_n after the read", bench.edges("aux_n"), [])


@rtl_only("strobes at any phase to clk, and the model counts in cycles")
@directed(
    "P104-BUS-03", "P104-BUS-04", builds=(F8, F16, F50, F100), exact="a level of one cycle may not be sampled"
)
async def p104_bus_03_shortest_strobes(dut):
    """With the shortest legal strobes at any phase to `clk`, no byte is missed or corrupted (P104-BUS-03)."""
    env = await Env.start(dut, None)
    bench = env.bench
    clk = bench.period
    short, read = clk + 10_000, 4 * clk
    for part in range(8):
        await bench.align()
        await Timer(off_edge(env, part), "ps")
        # If two writes follow each other without a pause, the newer byte must be stored; it may replace the
        # older one.
        await strobe(env, short, short, a0=1, d_i=0xC2, cs_n=0, wr_n=0)
        await strobe(env, short, 14 * clk, a0=1, d_i=0xC1, cs_n=0, wr_n=0)
        env.check("P104-BUS-03", f"aux_n, phase {part}/8", bench.level("aux_n"), 0)
        await strobe(env, short, 14 * clk, a0=1, d_i=0xC2, cs_n=0, wr_n=0)
        env.check("P104-BUS-03", f"aux_n, phase {part}/8", bench.level("aux_n"), 1)
        # In longer strobes, the levels of d_i and a0 are invalid until 1 cycle + 10 ns before the end of the
        # strobe.
        bench.set_between_edges(a0=0, d_i=0x55, cs_n=0, wr_n=0)
        await Timer(3 * clk, "ps")
        await strobe(env, short, 14 * clk, a0=1, d_i=0x86, cs_n=0, wr_n=0)
        value = part << 1 | 1
        await strobe(env, short, 14 * clk, a0=0, d_i=value, cs_n=0, wr_n=0)
        env.check("P104-BUS-04", f"auxo, phase {part}/8", bench.level("auxo"), ~value & 0xF)
        await strobe(env, short, 14 * clk, a0=1, d_i=0x81, cs_n=0, wr_n=0)
        for a0, expected in ((1, 0x01), (0, 0xCF), (1, 0x00)):
            bench.set_between_edges(a0=a0, cs_n=0, rd_n=0)
            await Timer(read, "ps")
            got = (bench.level("d_oe"), bench.level("d_o"))
            bench.set_between_edges(cs_n=1, rd_n=1)
            await Timer(short, "ps")
            env.check("P104-BUS-03", f"(d_oe, d_o) of a0 = {a0}, phase {part}/8", got, (1, expected))


@directed("P104-BUS-05")
async def p104_bus_05_snapshot(dut):
    """During a read strobe of 3 to 60 cycles, d_o is one stable snapshot, even if the state changes
    (P104-BUS-05).
    """
    env = await Env.start(dut, INIT_A)
    bench = env.bench
    for length in (3, 4, 5, 9, 60):
        await env.go(0x42)
        await env.pulse(1, 40)
        first = bench.set(a0=STATUS, cs_n=0, rd_n=0)
        await bench.clocks(3)
        byte = bench.level("d_o")
        await bench.clocks(length - 3)
        after = bench.set(cs_n=1, rd_n=1)
        await bench.clocks(8)
        (on, _), (off, _) = bench.edges("d_oe", first)
        env.window("P104-BUS-05", f"d_oe rise, {length} cycles", on - first, 0, 2)
        env.window("P104-BUS-05", f"d_oe fall, {length} cycles", off - after, 0, 2)
        env.check("P104-BUS-05", f"status, {length} cycles", byte, 0x04)
        moved = [t for t, _ in bench.edges("d_o", first + 3) if t <= after + 2]
        env.check("P104-BUS-05", f"d_o edges up to edge 2', {length} cycles", moved, [])
        await env.idle()
    ended = bench.set(a0=STATUS, cs_n=0, rd_n=0)
    await bench.clocks(5)
    bench.set(a0=DATA)
    await bench.clocks(5)
    env.check("P104-BUS-05", "d_o edges when a0 turns", bench.edges("d_o", ended + 3), [])
    await env.host.idle()


@directed(
    "P104-BUS-06",
    "P104-GEN-06",
    "P104-TIM-01",
    "P104-BAD-18",
    builds=(F16, F100),
    exact="the data change with the end of the strobe",
)
async def p104_bus_06_last_sample_counts(dut):
    """If d_i and a0 change in every cycle, the last sample in the write strobe is the byte, always with the
    same latency (P104-BUS-06).
    """
    env = await Env.start(dut, None)
    bench = env.bench
    latencies = set()
    for length in range(1, 9):
        for ends in ({"wr_n": 1}, {"cs_n": 1}, {"cs_n": 1, "wr_n": 1}, {"rd_n": 0}):
            on = bench.level("aux_n")
            for i in range(length):
                last = i == length - 1
                bench.set(cs_n=0, wr_n=0, a0=int(last), d_i=(0xC1 if on else 0xC2) if last else 0x40 + i)
                await bench.clocks(1)
            edge0 = bench.set(a0=0, d_i=0x86, **ends)
            await bench.clocks(14)
            (t, level) = bench.edges("aux_n", edge0)[0]
            env.check("P104-BUS-06", f"aux_n, {length} cycles, {ends}", level, 1 - on)
            latencies.add(t - edge0)
            await env.host.idle()
            bench.set(cs_n=1, wr_n=1, rd_n=1)
            await bench.clocks(12)
            env.check("P104-BUS-06", f"status, {length} cycles, {ends}", await env.host.status(), 0x00)
    env.check("P104-BUS-06", "number of different latencies", len(latencies), 1)
    env.window("P104-TIM-01", "edge 0 to pin", latencies.pop(), 2, PINS_LATEST)


@directed("P104-BUS-07", "P104-HSK-03")
async def p104_bus_07_no_invisible_byte(dut):
    """A status read 1 to 16 cycles after a write returns IBF = 1 or the complete effect of the write
    (P104-BUS-07).
    """
    env = await Env.start(dut, INIT_A)
    cases = ((0x87, {0x80}), (0x86, {0x10}), (0x81, {0x01}), (0x42, {0x04}), (0x44, {0x40}))
    for code, final in cases:
        seen = []
        for gap in range(1, 17):
            await env.host.write(COMMAND, 0xC2)
            await env.idle()
            await env.bench.clocks(20)
            await env.host.fetch(0x80)
            await env.host.write(COMMAND, code, gap=gap)
            status = await env.host.status()
            seen.append(status)
            if not status & IBF:
                env.check("P104-BUS-07", f"status {gap} cycles after {code:#x}", status in final, True)
            elif gap > 10:
                env.check("P104-HSK-03", f"IBF {gap} cycles after {code:#x}", status, "IBF = 0")
        env.check(
            "P104-BUS-07", f"IBF falls once after {code:#x}", seen, sorted(seen, key=lambda s: ~s & IBF)
        )


@rtl_only("glitches between two clk edges, which the model never sees")
@directed("P104-PORT-02", builds=(F16, F50))
async def p104_port_02_registers_only(dut):
    """During short glitches between edges of `clk`, outputs change only on rising edges (P104-PORT-02)."""
    env = await Env.start(dut, INIT_A)
    bench = env.bench
    rising = (int(get_sim_time("ps")) + bench.half) % bench.period
    wrong = []

    async def watch(name: str) -> None:
        while True:
            await ValueChange(getattr(dut, name))
            if int(get_sim_time("ps")) % bench.period != rising:
                wrong.append((name, bench.now))

    for name in bench.part.outputs:
        cocotb.start_soon(watch(name))
    await env.go(0x47, rate=3)
    await env.pulse(3)
    before = [t for name in ("int_n", "d_oe", "aux_n") for t in bench.edges(name)]
    away = {"alm_n": 0, "l1_n": 0, "cnp_n": 0, "rd_n": 0, "cs_n": 0, "l3_n": 0, "auxi": 5, "a0": 1}
    for pin, level in away.items():
        back = bench.pins[pin]
        await bench.align()
        await Timer(bench.half // 4, "ps")
        bench.set_between_edges(**{pin: level})
        await Timer(bench.half // 4, "ps")
        bench.set_between_edges(**{pin: back})
        await bench.clocks(6)
    after = [t for name in ("int_n", "d_oe", "aux_n") for t in bench.edges(name)]
    env.check("P104-PORT-02", "edges of int_n, d_oe, aux_n from glitches", after, before)
    await env.host.run("c 86 d 05 c C1 c 40")
    await env.idle()
    await env.host.run("c 81 r")
    env.check("P104-PORT-02", "output changes off the rising edge", wrong, [])


@directed("P104-PORT-03", "P104-PORT-01", "P104-PHS-02", "P104-PAR-01", builds=(F16, F50))
async def p104_port_03_reset(dut):
    """Bytes written during reset are not stored; a write that is sampled on edge 4 after the release is
    accepted (P104-PORT-03).
    """
    env = await Env.start(dut, INIT_A)
    bench = env.bench
    await env.host.run("c C1 c 86 d 0F c 81")
    await env.move(0x4A)
    bench.set(rst_n=0)
    await bench.clocks(3)
    levels = {name: bench.level(name) for name in bench.part.outputs}
    env.check("P104-PORT-03", "outputs in reset", levels, bench.part.reset_levels(bench.config.params))
    await env.host.write(COMMAND, 0xC1)
    bench.set(a0=STATUS, cs_n=0, rd_n=0)
    await bench.clocks(4)
    levels = {name: bench.level(name) for name in bench.part.outputs}
    env.check("P104-PORT-03", "outputs in reset", levels, bench.part.reset_levels(bench.config.params))
    bench.set(cs_n=1, rd_n=1)
    await bench.clocks(3)
    release = bench.set(rst_n=1)
    await bench.until(release + 4)
    await env.host.write(COMMAND, 0x86, strobe=2)
    await bench.clocks(10)
    env.check("P104-PORT-03", "status after a write at edge 4", await env.host.status(), 0x10)
    await env.host.data(0x0F)
    env.check("P104-PORT-03", "aux_n: the write in reset is lost", bench.level("aux_n"), 1)
    env.check("P104-PORT-03", "the output byte is gone", await env.host.read(DATA), 0x00)
    await bench.reset()
    await bench.clocks(4)
    env.check("P104-PORT-03", "status after reset", await env.host.status(), 0x00)


@directed("P104-PORT-04")
async def p104_port_04_tied_inputs(dut):
    """If unused inputs are tied as documented, and the clock pin is at 0 or 1, moves are not affected
    (P104-PORT-04).
    """
    env = await Env.start(dut, INIT_A)
    for clock in (0, 1):
        env.bench.set(clock=clock)
        for code in (0x43, 0x4B, 0xC3):
            await env.move(code, 12)
            await env.result("P104-PORT-04", 12, 0x83, 0)
        env.check("P104-PORT-04", "input signals", await env.host.fetch(0x81), [0xCF])


@rtl_only("strobes at any phase to clk, and the model counts in cycles")
@directed("P104-BAD-09")
async def p104_bad_09_too_short_strobes(dut):
    """If strobes and gaps are shorter than the limits, at any phase, each byte is either stored completely or
    not at all (P104-BAD-09).
    """
    env = await Env.start(dut, None)
    bench = env.bench
    clk = bench.period
    for length in (clk // 8, clk // 2, clk * 7 // 8):
        for part in range(8):
            await bench.clocks(4)
            await Timer(off_edge(env, part), "ps")
            # The nibbles of each byte are complementary, so a mixture of two bytes would cause a third value
            # on auxo.
            await strobe(env, length // 2 * 2, 14 * clk, a0=1, d_i=0x86, cs_n=0, wr_n=0)
            status = await env.host.status()
            env.check("P104-BAD-09", f"status {status:#x} is one of 0x00, 0x10", status in (0x00, 0x10), True)
            await env.host.command(0xC2)
            env.check("P104-BAD-09", "core alive", await env.host.command(0x86), 0x10)
            await env.host.data(0x05)
            await bench.clocks(2)
            env.check("P104-BAD-09", "auxo", bench.level("auxo"), 0b1010)
            await env.host.command(0x86)
            await bench.align()
            await Timer(off_edge(env, part), "ps")
            await strobe(env, length // 2 * 2, 14 * clk, a0=0, d_i=0x0A, cs_n=0, wr_n=0)
            env.check("P104-BAD-09", "auxo is old or new", bench.level("auxo") in (0b1010, 0b0101), True)
            await env.host.command(0xC2)
