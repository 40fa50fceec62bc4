"""Initialisation and Excitation OFF (P104-INI, P104-AUX-04/06, P104-PHS-02..05)."""

from __future__ import annotations

from cocotb_tests.harness import DATA, F16, F50, IBF, directed
from cocotb_tests.harness.config import F16X1

from .env import PINS_LATEST, Env
from .expected_timing import INIT_A, INIT_B, rates, steps

ALL_PINS = 0x1F


def off_level(code: int) -> int:
    """Return the level of the five pins with all windings off."""
    return 0 if code & 8 else ALL_PINS


@directed("P104-INI-01", "P104-PHS-01", "P104-PHS-03", "P104-INI-05")
async def p104_ini_01_code_bits(dut):
    """In all 48 codes, the bits select motor type, method, logic, clock and chopping (P104-INI-01)."""
    env = await Env.start(dut, None)
    for code in (c for c in range(0x40) if c & 3):
        table = steps(f"{(code & 3) + 2} {'half' if code & 4 else 'full'}", bool(code & 8))
        await env.init(code, 3, 1, 4)
        await env.bench.clocks(2)
        env.check("P104-PHS-03", f"s of {code:#04x}", env.bench.level("s"), table[0])
        since = env.bench.now
        await env.go(0x44, 2, rate=0)
        await env.bench.clocks(200)
        external = bool(code & 0x10)
        env.check(
            "P104-INI-01", f"pulses without a clock, {code:#04x}", len(env.pulses), 0 if external else 2
        )
        if external:
            await env.ticks(2, 200)
        await env.idle()
        patterns = [value for _, value in env.bench.edges("s", since)]
        env.check("P104-INI-01", f"steps of {code:#04x}", patterns[-2:], [table[1], table[2]])
        rest = env.bench.now
        await env.bench.clocks(2000)
        off = [v for _, v in env.bench.edges("s", rest)]
        env.check(
            "P104-INI-01", f"chopping of {code:#04x}", off[:1], [off_level(code)] if code & 0x20 else []
        )
        await env.host.command(0xC0)


@directed("P104-INI-05", "P104-INI-07", "P104-TIM-01", "P104-INI-02")
async def p104_ini_07_pattern_at_the_last_byte(dut):
    """With the longest table build, s has pattern 0 as soon as the 4th byte is accepted, and not before
    (P104-INI-07).
    """
    env = await Env.start(dut, None)
    await env.host.send(0x0A, [255, 0, 11220 & 0xFF])
    env.check("P104-INI-05", "edges of s before the last byte", env.bench.edges("s"), [])
    edge0 = await env.host.write(DATA, 11220 >> 8)
    await env.bench.clocks(PINS_LATEST)
    ((t, value),) = env.bench.edges("s")
    env.check("P104-INI-07", "s", value, 0b00011)
    env.window("P104-INI-07", "edge 0 to s", t - edge0, 2, PINS_LATEST)
    await env.host.command(0xC1, poll=False)
    env.check("P104-INI-07", "the table is still being built", await env.host.status(), IBF)
    await env.host.poll(IBF, 0)


@directed("P104-INI-06", "P104-BAD-10", "P104-ERR-02", "P104-PHS-02", builds=(F16, F50))
async def p104_ini_06_rejected(dut):
    """After a rejected initialisation, an uninitialised core is still uninitialised, and an initialised core
    is unchanged (P104-INI-06).
    """
    env = await Env.start(dut, None)
    idle = env.bench.part.reset_levels(env.cfg.params)["s"]
    await env.host.init(0x0F, 4, 5, 4)
    env.check("P104-INI-06", "0x42 after the rejection", await env.host.command(0x42), 0xA0)
    env.check("P104-PHS-02", "s", (env.bench.level("s"), env.bench.edges("s")), (idle, []))
    await env.init(*INIT_A)
    await env.bench.clocks(2)
    since = env.bench.now
    for code, rl, rh, pa in ((0x3A, 4, 5, 4), (0x1A, 9, 4, 20000), (0x2A, 9, 4, 3)):
        env.check("P104-INI-06", "ERR", await env.host.init(code, rl, rh, pa) & 0x80, 0x80)
    await env.bench.clocks(round(1800 * env.cfg.clk_hz / 16e6))
    env.check("P104-INI-06", "s: no chopping", env.bench.edges("s", since), [])
    await env.move(0x43, 14)
    env.check_train("P104-INI-06", [9, 7, 5, 5, 4, 4, 4, 4, 4, 5, 5, 7, 9])
    await env.init(0x2A, 9, 4, 4)
    await env.host.init(0x0A, 4, 5, 4)
    await env.bench.edge("s", 0)


