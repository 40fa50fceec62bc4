"""The register reads and the auxiliary ports (P104-RD, P104-AUX).

D = N - 1 is the number that a host sends for an operation of N pulses.
"""

from __future__ import annotations

from cocotb_tests.harness import DATA, F16, F25, F50, OBF, directed

from .env import PINS_LATEST, Env
from .expected_timing import INIT_A, STEP_CODES, steps

READS = (0x80, 0x81, 0x82, 0x83, 0x85)


def output_signals(s: int, hold: int, direction: int) -> int:
    """Return the answer to command 0x82 for these pin levels: S1 in bit 7 down to S5 in bit 3, then HOLD, DIR
    (P104-RD-06).
    """
    bits = sum((s >> i & 1) << (7 - i) for i in range(5))
    return bits | hold << 2 | direction << 1


@directed("P104-RD-01", "P104-AUX-03")
async def p104_rd_01_when_allowed(dut):
    """Reads and command 0x84 are rejected only while BUSY = 1; they are accepted before and after
    initialisation (P104-RD-01).
    """
    env = await Env.start(dut, None)
    for phase in range(3):
        if phase == 1:
            await env.init(*INIT_A)
        if phase == 2:
            await env.go(0x44, 4, rate=99)
        for code in READS:
            status = await env.host.command(code)
            env.check("P104-RD-01", f"{code:#x}, phase {phase}", status, 0x94 if phase == 2 else 0x01)
            if phase < 2:
                await env.host.run("rrr" if code == 0x83 else "r")
        got = await env.statuses("c 84 d 00 d FF")
        expected = [0x94, 0xE4, 0xE4] if phase == 2 else [0x20, 0x10, 0x00]
        env.check("P104-AUX-03", f"0x84, phase {phase}", got, expected)
    env.check("P104-RD-01", "OBF after refused reads", await env.host.status() & OBF, 0)
    await env.result("P104-RD-01", 4, 0x84, 0)


@directed("P104-RD-02", "P104-RD-05", "P104-LIM-10")
async def p104_rd_02_sampled_at_the_c_event(dut):
    """A byte that the host reads later contains the pin levels at the time of its command (P104-RD-02)."""
    env = await Env.start(dut, INIT_A)
    await env.host.command(0x81)
    env.bench.set(alm_n=0, l1_n=0)
    await env.bench.clocks(50)
    env.check("P104-RD-02", "byte from before the change", await env.host.read(DATA), 0xCF)
    env.check("P104-RD-02", "byte from after it", await env.host.fetch(0x81), [0x87])
    await env.host.command(0x85)
    env.bench.set(auxi=0xF)
    await env.bench.clocks(50)
    env.check("P104-RD-02", "auxiliary inputs from before", await env.host.read(DATA), 0x00)
    env.check("P104-LIM-10", "int_n, hold", (env.bench.edges("int_n"), env.bench.edges("hold")), ([], []))


@directed("P104-RD-05", "P104-RD-08", "P104-LIM-10")
async def p104_rd_05_input_bits(dut):
    """For single inputs and random combinations, each bit of the answers to commands 0x81 and 0x85 is the
    level of its pin (P104-RD-05, P104-RD-08).
    """
    env = await Env.start(dut, None)
    place = {"cnp_n": 7, "alm_n": 6, "l1_n": 3, "l2_n": 2, "l3_n": 1, "l4_n": 0}
    sets = [{pin: int(pin != low) for pin in place} for low in place]
    sets += [{pin: int(pin == high) for pin in place} for high in place]
    sets += [{pin: env.bench.rng.randrange(2) for pin in place} for _ in range(20)]
    for aux, levels in enumerate(sets):
        env.bench.set(auxi=aux & 0xF, csel=aux & 1, vsel=aux >> 1 & 1, clock=aux & 1, **levels)
        await env.bench.clocks(4)
        expected = sum(level << place[pin] for pin, level in levels.items())
        env.check("P104-RD-05", f"0x81 with {levels}", await env.host.fetch(0x81), [expected])
        env.check("P104-RD-08", f"0x85 with {aux & 0xF}", await env.host.fetch(0x85), [aux & 0xF])
    quiet = {name: env.bench.edges(name) for name in env.outputs()}
    env.check("P104-LIM-10", "edges of outputs at rest", quiet, {name: [] for name in quiet})


