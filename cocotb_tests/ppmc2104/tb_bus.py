"""Bus accesses in both styles (P2104-BUS), invalid accesses (P2104-BAD-08…15)."""

from __future__ import annotations

from itertools import product
from typing import Any

from cocotb_tests.harness import COMMAND, DATA, F8, F11, F16, F48, F100, IBF, OBF, STATUS, directed, rtl_only

from .env import PINS_LATEST, Env
from .expected_timing import INIT_A
from .nanoseconds import SlowBus

STYLES = (0, 1)
IDLE = {"cs_n": 1, "ds_wrs_n": 1, "rw_rds_n": 1}


def strobes(busc: int, cs_n: int, ds_wrs_n: int, rw_rds_n: int) -> tuple[bool, bool]:
    """Return the (write, read) strobes according to P2104-BUS-01/02."""
    chosen, first, second = not cs_n, not ds_wrs_n, bool(rw_rds_n)
    if busc:
        return chosen and first and not second, chosen and first and second
    return chosen and first and second, chosen and not first and not second


@directed("P2104-BUS-01", "P2104-BUS-02", "P2104-BUS-03", "P2104-BUS-04")
async def p2104_bus_01_all_combinations(dut: Any) -> None:
    """Each combination of pins that is stable for 8 cycles has the effect that its bus style defines
    (P2104-BUS-01, P2104-BUS-02).
    """
    env = await Env.start(dut)
    bench = env.bench
    for busc, a0, cs_n, ds, rw in product(STYLES, (0, 1), (0, 1), (0, 1), (0, 1)):
        await env.reset()
        await env.style(busc)
        await env.host.command(0x81)
        what = f"busc {busc}, a0 {a0}, cs_n {cs_n}, ds_wrs_n {ds}, rw_rds_n {rw}"
        write, read = strobes(busc, cs_n, ds, rw)
        since = bench.set(a0=a0, d_i=0xD1, cs_n=cs_n, ds_wrs_n=ds, rw_rds_n=rw)
        await bench.clocks(8)
        got = (bench.level("d_oe"), bench.level("d_o"))
        bench.set(**IDLE)
        await bench.clocks(12)
        env.check("P2104-BUS-01", f"d_oe, {what}", [v for _, v in bench.edges("d_oe", since)], [1, 0] * read)
        if read:
            env.check("P2104-BUS-03", f"register, {what}", got, (1, 0x01 if a0 else 0xCF))
        # An unexpected data byte sets error 2; code D1 sets AUXO0 to 0.
        status = OBF if not (read and not a0) else 0
        status |= 0x80 if write and not a0 else 0
        env.check("P2104-BUS-03", f"status after {what}", await env.host.status(), status)
        env.check("P2104-BUS-03", f"auxo after {what}", bench.level("auxo"), 0b10 if write and a0 else 0b11)


@directed("P2104-BUS-04")
async def p2104_bus_04_style_changes(dut: Any) -> None:
    """If busc changes while the strobes are inactive, the new style takes effect 3 cycles later
    (P2104-BUS-04).
    """
    env = await Env.start(dut)
    for i in range(8):
        env.bench.set(busc=(i + 1) & 1, rw_rds_n=1)
        await env.bench.clocks(3)
        code, auxo = ((0xD1, 0b10), (0xC1, 0b11))[i >> 1 & 1]
        await env.host.write(COMMAND, code, strobe=2)
        await env.bench.clocks(10)
        env.check("P2104-BUS-04", "auxo after a write", env.bench.level("auxo"), auxo)
        env.bench.set(busc=i & 1, rw_rds_n=1)
        await env.bench.clocks(3)
        env.check("P2104-BUS-04", "status", await env.host.read(STATUS, strobe=3), 0x00)


@directed(
    "P2104-BUS-05",
    "P2104-GEN-06",
    "P2104-HSK-03",
    "P2104-BAD-12",
    "P2104-BAD-13",
    builds=(F16, F100),
    exact="the data change with the end of the strobe",
)
async def p2104_bus_05_last_sample_counts(dut: Any) -> None:
    """If d_i and a0 change in every cycle, the last sample of the write strobe is the byte, regardless of the
    pin that ends the strobe (P2104-BUS-05).
    """
    env = await Env.start(dut)
    bench = env.bench
    latencies = set()
    for busc in STYLES:
        await env.style(busc)
        write = env.host.style.write_on
        # The other strobe, or a change of direction, also ends a write.
        turn = {"rw_rds_n": 1 if busc else 0}
        ends = ({"ds_wrs_n": 1}, {"cs_n": 1}, {"cs_n": 1, "ds_wrs_n": 1}, turn)
        for length, end in product(range(1, 7), ends):
            low = bench.level("auxo") & 1
            for i in range(length):
                last = i == length - 1
                bench.set(**write, a0=int(last), d_i=(0xD1 if low else 0xC1) if last else 0x40 + i)
                await bench.clocks(1)
            edge0 = bench.set(a0=0, d_i=0x87, **end)
            await bench.clocks(14)
            t, level = bench.edges("auxo[0]", edge0)[0]
            env.check("P2104-BUS-05", f"AUXO0, busc {busc}, {length} cycles, {end}", level, 1 - low)
            latencies.add(t - edge0)
            bench.set(**IDLE)
            await bench.clocks(12)
            env.check("P2104-BUS-05", f"status, busc {busc}, {length}, {end}", await env.host.status(), 0x00)
    env.check("P2104-BUS-05", "number of different latencies", len(latencies), 1)
    env.window("P2104-HSK-03", "edge 0 to pin", latencies.pop(), 2, PINS_LATEST)


