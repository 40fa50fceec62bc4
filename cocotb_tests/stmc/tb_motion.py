"""Motion commands: STMC-MOT, STMC-CLK, STMC-MOV, STMC-RUN, STMC-SGL, STMC-RMP, STMC-BAD-14..16.

Gap i is the time from step i to step i + 1.
"""

from __future__ import annotations

from itertools import repeat
from typing import Any

from cocotb_tests.harness import BUSY, F16, directed
from cocotb_tests.harness.checks import check_intervals

from .env import END_LATEST, Env
from .expected_timing import (
    ALL,
    EXT,
    F8X20,
    F12,
    F200,
    INTERNAL,
    MOST,
    ODD,
    STANDARD,
    SWITCHES,
    T0,
    divisor,
    gaps,
)

# Commands 2 to 7; those with a number of steps have n = 4.
MOTIONS = (
    (0x42, None, None),
    (0x43, 4, None),
    (0x44, 4, 5),
    (0x45, None, 5),
    (0x46, None, None),
    (0x47, None, 5),
)

# Frequencies of the core clock and of the crystal.
CLOCKS = (F16, F12, F200, F8X20, ODD)


@directed("STMC-MOT-06", "STMC-CLK-01", "STMC-CLK-03", "STMC-MOV-02", builds=CLOCKS)
async def stmc_clk_01_internal_clock(dut: Any) -> None:
    """For any core clock and crystal, T0 and each step occur at the times of the formula (STMC-CLK-01)."""
    env = await Env.start(dut, INTERNAL, clock=0)
    t0 = env.cfg.cyc(T0)
    for n in (4, 7):
        begin = env.bench.now
        await env.go(0x43, n)
        if falls := env.bench.falls("hold", begin):
            first = await env.pulse(1)
            env.window("STMC-MOT-06", "hold to step 0", first - falls[0], t0, t0 + 2)
        await env.outcome("STMC-MOV-02", n, 0x83, 0, gaps(n))
    await env.go(0x44, 5, 3)
    await env.outcome("STMC-MOV-01", 5, 0x84, 0, [3] * 4)


@directed("STMC-MOT-08", "STMC-MOT-09", "STMC-FIN-01")
async def stmc_mot_08_normal_end(dut: Any) -> None:
    """After the last step of a complete motion, BUSY and int_n fall at the same time (STMC-MOT-08)."""
    env = await Env.start(dut)
    for code, n, rate in (
        (0x42, None, None),
        (0x43, 5, None),
        (0x44, 5, 9),
        (0x43, 1, None),
        (0x4B, 20, None),
    ):
        await env.go(code, n, rate)
        end = await env.wait_end()
        env.window("STMC-MOT-08", "last step to int_n", end - env.pulses[-1], 0, END_LATEST)
        env.check("STMC-MOT-08", "BUSY", await env.host.status() & BUSY, 0)
        pattern = env.bench.level("s")
        env.check("STMC-FIN-01", "FIN", await env.finish(), 0x80 | code & 7)
        await env.bench.clocks(600)
        env.check("STMC-MOT-08", "pattern stays", env.bench.level("s"), pattern)


@directed("STMC-MOT-06", "STMC-CLK-02", "STMC-CLK-03")
async def stmc_clk_02_external_clock(dut: Any) -> None:
    """With irregular external ticks, step 0 occurs on a tick after T0, and gaps are counted in ticks
    (STMC-CLK-02).
    """
    env = await Env.start(dut, clock=0)
    periods = [64, 16, 33, 20, 90, 17, 16, 24, 41, 128]
    env.bench.external_clock((p for _ in repeat(0) for p in periods), high=5)
    for n in (2, 9, 12):
        begin = env.bench.now
        await env.go(0x43, n)
        await env.idle()
        steps, ticks = env.pulses, env.clock_edges(begin)
        used = [next(k for k, t in enumerate(ticks) if t + 3 == step) for step in steps]
        expected = [b - a for a, b in zip(used, used[1:], strict=False)]
        env.check("STMC-CLK-02", f"ticks between the {n} steps", expected, gaps(n))
        if falls := env.bench.falls("hold", begin):
            before = [t for t in ticks if t + 3 < steps[0] and t + 3 > falls[0] + T0 + 2]
            env.check("STMC-MOT-06", "ticks after T0 that were left out", before, [])


