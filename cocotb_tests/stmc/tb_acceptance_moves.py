"""Acceptance checks AC-01 to AC-20 at the pins; stimulus and values are those of the acceptance table.

Gap i is the time from step i to step i + 1. W1 to W23 are the worked moves of the manual.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import F16, directed
from cocotb_tests.harness.checks import check_intervals

from .env import Env
from .expected_timing import EXT, F10, F12, INTERNAL, STANDARD, T0

W1 = [20, 12, 9, 8, 7, 6, 6, 5, 5, 5, 5, 5, 6, 6, 7, 8, 9, 12, 20]
W2 = [20, 12, 9, 8, 7, 6, 7, 8, 9, 12, 20]
# Moves of AC-06 and AC-07: number in the command, which is the number of steps minus 1 -> gaps in ticks.
AC_06 = {
    0x0B: W2,
    0x0A: [20, 12, 9, 8, 7, 7, 8, 9, 12, 20],
    0x10: [20, 12, 9, 8, 7, 6, 6, 5, 5, 6, 6, 7, 8, 9, 12, 20],
    0x11: [20, 12, 9, 8, 7, 6, 6, 5, 5, 5, 6, 6, 7, 8, 9, 12, 20],
}
AC_07 = {0: [], 1: [20], 2: [20, 20], 3: [20, 12, 20]}


async def first_step(env: Env, rule: str, t0: int) -> None:
    """Check that step 0 of the last `go` follows the fall of hold by `t0` to `t0` + 2 cycles."""
    fall = env.bench.falls("hold", env.since)[0]
    env.window(rule, "hold fall to the first step", env.pulses[0] - fall, t0, t0 + 2)


@directed("AC-01", "STMC-ST-01", "STMC-FIN-01", "STMC-INP-01", "STMC-OUT-01", "STMC-REM-02")
async def stmc_ac_01_reset_values(dut: Any) -> None:
    """After reset, outputs, status and all registers have their reset values (AC-01)."""
    env = await Env.start(dut, None)
    env.check("AC-01", "outputs", env.outputs(), {"int_n": 1, "s": 0, "hold": 1})
    env.check("AC-01", "d_oe, d_o", (env.bench.level("d_oe"), env.bench.level("d_o")), (0, 0))
    env.check("AC-01", "status", await env.host.status(), 0x00)
    reads = await env.host.run("c 80 r c 82 r c 81 r c 83 rrr")
    env.check("AC-01", "registers", reads, [0x80, 0x04, 0xCF, 0, 0, 0])


@directed("AC-02", "STMC-MOT-01", "STMC-STP-05", "STMC-BAD-08")
async def stmc_ac_02_not_initialised(dut: Any) -> None:
    """Before initialisation, codes 42 and 40, a data byte and code C0 return errors 2, 0, 3 and 0, and no
    step is made (AC-02).
    """
    env = await Env.start(dut, None)
    env.check("AC-02", "statuses", await env.statuses("c 42 c 40 d 55 c C0"), [0xA0, 0x80, 0xB0, 0x80])
    await env.bench.clocks(500)
    env.quiet("AC-02", 0)


@directed("AC-03", "STMC-ST-02", "STMC-INI-06", "STMC-INI-08")
async def stmc_ac_03_initialisation(dut: Any) -> None:
    """During an initialisation CODE counts down; afterwards s has position 0 (AC-03)."""
    env = await Env.start(dut, None)
    got = await env.statuses("c 0A d 14 d 05 d 08 d 00")
    env.check("AC-03", "statuses", got, [0x40, 0x30, 0x20, 0x10, 0x00])
    await env.bench.clocks(2)
    env.check("AC-03", "s", env.bench.level("s"), 0b00011)
    env.check("AC-03", "edges of int_n and hold", env.bench.edges("int_n") + env.bench.edges("hold"), [])


@directed("AC-04", "STMC-INI-05", "STMC-BAD-06")
async def stmc_ac_04_motor_type_00(dut: Any) -> None:
    """Motor type 00 returns error 0 and changes nothing, before and after a valid initialisation
    (AC-04).
    """
    env = await Env.start(dut, None)
    env.check("AC-04", "statuses", await env.statuses("c 08 d 14"), [0x80, 0xB0])
    env.check("AC-04", "s", env.bench.level("s"), 0)
    env.check("AC-04", "42", await env.statuses("c 42"), [0xA0])
    await env.init(*STANDARD)
    env.check("AC-04", "statuses", await env.statuses("c 18 d 14"), [0x80, 0xB0])
    await env.move(0x43, 4)
    env.train("AC-04", [20, 12, 20])
    env.check("AC-04", "patterns", env.patterns, [0b00110, 0b01100, 0b01001, 0b00011])
    await env.result("AC-04", 4, 0x83, 0)


@directed("AC-05", "STMC-MOV-02", "STMC-MOV-03", "STMC-MOT-08")
async def stmc_ac_05_trapezoid(dut: Any) -> None:
    """With D1/D2/PA = 20/5/8, 20 steps have the gaps of W1; then int_n = 0, FIN 83, REM 0 (AC-05)."""
    env = await Env.start(dut)
    await env.host.run("c 80 r")
    env.since = env.bench.now
    await env.host.run("c 43 d 13 d 00 d 00")
    await env.idle()
    env.check("AC-05", "int_n", env.bench.level("int_n"), 0)
    env.check("AC-05", "status", await env.host.status(), 0x00)
    await env.outcome("AC-05", 20, 0x83, 0, W1)
    check_intervals(env.bench, "AC-05", [env.pulses[-1] - env.pulses[0]], [161 * EXT])


@directed("AC-06", "AC-07", "STMC-MOV-02", "STMC-RUN-01")
async def stmc_ac_06_short_moves(dut: Any) -> None:
    """With D1/D2/PA = 20/5/8, moves of 1 to 18 steps have the gaps of W2 to W6 (AC-06, AC-07)."""
    env = await Env.start(dut)
    for rule, table in (("AC-06", AC_06), ("AC-07", AC_07)):
        for number, ticks in table.items():
            await env.go(0x43, number + 1)
            await env.outcome(rule, number + 1, 0x83, 0, ticks)


@directed("AC-08", "STMC-RUN-01", "STMC-RMP-01")
async def stmc_ac_08_the_sheets_example(dut: Any) -> None:
    """With D1/D2/PA = 141/59/400, the number 32, 3, 0 results in 801 steps in 66 634 ticks (AC-08)."""
    env = await Env.start(dut, (0x1A, 141, 59, 400))
    env.since = env.bench.now
    await env.host.run("c 43 d 20 d 03 d 00")
    await env.bench.edge("int_n", 0, 2_000_000)
    steps, gaps = env.pulses, [(gap + env.bench.slack) // EXT for gap in env.intervals]
    env.check("AC-08", "steps", len(steps), 801)
    check_intervals(env.bench, "AC-08", [steps[-1] - steps[0]], [1_066_144])
    env.check("AC-08", "first gaps", gaps[:4], [141, 140, 139, 139])
    env.check("AC-08", "last gaps", gaps[-4:], [139, 139, 140, 141])


@directed("AC-09", "STMC-RMP-01", "STMC-RMP-02")
async def stmc_ac_09_a_tie_rounds_up(dut: Any) -> None:
    """With D1/D2/PA = 15/5/8 and 12 steps, the level whose value is exactly 7.5 ticks lasts 8 ticks
    (AC-09).
    """
    env = await Env.start(dut, (0x1A, 15, 5, 8))
    await env.move(0x43, 12)
    env.check("AC-09", "fourth gap", env.intervals[3], 8 * EXT)


@directed("AC-10", "STMC-CLK-01", "STMC-MOT-06")
async def stmc_ac_10_internal_clock(dut: Any) -> None:
    """With the internal clock, 5 steps at divisor 5 have gaps of 6400 cycles (AC-10)."""
    env = await Env.start(dut, (0x0A, 5, 5, 0))
    await env.move(0x43, 5)
    env.check("AC-10", "gaps", env.intervals, [6400] * 4)
    await first_step(env, "AC-10", T0)


@directed("AC-11", "STMC-CLK-01", builds=(F10,))
async def stmc_ac_11_slow_core_clock(dut: Any) -> None:
    """With a core clock of 10 MHz, 4 steps at divisor 10 have gaps of 8000 cycles (AC-11)."""
    env = await Env.start(dut, INTERNAL, clock=0)
    await env.move(0x44, 4, 10)
    env.check("AC-11", "gaps", env.intervals, [8000] * 3)
    await first_step(env, "AC-11", 50)


@directed("AC-12", "STMC-CLK-01", builds=(F12,))
async def stmc_ac_12_odd_core_clock(dut: Any) -> None:
    """With a core clock of 12.345678 MHz, 101 steps are exact to the cycle, without drift (AC-12)."""
    env = await Env.start(dut, INTERNAL, clock=0)
    await env.move(0x44, 101, 10)
    offsets = [t - env.pulses[0] for t in env.pulses]
    env.check("AC-12", "steps", len(offsets), 101)
    exact = [-(-i * 98_765_424 // 10_000) for i in range(101)]
    env.check("AC-12", "cycles from step 0", offsets, exact)
    env.check("AC-12", "gaps", sorted(set(env.intervals)), [9876, 9877])
    env.check("AC-12", "total", offsets[-1], 987_655)
    await first_step(env, "AC-12", 62)


@directed("AC-13", "STMC-SGL-01", "STMC-SGL-03", "STMC-EXC-04", "STMC-OUT-01", "STMC-MOT-06")
async def stmc_ac_13_single_steps(dut: Any) -> None:
    """Single steps, three cw and one ccw, have the expected patterns and set the outputs register (AC-13)."""
    env = await Env.start(dut)
    seen = []
    for code, register in ((0x42, None), (0x42, None), (0x42, 0x90), (0x4A, 0x32)):
        begin = env.bench.now
        await env.go(code)
        await env.busy_until(lambda begin=begin: bool(env.bench.edges("s", begin)), "AC-13")
        await env.idle()
        seen += env.patterns
        if register is not None:
            env.check("AC-13", "outputs register but HOLD", await env.out() & ~4, register)
        elif len(seen) == 1:
            await first_step(env, "AC-13", T0)
        env.check("AC-13", "FIN", await env.finish(), 0x82)
    env.check("AC-13", "patterns", seen, [0b00110, 0b01100, 0b01001, 0b01100])


async def patterns(env: Env, rule: str, code: int, expected: str) -> None:
    """Reset, initialise, and check the pattern after each single step in `moves`."""
    await env.reset()
    await env.init(code, 20, 5, 8)
    words = expected.split()
    seen = []
    for _ in words:
        await env.move(0x42)
        seen += [f"{level:05b}" for level in env.patterns]
    env.check(rule, f"patterns after {code:#04x}", seen, words)


@directed("AC-14", "AC-15", "AC-16", "AC-17", "STMC-EXC-01", "STMC-EXC-02", "STMC-EXC-04")
async def stmc_ac_14_patterns(dut: Any) -> None:
    """For each motor type and mode, single steps have the patterns of the acceptance table (AC-14 to
    AC-17).
    """
    env = await Env.start(dut, None)
    half4 = "00010 00110 00100 01100 01000 01001 00001 00011"
    await patterns(env, "AC-14", 0x1E, half4)
    await patterns(env, "AC-15", 0x19, "00110 00101 00011")
    await patterns(env, "AC-15", 0x1D, "00010 00110 00100 00101 00001 00011")
    await patterns(env, "AC-16", 0x1B, "00110 01100 11000 10001 00011")
    await patterns(env, "AC-16", 0x1F, "00111 00110 01110 01100 11100 11000 11001 10001 10011 00011")
    await env.reset()
    await env.init(0x12, 20, 5, 8)
    env.check("AC-17", "s", env.bench.level("s"), 0b11100)
    await env.move(0x42)
    env.check("AC-17", "s after a step", env.bench.level("s"), 0b11001)


@directed("AC-18", "STMC-INI-04")
async def stmc_ac_18_frozen_bits(dut: Any) -> None:
    """After an initialisation for 4 phases, full step and positive logic, an initialisation with 05 changes
    only the clock (AC-18).
    """
    env = await Env.start(dut)
    env.check("AC-18", "status", await env.host.init(0x05, 20, 5, 8), 0x00)
    await env.ready()
    await env.move(0x42)
    env.check("AC-18", "pattern", env.patterns, [0b00110])
    await env.move(0x44, 3, 3)
    env.check("AC-18", "gaps", env.intervals, [3840, 3840])


@directed("AC-19", "STMC-MOV-01")
async def stmc_ac_19_constant_speed(dut: Any) -> None:
    """At divisor 7, 5 steps have gaps of 112 cycles and FIN 84 (AC-19)."""
    env = await Env.start(dut)
    await env.go(0x44, 5, 7)
    await env.outcome("AC-19", 5, 0x84, 0, [7] * 4)


@directed("AC-20", "STMC-MOT-03", "STMC-BAD-07", builds=(F16,))
async def stmc_ac_20_divisor_0(dut: Any) -> None:
    """Divisor 0 returns error 5 with the last byte, causes no step and does not change FIN (AC-20)."""
    env = await Env.start(dut)
    got = await env.statuses("c 44 d 00 d 04 d 00 d 00")
    env.check("AC-20", "statuses", got, [0x40, 0x30, 0x20, 0x10, 0xD0])
    env.check("AC-20", "statuses", await env.statuses("c 45 d 00"), [0x10, 0xD0])
    env.check("AC-20", "statuses", await env.statuses("c 47 d 00 d 01"), [0x10, 0xD0, 0xB0])
    since = env.bench.now
    await env.bench.clocks(500)
    env.quiet("AC-20", since)
    env.check("AC-20", "FIN, REM", (await env.finish(), await env.remaining()), (0x80, 0))
