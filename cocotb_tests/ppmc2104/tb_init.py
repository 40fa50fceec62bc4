"""Settings, stops and the auxiliary instructions (P2104-INI, P2104-STP, P2104-AUX)."""

from __future__ import annotations

from itertools import product, repeat
from typing import Any

from cocotb_tests.harness import IBF, directed
from cocotb_tests.harness.axis_driver import indices, rates, steps

from .env import Env
from .expected_timing import INIT_A, INIT_B, STEP_CODES
from .states import MOVING, enter, leave

FULL, OFF = 0b11100, 0b11111


@directed("P2104-INI-01", "P2104-INI-04", "P2104-PHS-01", "P2104-PHS-03")
async def p2104_ini_01_all_codes(dut: Any) -> None:
    """In INITIAL, all 24 bit combinations of the code set motor type, E, C and S (P2104-INI-01)."""
    env = await Env.start(dut)
    types = {1: "3", 2: "4", 3: "5"}
    for axis, chop, external, half, mm in product(env.axes, (0, 1), (0, 1), (0, 1), (1, 2, 3)):
        if axis is env.x2 and half == chop:
            continue
        code = chop << 4 | external << 3 | half << 2 | mm
        await axis.init(code, 9, 4, 4)
        # The phases of the chopper are long, so that the test samples the pattern between their edges.
        patterns = steps(f"{types[mm]} {'half' if half else 'full'}", positive=False)
        what = f"{code:#x}, axis {axis.n}"
        since = env.bench.now
        await env.bench.clocks(2_100)
        chopped = {v for _, v in env.bench.edges(axis.phases, since)}
        env.check("P2104-INI-01", f"switching by {what}", chopped, {OFF, patterns[0]} if chop else set())
        await axis.go(0x44, 3, 1)
        await env.bench.clocks(400)
        env.check("P2104-INI-01", f"pulses by the crystal, {what}", len(axis.pulses), 0 if external else 3)
        if external:
            clock = env.bench.external_clock(repeat(8), axis.clock, high=4)
            await axis.idle()
            clock.cancel()
            env.bench.set(**{axis.clock: 0})
        await axis.idle()
        read = (await axis.fetch(0x82))[0] >> 3
        shown = sum((read >> 4 - i & 1) << i for i in range(5))
        env.check("P2104-INI-01", f"pattern after 3 steps, {what}", shown, patterns[3 % len(patterns)])
        await axis.finish()
        await axis.command(0xC0)


@directed("P2104-INI-02", "P2104-INI-03", "P2104-BAD-16", "P2104-INI-05")
async def p2104_ini_03_refused_settings(dut: Any) -> None:
    """In INITIAL and NORMAL, values out of range set the first error in the order of the checks, and change
    nothing (P2104-INI-03).
    """
    env = await Env.start(dut)
    cases = (
        ((0x02, 9, 0, 4), 9),
        ((0x0A, 2, 0, 4), 0),
        ((0x0A, 1, 0, 4), 9),
        ((0x02, 3, 1, 4), 0),
        ((0x02, 2, 1, 4), 9),
        ((0x02, 1, 2, 4), 9),
        ((0x02, 255, 254, 4), 9),
        ((0x02, 255, 253, 4), 0),
        ((0x02, 9, 4, 0), 9),
        ((0x02, 9, 4, 3), 9),
        ((0x02, 9, 4, 4), 0),
        ((0x02, 9, 4, 11_220), 0),
        ((0x02, 9, 4, 11_221), 10),
        ((0x02, 9, 4, 0xFFFF), 10),
        ((0x02, 9, 0, 0xFFFF), 9),
    )
    for axis in env.axes:
        for init, error in cases:
            since = env.bench.now
            await axis.init(*init)
            env.check("P2104-INI-03", f"error of {init} in INITIAL", await axis.error(), error)
            if error:
                env.check("P2104-INI-03", "phases", env.bench.edges(axis.phases, since), [])
                await axis.refused("P2104-INI-03", "42: still INITIAL", 4, 0x42)
            await axis.command(0xC0)
        # In NORMAL, the check of RH uses the stored clock source, not bit C of the code.
        await axis.init(*INIT_A)
        await axis.init(0x0A, 9, 0, 4)
        env.check("P2104-INI-03", "RH = 0, C = 1, internal in force", await axis.error(), 9)
        await axis.move(0x43, 14)
        axis.check_train("P2104-INI-05", rates(INIT_A[1:], indices(14, 4)))
        await axis.command(0xC0)
        await axis.init(0x0A, 9, 4, 4)
        await axis.init(0x02, 9, 0, 4)
        env.check("P2104-INI-03", "RH = 0, C = 0, external in force", await axis.error(), 0)
        await axis.command(0xC0)
        await axis.finish()