@directed("STMC-SGL-01", "STMC-SGL-03")
async def stmc_sgl_01_single_step_without_ticks(dut: Any) -> None:
    """If the external clock is stopped, the step of code 42 nevertheless occurs after T0 (STMC-SGL-01)."""
    env = await Env.start(dut, clock=0)
    for code in (0x42, 0x4A, 0x6A, 0x52):
        begin = env.bench.now
        await env.go(code)
        await env.idle()
        env.check("STMC-SGL-01", "steps", len(env.pulses), 1)
        if falls := env.bench.falls("hold", begin):
            env.window("STMC-SGL-01", "hold to the step", env.pulses[0] - falls[0], T0, T0 + 2)
        await env.result("STMC-SGL-03", 1, 0x82, 0)


@directed("STMC-SGL-02", "STMC-IN-03", "STMC-IN-05", "STMC-IN-06", "STMC-INP-01")
async def stmc_sgl_02_single_steps_and_switches(dut: Any) -> None:
    """Of all switches, only the limit of the direction and mon prevent single steps (STMC-SGL-02)."""
    env = await Env.start(dut, clock=0)
    for pin, bit in zip(SWITCHES, (0x08, 0x04, 0x02, 0x01, 0x80, 0x40), strict=True):
        since = env.bench.now
        await env.pins(**{pin: 0})
        env.check("STMC-INP-01", f"inputs with {pin} low", await env.inputs(), 0xCF & ~bit)
        env.quiet("STMC-IN-05", since)
        for code in (0x42, 0x4A):
            stopped = pin == "mon" or pin == ("l2_n" if code & 8 else "l1_n")
            bits = 0x20 if pin == "mon" else 0x10
            status = await env.go(code)
            env.check("STMC-IN-06", "no error", status & 0x80, 0)
            await env.result("STMC-SGL-02", 0 if stopped else 1, 0x82 | (bits if stopped else 0), 0)
        await env.pins(**{pin: 1})


@directed(
    "STMC-MOT-05", "STMC-MOT-04", "STMC-RUN-03", "STMC-IN-03", "STMC-IN-04", "STMC-DEC-03", "STMC-BAD-14"
)
async def stmc_mot_05_causes_at_the_start(dut: Any) -> None:
    """If a switch is active at the start, each motion in both directions starts or ends as STMC-MOT-05
    requires.
    """
    env = await Env.start(dut)
    for pin in (*SWITCHES, "all"):
        active = SWITCHES[:5] if pin == "all" else (pin,)
        await env.pins(**dict.fromkeys(active, 0))
        for code, n, rate in MOTIONS:
            for ccw in (0, 8):
                number = code & 7
                stop, slow = ("l2_n", "l4_n") if ccw else ("l1_n", "l3_n")
                bits = 0x20 if "mon" in active else 0x10 if stop in active else 0
                if number == 7 and slow in active:
                    bits |= 0x08
                ends = bool(bits) or (number == 7 and "cnp_n" in active)
                one = not ends and number in (3, 6) and slow in active
                if not ends and not one and n is None and number != 2:
                    continue
                await env.go(code | ccw, n, rate)
                total = {2: 1, 3: 4, 4: 4}.get(number, ALL)
                made = 0 if ends else 1 if one else total
                finish = 0x80 | number | (bits or (0x08 if one else 0))
                await env.result("STMC-MOT-05", made, finish, max(total - 1 - made, 0))
        await env.pins(**dict.fromkeys(active, 1))


@directed("STMC-MOT-05", "STMC-MOT-10", "STMC-HLD-02")
async def stmc_mot_05_times_without_a_step(dut: Any) -> None:
    """While mon is low, a motion command sets BUSY for at most 8 cycles and then asserts int_n
    (STMC-MOT-05).
    """
    env = await Env.start(dut)
    await env.pins(mon=0)
    for masked in (0, 0x10):
        begin = env.bench.now
        edge0 = await env.go(0x43 | masked, 5, poll=False)
        await env.bench.clocks(24)
        env.check("STMC-MOT-05", "status", await env.host.status(), 0)
        falls = env.bench.falls("int_n", begin)
        env.check("STMC-MOT-09", "falls of int_n", len(falls), 1 - bool(masked))
        if falls:
            env.window("STMC-MOT-05", "int_n", falls[0] - edge0, 0, 24)
            env.window("STMC-MOT-05", "hold to int_n", falls[0] - env.bench.falls("hold", begin)[0], 0, 8)
        await env.finish()
    env.check("STMC-HLD-02", "hold", env.bench.level("hold"), 0)