@directed("P104-RD-06", "P104-SW-07")
async def p104_rd_06_output_bits(dut):
    """For all patterns, both logics, and all levels of hold and dir, command 0x82 returns the pin levels
    without chopping (P104-RD-06).
    """
    env = await Env.start(dut, None)
    for name, code in STEP_CODES.items():
        for positive in (True, False):
            await env.init((code if positive else code & ~8) | 0x20, 9, 4, 4)
            table = steps(name, positive)
            for i in range(1, len(table) + 1):
                ccw = positive
                await env.move(0x5A if ccw else 0x52)
                pattern = table[-i % len(table) if ccw else i % len(table)]
                # The byte is the same in both phases of the chopper.
                for _ in range(2):
                    expected = output_signals(pattern, 0, int(ccw))
                    env.check("P104-RD-06", f"{name}, step {i}", await env.host.fetch(0x82), [expected])
                    await env.bench.clocks(1100)
            await env.host.command(0xC0)
            off = 0 if positive else 0x1F
            env.check(
                "P104-RD-06",
                "after 0xC0",
                await env.host.fetch(0x82),
                [output_signals(off, 0, int(positive))],
            )


@directed("P104-RD-03", "P104-RD-04", "P104-END-07", builds=(F16, F25))
async def p104_rd_04_read_finish_status(dut):
    """When command 0x80 is accepted, INT is released without a data read, and bit 7 is set in this read only
    (P104-RD-04).
    """
    env = await Env.start(dut, INIT_A)
    env.check("P104-RD-03", "before any operation", await env.finish(), 0x00)
    for code, rate, finish in ((0x42, None, 0x02), (0x43, None, 0x03), (0x44, 3, 0x04)):
        await env.move(code, None if code == 0x42 else 2, rate)
        edge0 = await env.host.write(1, 0x80)
        await env.bench.clocks(12)
        env.window("P104-RD-04", "0x80 to int_n", env.bench.rises("int_n")[-1] - edge0, 2, PINS_LATEST)
        env.check("P104-RD-04", "byte: bit 7 unchanged", await env.host.read_data(), 0x80 | finish)
        env.check("P104-RD-03", "second read", await env.finish(), finish)
        env.check("P104-RD-03", "third read", await env.finish(), finish)
    await env.move(0x42)
    for other in (0x81, 0x82, 0x83, 0x85):
        await env.host.fetch(other, 3 if other == 0x83 else 1)
    env.check("P104-RD-04", "int_n after other reads", env.bench.level("int_n"), 0)


@directed("P104-RD-07", "P104-END-06", "P104-EX-10")
async def p104_rd_07_remaining_resumes(dut):
    """If the remaining count of a stopped move is sent as D of another move, both moves together have the
    complete number of pulses (P104-RD-07).
    """
    env = await Env.start(dut, INIT_A)
    env.check("P104-RD-07", "after reset", await env.remaining(), 0)
    for stop_at in (1, 5, 19):
        await env.go(0x44, 20, rate=9)
        await env.pulse(stop_at, 150)
        await env.host.command(0x40)
        await env.result("P104-RD-07", stop_at, 0xC4, 20 - stop_at - 1)
        env.check("P104-RD-07", "second read", await env.remaining(), 20 - stop_at - 1)
        low, middle, high = await env.host.fetch(0x83, 3)
        env.since = env.bench.now
        await env.host.send(0x44, [9, low, middle, high])
        await env.result("P104-END-06", 20 - stop_at, 0x84, 0)


@directed("P104-AUX-01", "P104-CMD-02", builds=(F16, F50))
async def p104_aux_01_aux_pin(dut):
    """Before and after initialisation and Excitation OFF, only AUX ON and AUX OFF change aux_n
    (P104-AUX-01).
    """
    env = await Env.start(dut, None)
    for phase in range(3):
        for code, level in ((0xC1, 0), (0xC1, 0), (0xC2, 1), (0xC2, 1), (0xC1, 0)):
            edge0 = await env.host.write(1, code)
            await env.bench.clocks(PINS_LATEST)
            env.check("P104-AUX-01", f"aux_n after {code:#x}", env.bench.level("aux_n"), level)
            for t, _ in env.bench.edges("aux_n", edge0):
                env.window("P104-AUX-01", "edge 0 to pin", t - edge0, 2, PINS_LATEST)
        await env.host.init(*INIT_A)
        await env.host.command(0xC0 if phase == 1 else 0x81)
        await env.bench.clocks(4)
        env.check("P104-AUX-01", "aux_n untouched by init and 0xC0", env.bench.level("aux_n"), 0)