@directed("P104-INI-04", "P104-INI-09", "P104-INI-05")
async def p104_ini_09_reinit(dut):
    """After a re-initialisation, the next moves use the new rates, ramp and clock source (P104-INI-09)."""
    env = await Env.start(dut, INIT_A)
    await env.move(0x43, 6)
    for code, rl, rh, pa in ((0x0A, 20, 6, 7), (0x0A, 3, 3, 100), (0x0E, 12, 0, 5)):
        await env.init(code, rl, rh, pa)
        await env.move(0x43, 12)
        which = [min(j, 10 - j, pa) for j in range(11)]
        env.check_train("P104-INI-09", rates((rl, rh, pa), which))
    await env.init(0x1A, 0, 0, 4)
    await env.go(0x44, 3, rate=1)
    await env.bench.clocks(500)
    env.check("P104-INI-09", "pulses without clock edges", len(env.pulses), 0)
    env.check("P104-INI-04", "init while BUSY", await env.host.command(0x0A), 0x94)
    await env.tick_until(3)
    await env.idle()
    await env.init(*INIT_A)
    env.bench.set(csel=0, vsel=0)
    await env.bench.clocks(4)
    await env.move(0x44, 4, rate=2)
    env.check_train("P104-INI-09", [2] * 3, csel=0, vsel=0)


@directed("P104-INI-05", "P104-PHS-03", "P104-PHS-04", "P104-PHS-05", "P104-AUX-04")
async def p104_ini_05_index_kept(dut):
    """A re-initialisation does not change index and pattern; an initialisation after command 0xC0 begins with
    index 0 (P104-INI-05).
    """
    env = await Env.start(dut, INIT_A)
    await env.move(0x44, 3, rate=5)
    table = steps("4 full")
    for code in (0x0A, 0x02, 0x0F, 0x09):
        await env.init(code, 9, 4, 4)
        await env.bench.clocks(4)
        env.check("P104-PHS-03", f"s after re-init {code:#x}", env.bench.level("s"), table[3])
    await env.bench.clocks(20_000)
    env.check("P104-PHS-04", "s at rest", env.bench.level("s"), table[3])
    await env.move(0x42)
    env.check("P104-PHS-03", "s after one more step", env.bench.level("s"), table[0])
    await env.move(0x42)
    await env.host.command(0xC0)
    await env.bench.clocks(5000)
    env.check("P104-PHS-05", "s after Excitation OFF", env.bench.level("s"), 0)
    await env.init(0x02, 9, 4, 4)
    await env.bench.clocks(2)
    env.check("P104-PHS-03", "s of the new logic", env.bench.level("s"), 0b11100)
    await env.host.command(0xC0)
    await env.bench.clocks(5000)
    env.check("P104-PHS-05", "s off, negative logic", env.bench.level("s"), 0b11111)
    env.check("P104-AUX-04", "operations need a new init", await env.host.command(0x46), 0xA0)