@directed("STMC-MOT-03", "STMC-BAD-07")
async def stmc_mot_03_divisor_0(dut: Any) -> None:
    """Divisor 0 in commands 4, 5 and 7 returns error 5 with the last byte and changes nothing
    (STMC-MOT-03).
    """
    env = await Env.start(dut)
    await env.move(0x4B, 3)
    since = env.bench.now
    for code, more in ((0x44, (9, 0, 0)), (0x45, ()), (0x47, ())):
        await env.host.command(code)
        got = [await env.status_after(byte, 0) for byte in (0, *more)]
        env.check("STMC-MOT-03", f"statuses of {code:#x}", got, [*(0x30, 0x20, 0x10)[3 - len(more) :], 0xD0])
        env.check("STMC-BAD-07", "byte after it", await env.status_after(5, 0), 0xB0)
    env.quiet("STMC-MOT-03", since)
    env.check("STMC-BAD-07", "direction", await env.out() & 2, 2)
    env.check("STMC-BAD-07", "FIN and REM", (await env.finish(), await env.remaining()), (0x83, 0))


@directed("STMC-RUN-02", "STMC-RUN-01", "STMC-MOT-04", "STMC-MOT-07")
async def stmc_run_02_counts(dut: Any) -> None:
    """If a move of any length stops after two steps, REM is the number that was sent minus two
    (STMC-RUN-02).
    """
    env = await Env.start(dut)
    for n in (3, 256, 257, 65_536, 65_537, ALL):
        await env.go(0x44, n, 6)
        await env.in_gap(1)
        await env.halt()
        env.check("STMC-MOT-07", f"REM of {n} steps", await env.remaining(), n - 3)
    for code, rate in ((0x45, 6), (0x46, None), (0x4F, 6)):
        await env.go(code, None, rate)
        await env.in_gap(4)
        await env.command(0x40)
        await env.result("STMC-RUN-02", 5, 0xC0 | code & 7, MOST - 5)


@directed("STMC-CLK-04", "STMC-BAD-15")
async def stmc_clk_04_too_fast_a_clock(dut: Any) -> None:
    """With gaps far below 64 cycles, number and order of the steps, FIN and REM are correct (STMC-CLK-04)."""
    env = await Env.start(dut, clock=0)
    await env.init(0x1A, 4, 1, 8)
    for period in (4, 6, 9):
        clock = env.bench.external_clock(repeat(period), high=2)
        await env.go(0x43, 50)
        await env.result("STMC-CLK-04", 50, 0x83, 0)
        table = [0b00011, 0b00110, 0b01100, 0b01001]
        first = table.index(env.patterns[0])
        expected = [table[(first + i) % 4] for i in range(50)]
        env.check("STMC-CLK-04", "patterns", env.patterns, expected)
        await env.go(0x45, rate=1)
        await env.pulse(20)
        await env.command(0x40)
        await env.idle()
        made = len(env.pulses)
        await env.result("STMC-CLK-04", made, 0xC5, MOST - made)
        await env.go(0x43, 5000)
        await env.pulse(40)
        await env.command(0x41)
        await env.idle()
        made = len(env.pulses)
        await env.result("STMC-CLK-04", made, 0xC3, 4999 - made)
        clock.cancel()
        env.set(ext_clk=0)