@directed("P104-AUX-02")
async def p104_aux_02_all_values(dut):
    """For all 256 data bytes of command 0x86, auxo is the inverted low nibble, and all bits change on one
    edge (P104-AUX-02).
    """
    env = await Env.start(dut, None)
    for byte in range(256):
        before, since = env.bench.level("auxo"), env.bench.now
        env.check("P104-AUX-02", "status", await env.host.send(0x86, [byte]), 0x00)
        await env.bench.clocks(2)
        now = ~byte & 0xF
        values = [value for _, value in env.bench.edges("auxo", since)]
        env.check("P104-AUX-02", f"auxo after {byte:#x}", values, [] if now == before else [now])


@directed("P104-AUX-03", "P104-SW-05", "P104-SW-04")
async def p104_aux_03_switching_parameters(dut):
    """Command 0x84 changes both times together at a phase boundary, before initialisation and while chopping
    (P104-AUX-03).
    """
    env = await Env.start(dut, None)
    await env.host.send(0x84, [0, 255])
    await env.init(0x2A, 9, 4, 4)
    await env.bench.clocks(600)
    since = env.bench.now
    await env.bench.clocks(28_000)
    env.check("P104-AUX-03", "phases", set(env.stretches(since)), {(3, 4 * 108), (0, 4 * (12 * 255 + 132))})
    await env.bench.edge("s", 3)
    since = env.bench.now - 8
    await env.host.send(0x84, [255])
    await env.bench.clocks(600)
    env.check("P104-AUX-03", "nothing changes at Pon", env.stretches(since)[0], (3, 4 * 108))
    off = await env.host.data(0)
    env.check("P104-AUX-03", "status", off, 0x00)
    await env.bench.clocks(36_000)
    got = env.stretches(since)
    expected = [(3, 4 * 108), (0, 4 * (12 * 255 + 132)), (3, 4 * (12 * 255 + 108)), (0, 4 * 132)]
    env.check("P104-SW-05", "phases around the change", got[:4], expected)


@directed("P104-AUX-04", "P104-AUX-06", "P104-PHS-05", "P104-END-08")
async def p104_aux_04_excitation_off(dut):
    """Command 0xC0 in an ON or OFF phase switches all phase pins off permanently; the hold timer continues
    (P104-AUX-04).
    """
    env = await Env.start(dut, None)
    for code, off in ((0x2A, 0), (0x22, 0x1F)):
        for phase in (0, 1):
            await env.init(code, 9, 4, 4)
            await env.bench.edge("s")
            if phase:
                await env.bench.edge("s")
            await env.bench.clocks(100)
            edge0 = await env.host.write(1, 0xC0)
            await env.bench.clocks(PINS_LATEST)
            env.check("P104-AUX-04", f"s, phase {phase}", env.bench.level("s"), off)
            await env.bench.clocks(6000)
            late = [t - edge0 for t, _ in env.bench.edges("s", edge0 + PINS_LATEST + 1)]
            env.check("P104-AUX-04", "s stays off", late, [])
            env.check("P104-AUX-06", "0xC0 again", await env.host.command(0xC0), 0x00)
            env.check("P104-AUX-06", "s", env.bench.level("s"), off)


@directed("P104-HSK-05", "P104-BUS-03")
async def p104_hsk_05_reads_one_sample_apart(dut):
    """If only one edge samples the pause between two read strobes, none of three bytes is missed
    (P104-HSK-05).
    """
    env = await Env.start(dut)
    host = env.host
    for strobe in (4, 5, 7):
        await host.send(0x44, (0xFF, 0x11, 0x22, 0x33))
        await host.command(0x40)
        await host.wait_idle()
        await host.command(0x83)
        first = await host.read(DATA, strobe, gap=1)
        again = await host.read(DATA, strobe)
        rest = [await host.read_data() for _ in range(2 if again == first else 1)]
        env.check("P104-HSK-05", f"bytes, strobes of {strobe}", [first, *rest][-3:], [0x11, 0x22, 0x33])
        env.check("P104-HSK-05", "status behind them", await host.status() & OBF, 0)