@directed("P104-INI-08", "P104-SW-02", "P104-SW-03")
async def p104_ini_08_chopping_and_completion(dut):
    """During a re-initialisation chopping continues with the old bit S until completion; then, with S = 1, it
    restarts with an ON phase (P104-INI-08).
    """
    env = await Env.start(dut, None)
    on, off = 0b00011, 0
    await env.host.send(0x2A, [255, 0, 11220 & 0xFF])
    await env.host.data(11220 >> 8)
    await env.host.command(0xC1, poll=False)
    completed = await env.bench.edge("aux_n", 0)
    first_off = await env.bench.edge("s", off)
    # The mailbox opens at completion; aux_n follows within 10 cycles.
    env.window("P104-INI-08", "completion to the first OFF phase", first_off - completed, 1040 - 10, 1040 + 6)
    env.check("P104-INI-08", "edges of s before", [v for _, v in env.bench.edges("s")], [on, off])
    before = set()
    for wait in (0, 700, 1400, 2100):
        await env.bench.clocks(wait)
        await env.host.send(0x2A, [255, 0, 11220 & 0xFF])
        since = env.bench.now
        await env.host.data(11220 >> 8)
        now_on = env.bench.level("aux_n")
        await env.host.command(0xC1 if now_on else 0xC2, poll=False)
        completed = await env.bench.edge("aux_n", 1 - now_on)
        times = [clk for _, clk in env.stretches(since)]
        env.check("P104-INI-08", "old chopping continues in the build", set(times[:-1]) <= {1040, 1740}, True)
        env.window("P104-INI-08", "phases in the build", len(times), 2, 40)
        before.add(env.bench.level_at("s", completed - 12))
        await env.bench.clocks(3)
        env.check("P104-INI-08", "s right after completion", env.bench.level("s"), on)
        restarted = await env.bench.edge("s", off)
        env.window("P104-INI-08", "a full ON phase again", restarted - completed, 1040 - 10, 1040 + 6)
    env.check("P104-INI-08", "completion met both phases", before, {on, off})
    await env.init(0x0A, 9, 4, 4)
    await env.bench.clocks(4)
    since = env.bench.now
    env.check("P104-INI-08", "S = 0: pattern on", env.bench.level("s"), on)
    await env.bench.clocks(4000)
    env.check("P104-SW-03", "S = 0: no chopping", env.bench.edges("s", since), [])


@directed("P104-INI-10", "P104-AUX-04", "P104-AUX-06")
async def p104_ini_10_leaves_the_rest(dut):
    """Initialisation and Excitation OFF change only the excitation; all other pins and registers keep their
    values (P104-INI-10).
    """
    env = await Env.start(dut, INIT_B)
    await env.host.run("c C1 c 86 d 05 c 84 d 01 d 02")
    await env.go(0x4B, 200)
    await env.pulse(3, 50)
    await env.host.command(0x40)
    await env.idle()
    await env.host.command(0x85)
    since = env.bench.now
    for step in ("init", "reinit", "off", "off again", "init"):
        if "off" in step:
            env.check("P104-AUX-06", step, await env.host.command(0xC0), 0x01)
        else:
            await env.host.init(0x2A, 9, 4, 4)
            await env.host.command(0xC1)
        for pin in ("aux_n", "auxo", "dir", "hold", "int_n", "pout_n"):
            env.check("P104-INI-10", f"edges of {pin}, {step}", env.bench.edges(pin, since), [])
    await env.bench.clocks(1200)
    since = env.bench.now
    await env.bench.clocks(2400)
    times = {clk for _, clk in env.stretches(since)}
    env.check("P104-AUX-04", "switching parameters stay", times, {4 * (12 + 108), 4 * (24 + 132)})
    env.check("P104-AUX-04", "queue stays", await env.host.read_data(), 0x00)
    await env.result("P104-AUX-04", 3, 0xC3, 196)


@directed("P104-AUX-06", "P104-PHS-02", builds=(F16, F16X1))
async def p104_aux_06_off_before_init(dut):
    """Command 0xC0 before the first initialisation has no visible effect (P104-AUX-06)."""
    env = await Env.start(dut, None)
    env.check("P104-AUX-06", "status", await env.host.command(0xC0), 0x00)
    await env.bench.clocks(20)
    moved = {name: env.bench.edges(name) for name in env.outputs()}
    env.check("P104-AUX-06", "edges of all outputs", moved, {name: [] for name in moved})
    idle = 0x1F if env.cfg.phase_idle else 0x00
    env.check("P104-PHS-02", "s", env.bench.level("s"), idle)
    bits = 0xF8 if idle else 0x00
    env.check("P104-RD-06", "0x82: the pin levels", await env.host.fetch(0x82), [bits | 0x04])