@directed("P2104-INI-05", "P2104-PHS-03", "P2104-INI-06", "P2104-SW-01", "P2104-HLD-02")
async def p2104_ini_05_again_without_off(dut: Any) -> None:
    """If a setting is sent to a chopping axis again, index, pattern and chopping continue unchanged
    (P2104-INI-05).
    """
    env = await Env.start(dut)
    for axis in env.axes:
        await axis.init(0x16, *INIT_A[1:])
        await axis.move(0x4A)
        await axis.move(0x4A)
        pattern = steps("4 half", positive=False)[-2]
        await env.bench.level_is(axis.pin("hold"), 1)
        await env.bench.edge(axis.phases, OFF)
        since = env.bench.now
        for code in (0x02, 0x0B, 0x1D, 0x01):
            await axis.init(code, 30, 6, 9)
            await env.bench.clocks(1_500)
        spans = set(axis.stretches(since))
        env.check("P2104-INI-05", "chopping", spans, {(OFF, 1_328), (pattern, 664)})
        for name in ("pout_n", "dir", "hold"):
            env.check("P2104-INI-06", f"edges of {name}", axis.edges(name, since), [])
        await axis.refused("P2104-INI-05", "MM = 00", 1, 0x04)
        await axis.move(0x43, 30)
        axis.check_train("P2104-INI-05", rates((30, 6, 9), indices(30, 9)))
        env.check(
            "P2104-INI-05", "CCW steps -2, +30", axis.phases_now, steps("4 half", positive=False)[28 % 8]
        )
        await axis.command(0xC0)


@directed("P2104-INI-06", "P2104-AUX-01", "P2104-HLD-02", "P2104-INT-02")
async def p2104_ini_06_what_stays(dut: Any) -> None:
    """Code C0 and a further setting change neither the result of the last motion nor delays, a pending error
    or a pending interrupt (P2104-INI-06).
    """
    env = await Env.start(dut, errint_n=0)
    axis, other = await env.both(INIT_A)
    await env.host.command(0xF1)
    await axis.send(0x85, [0x02])
    await axis.send(0x84, [0x41, 0x42])
    await axis.go(0x4B, 100)
    await axis.pulse(5, 30)
    await axis.command(0x40)
    await axis.idle()
    end = env.bench.falls("int_n")[-1]
    await env.run("c 87 c 83")
    before = env.outputs()
    since = env.bench.now
    await axis.command(0xC0)
    await axis.send(0x12, INIT_A[1:3] + (4, 0))
    await axis.ready()
    env.check("P2104-INI-06", "unread answer", await env.run("r"), [94])
    hold = await env.bench.edge("hold[1]", 1)
    env.window("P2104-AUX-01", "hold timer ran on", hold - end, 6_144 - 4, 6_144 + 20)
    expected = {**before, "hold": 3, "s1_n": env.bench.level("s1_n")}
    env.check("P2104-INI-06", "outputs", env.outputs(), expected)
    env.check("P2104-INI-06", "edges of int_n", env.bench.edges("int_n", since), [])
    await env.bench.clocks(1_500)
    spans = set(axis.stretches(env.bench.now - 1_200))
    env.check("P2104-AUX-01", "switching times", spans <= {(FULL, 520), (OFF, 528)} and bool(spans), True)
    env.check("P2104-INI-06", "80, 83, 86", await env.run("c 80 r c 83 rrr c 86 r"), [0xC3, 94, 0, 0, 1])
    env.check("P2104-INI-06", "axis 2", await other.finish(), 0x00)


@directed("P2104-AUX-01", "P2104-PHS-02", "P2104-SW-03")
async def p2104_aux_01_excitation_off(dut: Any) -> None:
    """Code C0 in either phase of chopping switches all pins high permanently, and the axis is INITIAL
    (P2104-AUX-01).
    """
    env = await Env.start(dut)
    for axis, pattern in product(env.axes, (FULL, OFF)):
        await axis.init(0x12, *INIT_A[1:])
        await env.bench.edge(axis.phases, pattern)
        await env.bench.clocks(50)
        edge0 = await axis.command(0xC0, poll=False)
        await env.bench.clocks(4_000)
        moved = [(t - edge0, v) for t, v in env.bench.edges(axis.phases, edge0)]
        env.check("P2104-AUX-01", "phases", [v for _, v in moved], [OFF] if pattern == FULL else [])
        if moved:
            env.window("P2104-HSK-03", "edge 0 to pins", moved[0][0], 2, 12)
        await axis.refused("P2104-AUX-01", "40", 4, 0x40)
        await axis.refused("P2104-AUX-01", "C0 in INITIAL", 0, 0xC0)
        env.check("P2104-RD-05", "82", await axis.fetch(0x82), [0xFC])