@directed("STMC-CLK-05", "STMC-BAD-15", "STMC-IN-01")
async def stmc_clk_05_a_clock_that_stops(dut: Any) -> None:
    """If the clock stops during a move, limits, code 41 and reads still work (STMC-CLK-05)."""
    env = await Env.start(dut, clock=0)
    await env.go(0x43, 100)
    await env.bench.clocks(120)
    await env.tick_until(4)
    await env.bench.clocks(3_000)
    env.check("STMC-CLK-05", "status", await env.host.status(), BUSY)
    env.check("STMC-CLK-05", "41 waits", await env.command(0x41), BUSY)
    env.check("STMC-CLK-05", "41 again", await env.command(0x41), 0xF4)
    await env.bench.clocks(2_000)
    await env.tick_until(8)
    await env.result("STMC-CLK-05", 8, 0xC3, 91)
    await env.go(0x46)
    await env.bench.clocks(120)
    await env.tick_until(6)
    stamp = env.set(l1_n=0)
    end = await env.wait_end()
    env.window("STMC-IN-02", "limit to int_n", end - stamp, 0, 8)
    await env.result("STMC-CLK-05", 6, 0x96, MOST - 6)


@directed("STMC-BAD-16", "STMC-INI-04")
async def stmc_bad_16_reset_in_motion(dut: Any) -> None:
    """If rst_n falls between two edges at various times during a motion, the core is in its reset state
    (STMC-BAD-16).
    """
    env = await Env.start(dut)
    for moment in (0, 1, 2):
        await env.go(0x43, 50)
        await env.in_gap(3 * moment, 20)
        await env.bench.set_between(rst_n=0)
        await env.bench.clocks(3)
        env.check("STMC-BAD-16", "outputs", env.outputs(), {"int_n": 1, "s": 0, "hold": 1})
        env.set(rst_n=1)
        await env.bench.clocks(4)  # bytes are accepted from here on
        env.check("STMC-BAD-16", "statuses", await env.statuses("c 42 d 00"), [0xA0, 0xB0])
        env.check("STMC-BAD-16", "FIN", await env.finish(), 0x80)
        await env.init(*STANDARD)


@directed("STMC-RMP-01", "STMC-RMP-02", "STMC-RMP-03")
async def stmc_rmp_01_ramps(dut: Any) -> None:
    """In complete moves with the reference ramps, every level has its reference value (STMC-RMP-01)."""
    env = await Env.start(dut)
    table = {
        (10, 5, 4): [10, 8, 6, 6, 5],
        (40, 10, 6): [40, 21, 16, 14, 12, 11, 10],
        (200, 20, 10): [200, 61, 44, 36, 31, 28, 26, 24, 22, 21, 20],
        (10, 6, 16): [10, 9, 9, 9, 8, 8, 8, 8, 7, 7, 7, 7, 7, 6, 6, 6, 6],
        (255, 5, 4): [255, 10, 7, 6, 5],
        (50, 25, 1): [50, 25],
    }
    for ramp, expected in table.items():
        env.check("STMC-RMP-01", "formula", [divisor(ramp, k) for k in range(ramp[2] + 1)], expected)
        await env.init(0x1A, *ramp)
        n = 2 * ramp[2] + 3
        await env.go(0x43, n)
        await env.outcome("STMC-RMP-01", n, 0x83, 0, [*expected, expected[-1], *expected[-2::-1]])


@directed("STMC-INI-02", "STMC-RMP-02", "STMC-MOV-02")
async def stmc_rmp_02_the_longest_ramp(dut: Any) -> None:
    """With PA = 65535, the speed stays at its maximum after all levels (STMC-INI-02, STMC-RMP-02)."""
    env = await Env.start(dut, (0x1A, 2, 1, 65_535))
    # Threshold form of the rule: x(k) = 1 from the first k on for which 7 * 65535 <= 27 * (k - 1).
    change = 1 + 7 * 65_535 // 27
    await env.go(0x46)
    await env.bench.clocks(EXT * (65_700 + change))
    env.set(l1_n=0)
    await env.idle()
    made, steps = len(env.pulses), env.intervals
    env.window("STMC-INI-02", "steps", made, 65_600, 65_720)
    around = steps[change - 3 : change + 3]
    check_intervals(env.bench, "STMC-RMP-02", around, [2 * EXT] * 3 + [EXT] * 3)
    check_intervals(env.bench, "STMC-MOV-02", steps[change:], [EXT] * len(steps[change:]))
    await env.result("STMC-INI-02", made, 0x96, MOST - made)