@directed(
    "P2104-BUS-06",
    "P2104-BUS-22",
    "P2104-GEN-07",
    builds=(F16, F100),
    exact="a level of one cycle may not be sampled",
)
async def p2104_bus_06_read_edges(dut: Any) -> None:
    """In reads of 1 to 60 cycles, d_oe and d_o change only on the edges that the rule states, even if the
    state changes (P2104-BUS-06).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_A)
    bench = env.bench
    for busc, length, early in product(STYLES, (1, 2, 3, 4, 9, 60), range(5)):
        await env.style(busc)
        style = env.host.style
        await axis.finish()
        await axis.go(0x42)
        low = await axis.pulse(1)
        # BUSY falls near here: before, on or after the first edges of the read.
        await bench.until(low + env.cfg.w - 3 + early)
        bench.set(a0=STATUS, d_i=0xFF, **style.read_on)
        first = bench.now
        await bench.clocks(length)
        after = bench.set(a0=DATA, **style.read_off)
        await bench.clocks(8)
        what = f"busc {busc}, {length} cycles, {early}"
        env.check("P2104-BUS-06", f"d_oe, {what}", bench.edges("d_oe", first), [(first, 1), (after, 0)])
        values = [bench.level_at("d_o", t) for t in range(first, after + 3)]
        env.check("P2104-BUS-06", f"d_o is a status, {what}", {*values[: length + 2]} <= {0x04, 0x00}, True)
        env.check("P2104-BUS-06", f"d_o from edge 2 to edge 2', {what}", len({*values[2 : length + 2]}), 1)
        await axis.idle()


@directed(
    "P2104-BUS-07",
    "P2104-HSK-03",
    "P2104-HSK-01",
    exact="R/W* changes together with DS*, without the set-up time of 20 ns",
)
async def p2104_bus_07_no_invisible_byte(dut: Any) -> None:
    """A status read 1 to 14 cycles after a write returns IBF = 1 or the complete effect of the write
    (P2104-BUS-07).
    """
    env = await Env.start(dut)
    await env.both(INIT_A)
    cases = ((0x87, 0x80), (0xA7, 0x80), (0x81, 0x01), (0x42, 0x04), (0x62, 0x08), (0x44, 0x10), (0x65, 0x20))
    for busc, (code, final) in product(STYLES, cases):
        seen = []
        await env.style(busc)
        for gap in range(1, 15):
            await env.host.write(COMMAND, code, gap=gap)
            status = await env.host.status()
            seen.append(status & IBF)
            if gap > 8:
                env.check("P2104-HSK-03", f"IBF {gap} cycles after {code:#x}", status & IBF, 0)
            if not status & IBF:
                env.check("P2104-BUS-07", f"status {gap} cycles after {code:#x}", status, final)
            await env.bench.clocks(20)
            # Return to standstill: end a data wait or a motion; clear errors, interrupt and answer.
            for axis in env.axes:
                await axis.command(0x40)
                await axis.idle()
                await axis.finish()
                await axis.error()
        env.check("P2104-BUS-07", f"IBF falls once after {code:#x}", seen, sorted(seen, reverse=True))


@directed("P2104-BUS-08", "P2104-HSK-06", exact="a level of one cycle may not be sampled")
async def p2104_bus_08_obf_of_a_read_byte(dut: Any) -> None:
    """After an answer was read, a status read that begins 1 cycle later or more does not return OBF = 1 for
    this answer (P2104-BUS-08).
    """
    env = await Env.start(dut)
    for busc, length, gap in product(STYLES, (1, 2, 3, 5), range(1, 6)):
        await env.style(busc)
        await env.host.command(0x81)
        env.check("P2104-HSK-06", "OBF with IBF = 0", await env.host.status() & (OBF | IBF), OBF)
        byte = await env.host.read(DATA, strobe=length, gap=gap)
        env.check("P2104-BUS-08", f"byte, {length} cycles", byte, 0xCF)
        env.check("P2104-BUS-08", f"OBF {gap} cycles later", await env.host.read(STATUS, strobe=3) & OBF, 0)


@directed("P2104-BUS-08", "P2104-HSK-07", "P2104-BAD-10")
async def p2104_bus_08_answer_during_a_read(dut: Any) -> None:
    """If a read instruction is accepted near a data read, the answer to this instruction is never discarded
    (P2104-BUS-08).
    """
    env = await Env.start(dut)
    seen = set()
    for busc, length, gap in product(STYLES, (1, 2, 4, 7), range(1, 14)):
        await env.style(busc)
        await env.host.command(0x80)
        await env.host.write(COMMAND, 0x81, gap=gap)
        first = await env.host.read(DATA, strobe=length)
        await env.bench.clocks(16)
        obf = await env.host.status() & OBF
        seen.add((first, obf))
        env.check("P2104-BUS-08", f"({first:#x}, OBF)", (first, obf) in {(0, 1), (0xCF, 0), (0xCF, 1)}, True)
        if obf:
            env.check("P2104-BUS-08", "the answer kept", await env.host.read(DATA), 0xCF)
    env.check("P2104-BUS-08", "both orders were met", seen >= {(0, 1), (0xCF, 0)}, True)


@rtl_only("strobes at any phase to clk, and the model counts in cycles")
@directed(
    "P2104-BUS-20",
    "P2104-BUS-21",
    "P2104-BUS-05",
    builds=(F8, F11, F16, F48, F100),
    exact="a level of one cycle may not be sampled",
)
async def p2104_bus_20_shortest_cycles(dut: Any) -> None:
    """With strobes, data and gaps of T + 10 ns and reads of T + 20 ns, no byte is missed; T is the period of
    `clk` (P2104-BUS-20).
    """
    env = await Env.start(dut)
    bus = SlowBus(env)
    period = env.bench.period / 1000
    short = period + 10
    for busc, phase in product(STYLES, range(0, 16, 2)):
        await env.style(busc)
        what = f"busc {busc}, phase {phase}/16"
        await bus.phase(phase)
        # The newer of two writes must be stored; it may replace the older one.
        await bus.write(COMMAND, 0xC1, width=short, setup=short, rest=max(0, short - 35))
        await bus.write(COMMAND, 0xF1, width=short, setup=short, rest=14 * period)
        env.check("P2104-BUS-20", f"auxo, {what}", env.bench.level("auxo"), 0b00)
        await bus.write(COMMAND, 0xD1, width=3 * short, setup=short, rest=14 * period)
        env.check("P2104-BUS-20", f"auxo, garbage first, {what}", env.bench.level("auxo"), 0b10)
        await bus.write(COMMAND, 0x81, width=short, setup=short, rest=14 * period)
        for register, byte in ((STATUS, 0x01), (DATA, 0xCF), (STATUS, 0x00)):
            samples = await bus.read(register, width=period + 20, access=period + 1, release=period + 1)
            env.check("P2104-BUS-20", f"(d_oe, d_o) of {register}, {what}", samples, [(1, byte)] * 2)
            await bus.wait(max(0, short - period - 21))


@directed(
    "P2104-BUS-23",
    "P2104-BUS-03",
    "P2104-BUS-09",
    "P2104-BAD-09",
    exact="R/W* changes together with DS*, without the set-up time of 20 ns",
)
async def p2104_bus_23_two_clk_cycles(dut: Any) -> None:
    """With strobes and gaps of 2 cycles, every byte is transferred in both directions (P2104-BUS-23)."""
    env = await Env.start(dut)
    env.host.read_strobe = 2
    for busc in STYLES:
        await env.style(busc)
        axis = await env.ready(1 + busc, INIT_A)
        await axis.move(0x43, 9)
        await axis.result("P2104-BUS-23", 9, 0x83, 0)
        env.check("P2104-BUS-23", "errors", await env.errors(), (0, 0))
        await axis.fetch(0x81)
        env.check("P2104-BUS-09", "stale byte", await env.host.read(DATA), 0xCF)
        env.check("P2104-BUS-09", "status", await env.host.status(), 0x00)


@rtl_only("strobes at any phase to clk, and the model counts in cycles")
@directed("P2104-BUS-10", "P2104-BAD-14", builds=(F16, F48), exact="a level of one cycle may not be sampled")
async def p2104_bus_10_too_short_strobes(dut: Any) -> None:
    """With strobes shorter than a cycle, at any phase, each byte is either stored completely or not at all
    (P2104-BUS-10).
    """
    env = await Env.start(dut)
    bench, bus = env.bench, SlowBus(env)
    clk = bench.period / 1000
    for busc, part, phase in product(STYLES, (1 / 8, 1 / 2, 7 / 8), range(0, 16, 2)):
        await env.style(busc)
        await bus.phase(phase)
        since = bench.now
        await bus.write(COMMAND, 0xF1, width=part * clk, setup=part * clk, rest=14 * clk)
        await bench.align()
        moved = bench.edges("auxo", since)
        env.check("P2104-BUS-10", "auxo whole or nothing", [v for _, v in moved] in ([], [0b00]), True)
        env.check("P2104-BUS-10", "status", await env.host.status(), 0x00)
        await env.host.command(0xC1)
        await env.host.command(0x83)
        await bus.phase(phase)
        strobe = {"ds_wrs_n": 0} if busc else {"rw_rds_n": 0}
        bench.set_between_edges(a0=DATA, cs_n=0, rw_rds_n=1)
        await bus.wait(2)
        bench.set_between_edges(**strobe)
        await bus.wait(part * clk)
        bench.set_between_edges(**dict.fromkeys(strobe, 1), cs_n=1)
        await bench.clocks(10)
        await bench.align()
        env.check("P2104-BUS-10", "OBF: a byte is left", await env.host.status(), 0x01)
        await env.host.command(0x80)
        await env.host.read(DATA)


@directed(
    "P2104-BAD-12",
    "P2104-BUS-05",
    "P2104-BUS-06",
    exact="R/W* changes together with DS*, without the set-up time of 20 ns",
)
async def p2104_bad_12_turn_inside_a_strobe(dut: Any) -> None:
    """If R/W* or a0 changes while DS* is low, a write in progress is stored, and a read in progress still
    returns the register that a0 selected at first (P2104-BAD-12).
    """
    env = await Env.start(dut, busc=1)
    bench = env.bench
    await env.host.command(0x81)
    for length in (1, 2, 5):
        bench.set(cs_n=0, ds_wrs_n=0, rw_rds_n=0, a0=COMMAND, d_i=0xD1)
        await bench.clocks(length)
        turn = bench.set(rw_rds_n=1, a0=STATUS, d_i=0x00)
        await bench.clocks(6)
        env.check("P2104-BAD-12", "d_oe from the turn on", bench.edges("d_oe", turn), [(turn, 1)])
        bench.set(**IDLE)
        await bench.clocks(10)
        env.check("P2104-BAD-12", "auxo", bench.level("auxo"), 0b10)
        await env.host.command(0xC1)
        # The reverse case: a read of the data register changes into a write of data.
        first = bench.set(cs_n=0, ds_wrs_n=0, rw_rds_n=1, a0=DATA)
        await bench.clocks(3)
        bench.set(a0=STATUS)
        await bench.clocks(5)
        env.check("P2104-BAD-12", "d_o after a0 turned", bench.level("d_o"), 0xCF)
        turn = bench.set(rw_rds_n=0, a0=COMMAND, d_i=0xE1)
        await bench.clocks(length)
        bench.set(**IDLE)
        await bench.clocks(12)
        env.check("P2104-BAD-12", "d_oe", bench.edges("d_oe", first), [(first, 1), (turn, 0)])
        env.check("P2104-BAD-12", "auxo after the write", bench.level("auxo"), 0b01)
        await env.host.command(0xC1)
        env.check("P2104-BAD-12", "the data byte was read", await env.host.status(), 0x00)
        await env.host.command(0x81)


@directed(
    "P2104-BAD-15",
    "P2104-BUS-04",
    uncompared="the bus style changes inside strobes, which no rule fixes",
    exact="the data change with the end of the strobe",
)
async def p2104_bad_15_style_changes_in_a_strobe(dut: Any) -> None:
    """If busc changes during a strobe, any result is allowed, but later accesses must be correct
    (P2104-BAD-15).
    """
    env = await Env.start(dut)
    bench = env.bench
    for busc, at, write in product(STYLES, range(0, 5), (True, False)):
        await env.style(busc)
        style = env.host.style
        since = bench.set(a0=COMMAND, d_i=0xF1, **(style.write_on if write else style.read_on))
        await bench.clocks(at)
        bench.set(busc=1 - busc)
        await bench.clocks(6)
        bench.set(**IDLE)
        await bench.clocks(14)
        levels = [v for _, v in bench.edges("auxo", since)]
        env.check("P2104-BAD-15", "auxo: the byte or nothing", levels in ([], [0b00]), True)
        env.check("P2104-BAD-15", "status", await env.host.status(), 0x00)
        await env.host.command(0xC1)
        env.check("P2104-BAD-15", "81", await env.host.fetch(0x81), [0xCF])
        await bench.clocks(1)