@directed("P2104-STP-01", "P2104-END-02", "P2104-END-04", "P2104-STP-06", "P2104-STP-05")
async def p2104_stp_01_every_state(dut: Any) -> None:
    """In every state of either axis, code 40 ends the operation; bit I of the operation determines int_n
    (P2104-STP-01).
    """
    env = await Env.start(dut)
    done = {"ACC": 2, "HIGH": 5, "DEC": 5, "DEC natural": 5, "CONST": 2, "FIN": 1, "FIN ramp": 1}
    totals = {"DEC natural": 8, "FIN": 1, "FIN ramp": 1}
    for axis, state in product(env.axes, MOVING):
        other = env.axes[2 - axis.n]
        await other.init(*INIT_A)
        await other.running(200)
        await enter(axis, state)
        code = 4 if "CONST" in state.upper() else 2 if state == "FIN" else 3
        await axis.command(0x40)
        axis.set(run=1)
        await axis.idle()
        pulses, total = done.get(state, 0), totals.get(state, 1000)
        finish = 0x80 | code | (0 if state.startswith("FIN") else 0x40)
        await axis.result(f"P2104-STP-01 {state}", pulses, finish, max(total - pulses - 1, 0))
        env.check("P2104-STP-06", "the other axis", await env.host.status() & other.busy, other.busy)
        await other.halt()
        await leave(axis)
        await other.command(0xC0)
    axis = await env.ready(1, INIT_A)
    for code in (0x45, 0x55):
        await axis.running(40, code)
        await axis.command(0x40)
        await axis.idle()
        ints = len(env.bench.edges("int_n", axis.since))
        env.check("P2104-STP-06", f"int_n after {code:#x}", ints, 1 if code == 0x45 else 0)
        await axis.finish()


@directed("P2104-STP-01", "P2104-STP-02", "P2104-CMD-03", "P2104-STP-03")
async def p2104_stp_02_ignored_bits(dut: Any) -> None:
    """Bits 3 and 4 of the stop codes are ignored (P2104-STP-01, P2104-STP-02)."""
    env = await Env.start(dut)
    for axis, extra in product(await env.both(INIT_A), (0x00, 0x08, 0x10, 0x18)):
        await axis.go(0x43, 1000)
        await axis.pulse(3, 30)
        await axis.command(0x40 | extra)
        await axis.result("P2104-STP-01", 3, 0xC3, 996)
        await axis.go(0x43, 1000)
        await axis.pulse(8, 30)
        await axis.command(0x41 | extra)
        await axis.refused("P2104-STP-03", "a second 41", 8, 0x41 | extra)
        await axis.result("P2104-STP-02", 13, 0xC3, 986)


