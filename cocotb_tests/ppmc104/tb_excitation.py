"""Excitation (P104-PHS) and switching at standstill (P104-SW)."""

from __future__ import annotations

from cocotb_tests.harness import F8, F11, F16, F25, F50, directed

from .env import Env
from .expected_timing import INIT_A, STEP_CODES, steps

A_VALUES = (9, 4, 4)


@directed("P104-PHS-01", "P104-PHS-06", "P104-OPR-05", "P104-EX-09", builds=(F16, F50))
async def p104_phs_01_lists_in_motion(dut):
    """For all motors and logics, each pulse selects the next row of the list in both directions; the list
    wraps around (P104-PHS-01).
    """
    env = await Env.start(dut, None)
    for name, code in STEP_CODES.items():
        for positive in (True, False):
            table = steps(name, positive)
            await env.host.command(0xC0)
            await env.init(code if positive else code & ~8, *A_VALUES)
            index = 0
            for op, count in ((0x44, 13), (0x4C, 20), (0x44, 7)):
                since = env.bench.now
                await env.move(op, count, rate=4)
                step = -1 if op & 8 else 1
                expected = [table[(index + step * i) % len(table)] for i in range(1, count + 1)]
                index += step * count
                got = env.bench.edges("s", since)
                env.check("P104-PHS-01", f"{name}, {op:#x}", [v for _, v in got], expected)
                env.check("P104-TIM-04", "edges of s are the pulses", [t for t, _ in got], env.pulses)


@directed("P104-PHS-06", "P104-PHS-01")
async def p104_phs_06_half_step_alignment(dut):
    """The full-step list consists of every second row of the half-step list (P104-PHS-06)."""
    env = await Env.start(dut, None)
    for phases in (3, 4, 5):
        await env.host.command(0xC0)
        await env.init(STEP_CODES[f"{phases} half"], *A_VALUES)
        await env.bench.clocks(2)
        got = [env.bench.level("s")]
        for _ in range(2 * phases):
            await env.move(0x42)
            got.append(env.bench.level("s"))
        full = steps(f"{phases} full")
        env.check("P104-PHS-06", f"even indices, {phases} phases", got[::2], [*full, full[0]])
        ones = [bin(value).count("1") for value in got[1::2]]
        env.check("P104-PHS-06", "windings on at odd indices", set(ones), {3 if phases == 5 else 1})


@directed("P104-PHS-02", "P104-PHS-03", "P104-PAR-01", builds=(F16, F50))
async def p104_phs_02_idle_level(dut):
    """Until the first initialisation, s has the level PHASE_IDLE, regardless of all commands
    (P104-PHS-02).
    """
    env = await Env.start(dut, None)
    idle = 0x1F if env.cfg.phase_idle else 0
    env.check("P104-PHS-02", "s", env.bench.level("s"), idle)
    await env.statuses("c C0 c 42 c 46 c 84 d 01 d 01 c 0A d 04 d 09 d 04 d 00 c C1 c C2 c 82")
    await env.bench.clocks(4000)
    env.check("P104-PHS-02", "edges of s", env.bench.edges("s"), [])
    await env.init(*INIT_A)
    env.check("P104-PHS-03", "edges of s by init", [v for _, v in env.bench.edges("s")], [0b00011])


@directed("P104-PHS-04", "P104-STP-01", "P104-END-02")
async def p104_phs_04_held_at_every_stop(dut):
    """After a stop by command 0x40 or 0x41, or by L1, ALM or CNP, the pattern stays on (P104-PHS-04)."""
    env = await Env.start(dut, INIT_A)
    for stop in ("40", "41", "l1_n", "alm_n", "cnp_n"):
        await env.go(0x47, None, 9)
        await env.pulse(3, 100)
        if stop in ("40", "41"):
            await env.host.command(int(stop, 16))
        else:
            env.bench.set(**{stop: 0})
        await env.idle()
        rest, pattern = env.bench.now, env.bench.level("s")
        env.check("P104-PHS-04", "a pattern", pattern in steps("4 full"), True)
        if stop.endswith("_n"):
            env.bench.set(**{stop: 1})
        await env.bench.clocks(3000)
        env.check("P104-PHS-04", f"edges of s after {stop}", env.bench.edges("s", rest), [])


@directed("P104-SW-01", "P104-SW-04", "P104-SW-06", "P104-GEN-04", builds=(F16, F8, F11, F25, F50))
async def p104_sw_06_accuracy(dut):
    """For each core clock, each phase in 12 periods of the chopper is accurate to one quantum, and there is
    no drift (P104-SW-06).
    """
    env = await Env.start(dut, (0x2E, *A_VALUES))
    quantum = 4 * env.cfg.clk_hz / env.cfg.xtal_hz
    for vsel, parameters, on, off in (
        (1, None, 260, 435),
        (0, None, 260, 435),
        (1, (2, 3), 12 * 2 + 108, 12 * 3 + 132),
        (0, (2, 3), 12 * 2 + 100, 12 * 3 + 115),
        (1, (0, 0), 108, 132),
        (0, (0, 9), 100, 12 * 9 + 115),
    ):
        env.bench.set(vsel=vsel)
        if parameters:
            await env.host.send(0x84, parameters)
        await env.bench.edge("s", 0)
        await env.bench.edge("s", 3)
        since = env.bench.now - 8
        await env.bench.clocks(round(12.2 * (on + off) * quantum))
        edges = [t for t, v in env.bench.edges("s", since) if v == 3]
        env.check("P104-SW-06", "complete periods", len(edges) >= 12, True)
        for value, clk in env.stretches(since):
            nominal = (on if value == 3 else off) * quantum
            env.window(
                "P104-SW-06",
                f"phase {value}, vsel {vsel}",
                round(abs(clk - nominal) * 100),
                0,
                round(quantum * 100 + 100),
            )
        for i, t in enumerate(edges):
            drift = abs(t - edges[0] - i * (on + off) * quantum)
            env.window(
                "P104-SW-06", f"drift after {i} periods", round(drift * 100), 0, round(quantum * 100 + 100)
            )


@directed("P104-SW-01", "P104-SW-02", "P104-PHS-01")
async def p104_sw_01_off_phase_levels(dut):
    """With S = 1, an OFF phase drives all five pins of each motor and logic to the off level, without
    intermediate levels (P104-SW-01).
    """
    env = await Env.start(dut, None)
    for name, code in STEP_CODES.items():
        for positive in (True, False):
            await env.host.command(0xC0)
            await env.init((code if positive else code & ~8) | 0x20, *A_VALUES)
            since = env.bench.now
            await env.bench.clocks(4000)
            values = {v for _, v in env.bench.edges("s", since)}
            off = 0 if positive else 0x1F
            env.check("P104-SW-01", f"levels of {name}", values, {steps(name, positive)[0], off})


@directed("P104-SW-02", "P104-SW-03", "P104-SW-04", builds=(F16, F25))
async def p104_sw_02_start_and_stop(dut):
    """With S = 1, the full pattern is on from the start of a motion; after the fall of BUSY, a complete ON
    phase follows (P104-SW-02).
    """
    env = await Env.start(dut, (0x2A, *A_VALUES))
    us, w = env.cfg.us, env.cfg.w
    for wait in (10, 300, 1030, 1100, 2000):
        await env.bench.clocks(env.cfg.cyc(wait))
        await env.host.fetch(0x80)
        since = env.bench.now
        await env.go(0x4B, 3)
        first = await env.pulse(1)
        end = await env.wait_end()
        off = await env.bench.edge("s", 0)
        env.check("P104-SW-03", "s just before pulse 1", env.bench.level_at("s", first - w) != 0, True)
        inside = [t for t, _ in env.bench.edges("s", first - w + 1) if t < off]
        env.check("P104-SW-03", "edges of s up to the first OFF", inside, env.pulses)
        quantum = us(0.25) + 1
        env.window("P104-SW-02", "BUSY fall to OFF", off - end, us(65) - quantum, us(65) + quantum + 2)
        env.check("P104-SW-02", "the start was later", since < first, True)


@directed("P104-SW-05")
async def p104_sw_05_sampled_at_phase_starts(dut):
    """If parameters or vsel change within a phase, this phase keeps its length, and the next phase has the
    new length (P104-SW-05).
    """
    env = await Env.start(dut, (0x2A, *A_VALUES))
    await env.host.send(0x84, [5, 5])
    on = {1: 4 * (60 + 108), 0: 4 * (60 + 100)}
    off = {1: 4 * (60 + 132), 0: 4 * (60 + 115)}
    await env.bench.clocks(4000)
    for vsel in (0, 1, 0):
        for phase, current, other in ((3, on, off), (0, off, on)):
            await env.bench.edge("s", phase)
            since = env.bench.now - 4
            await env.bench.clocks(300)
            before = env.bench.pins["vsel"]
            env.bench.set(vsel=vsel)
            await env.bench.clocks(1200)
            got = [clk for _, clk in env.stretches(since)][:2]
            env.check("P104-SW-05", f"phase {phase}, vsel -> {vsel}", got, [current[before], other[vsel]])


@directed("P104-SW-07", "P104-SW-01", "P104-SW-03")
async def p104_sw_07_others_do_not_see_it(dut):
    """Chopping at standstill does not change pout_n, dir, hold or the answer to command 0x82; command 0xC0
    ends the chopping (P104-SW-07).
    """
    env = await Env.start(dut, (0x2A, *A_VALUES))
    await env.move(0x4A)
    await env.finish()
    since = env.bench.now
    seen = set()
    for _ in range(12):
        seen.add(tuple(await env.host.fetch(0x82)))
        await env.bench.clocks(377)
    moved = {pin: env.bench.edges(pin, since) for pin in ("pout_n", "dir", "hold", "int_n")}
    env.check("P104-SW-07", "edges", moved, {pin: [] for pin in moved})
    env.check("P104-SW-07", "0x82", seen, {(0x92,)})
    env.check("P104-SW-01", "it was chopping", len(env.bench.edges("s", since)) > 2, True)
    await env.host.command(0xC0)
    await env.bench.clocks(4)
    since = env.bench.now
    await env.bench.clocks(4000)
    env.check("P104-SW-03", "edges of s after 0xC0", env.bench.edges("s", since), [])