@directed("P2104-STP-01", "P2104-LIM-09", "P2104-GEN-07", "P2104-TIM-04")
async def p2104_stp_01_around_a_pulse(dut: Any) -> None:
    """With code 40 in each cycle near a pulse event, the pulse is either output or not, and no other result
    occurs (P2104-STP-01).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_A)
    seen = []
    for before in range(14, -4, -1):
        await axis.go(0x44, 1000, 9)
        third = await axis.pulse(3)
        await env.bench.until(third + 320 - before)
        await env.host.write(1, 0x40)
        await axis.idle()
        count = len(axis.pulses)
        seen.append(count)
        env.check("P2104-STP-01", "remaining", await axis.remaining(), 999 - count)
        low = axis.low_times[-1]
        env.check("P2104-TIM-05", "the last low time", low, 80)
        await axis.finish()
    env.check("P2104-LIM-09", "one switch-over", seen, sorted(seen))
    env.check("P2104-LIM-09", "both results occurred", set(seen), {3, 4})


@directed("P2104-AUX-02", "P2104-AUX-03", "P2104-FSM-01")
async def p2104_aux_02_pins(dut: Any) -> None:
    """After the codes of the auxiliary outputs in any order, AUXO has the inverted bits 5 and 4 of the code,
    and a read returns the AUXI levels (P2104-AUX-02, P2104-AUX-03).
    """
    env = await Env.start(dut)
    rng = env.bench.rng
    for _ in range(40):
        code = rng.choice((0xC1, 0xD1, 0xE1, 0xF1))
        level = rng.randrange(4)
        env.bench.set(auxi=level)
        edge0 = await env.host.command(code, poll=False)
        await env.bench.clocks(12)
        env.check("P2104-AUX-02", f"auxo after {code:#x}", env.bench.level("auxo"), ~(code >> 4) & 3)
        for t, _ in env.bench.edges("auxo", edge0):
            env.window("P2104-HSK-03", "edge 0 to auxo", t - edge0, 2, 12)
        env.check("P2104-AUX-03", "C2", await env.host.fetch(0xC2), [level])


@directed("P2104-AUX-04", "P2104-AUX-06", "P2104-SW-04", "P2104-SW-05", "P2104-BAD-16")
async def p2104_aux_04_switching_times(dut: Any) -> None:
    """Each axis chops with its own times, regardless of whether they were sent before or after its setting
    (P2104-AUX-04).
    """
    env = await Env.start(dut)
    await env.x2.send(0x84, [0x40, 0xFF])
    for axis, on, off in ((env.x1, 0x53, 0xA6), (env.x2, 0x40, 0xFF)):
        await axis.init(0x12, *INIT_A[1:])
        since = env.bench.now
        await env.bench.clocks(8_000)
        spans = set(axis.stretches(since))
        env.check("P2104-AUX-04", f"axis {axis.n}", spans, {(FULL, 8 * on), (OFF, 8 * off)})
    axis = env.x1
    for data, error in (([0x3F, 0x80], 11), ([0x80, 0x3F], 11), ([0, 0], 11)):
        await axis.refused("P2104-AUX-04", f"{data}", error, 0x84, *data)
    since = env.bench.now
    await env.bench.clocks(5_000)
    env.check("P2104-AUX-04", "old times stay", set(axis.stretches(since)), {(FULL, 664), (OFF, 1_328)})
    # The new times apply from the next phase on.
    on = await env.bench.edge(axis.phases, FULL)
    await axis.send(0x84, [0x90, 0x48])
    await env.bench.clocks(4_000)
    spans = [span for _, span in axis.stretches(on)]
    env.check("P2104-SW-05", "running phase, then new ones", spans[:4], [664, 576, 1_152, 576])


@directed("P2104-AUX-05", "P2104-AUX-06", "P2104-END-07", "P2104-HLD-01")
async def p2104_aux_05_running_timer(dut: Any) -> None:
    """If code 85 changes the hold delay while the hold timer runs, the present delay does not change, only
    the next one (P2104-AUX-05).
    """
    env = await Env.start(dut)
    first, second = await env.both(INIT_B)
    await second.send(0x85, [0x07])
    for axis, old, new in ((first, 0x18, 0x03), (second, 0x07, 0x10)):
        await axis.move(0x42)
        rise = env.bench.rises(axis.pout, axis.since)[-1]
        await axis.send(0x85, [new])
        hold = await env.bench.edge(axis.pin("hold"), 1)
        env.window("P2104-AUX-05", "old delay", hold - rise, 2_048 * (old + 1), 2_048 * (old + 1) + 24)
        await axis.move(0x42)
        rise = env.bench.rises(axis.pout, axis.since)[-1]
        hold = await env.bench.edge(axis.pin("hold"), 1)
        env.window("P2104-AUX-05", "new delay", hold - rise, 2_048 * (new + 1), 2_048 * (new + 1) + 24)
        await axis.command(0xC0)
        await axis.init(STEP_CODES["3 full"], *INIT_A[1:])
        await axis.move(0x42)
        rise = env.bench.rises(axis.pout, axis.since)[-1]
        hold = await env.bench.edge(axis.pin("hold"), 1)
        env.window("P2104-AUX-06", "after C0", hold - rise, 2_048 * (new + 1), 2_048 * (new + 1) + 24)


@directed("P2104-HSK-04", "P2104-FSM-01")
async def p2104_hsk_04_excitation_off_waits_for_the_table(dut: Any) -> None:
    """An Excitation OFF sent during a table build waits, and the phases do not change meanwhile
    (P2104-HSK-04).
    """
    env = await Env.start(dut)
    for axis in env.axes:
        await axis.host.init(0x02 | axis.axis_bit, 200, 4, 4)
        await axis.command(0xC0, poll=False)
        await env.bench.clocks(200)
        status = await env.host.status()
        env.check("P2104-HSK-04", "CMND and IBF", (status & axis.cmnd != 0, status & IBF), (True, IBF))
        env.check("P2104-HSK-04", "phases", axis.phases_now, FULL)
        await env.host.poll(IBF, 0)
        await env.bench.clocks(4)
        env.check("P2104-FSM-01", "phases after it", axis.phases_now, OFF)
