"""Stops, deceleration requests and switches during a motion: STMC-STP, STMC-DEC, STMC-IN, STMC-FIN.

Gap i is the time from step i to step i + 1.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, directed
from cocotb_tests.harness.axis_driver import differences
from cocotb_tests.harness.checks import BOTH, two_causes

from .env import END_LATEST, PINS_LATEST, Env
from .expected_timing import ALL, EXT, MOST, SWITCHES, gaps, slowed

REQUESTS = (("c 41", 0x40), ("l3_n", 0x08))


async def request(env: Env, how: str) -> None:
    """Request a deceleration, either with command 1 or with a short pulse of the limit."""
    if how == "c 41":
        await env.command(0x41)
    else:
        await env.blip(how)


@directed("STMC-DEC-01", "STMC-DEC-02", "STMC-DEC-04", "STMC-STP-03", "STMC-FIN-02", "STMC-FIN-03")
async def stmc_dec_04_every_gap_of_a_move(dut: Any) -> None:
    """In moves of 12 and 23 steps, a deceleration request in each gap results in the gaps of the rule
    (STMC-DEC-04).
    """
    env = await Env.start(dut)
    for n, how, bit in ((12, "c 41", 0x40), (23, "l3_n", 0x08)):
        for i in range(n - 1):
            await env.go(0x43, n)
            await env.in_gap(i, 20)
            await request(env, how)
            ticks = slowed(n, i)
            made = len(ticks) + 1
            finish = 0x83 | (bit if made < n else 0)
            await env.outcome("STMC-DEC-04", made, finish, max(n - 1 - made, 0), ticks)


@directed("STMC-DEC-03", "STMC-MOV-04", "STMC-DEC-04")
async def stmc_dec_03_start_speed(dut: Any) -> None:
    """In ramps that begin flat, and in flat profiles, a deceleration request at D1 stops the motion
    immediately (STMC-DEC-03).
    """
    env = await Env.start(dut)
    for ramp, last in (((10, 9, 16), 9), ((10, 6, 16), 4), ((12, 6, 0), 3), ((9, 9, 5), 3), ((50, 49, 3), 3)):
        await env.init(0x1A, *ramp)
        for how, bit in REQUESTS:
            for i in range(last):
                await env.go(0x43, 60)
                await env.in_gap(i, 40)
                await request(env, how)
                ticks = slowed(60, i, ramp)
                made = len(ticks) + 1
                await env.outcome("STMC-DEC-03", made, 0x83 | bit, 59 - made, ticks)
    # Without a ramp (D1 = D2, or PA = 0) there is no natural deceleration: a deceleration request stops the
    # motion immediately.
    for ramp in ((9, 9, 5), (12, 6, 0)):
        await env.init(0x1A, *ramp)
        for how, bit in REQUESTS:
            await env.go(0x43, 8)
            await env.in_gap(5, 40)
            await request(env, how)
            await env.outcome("STMC-MOV-04", 6, 0x83 | bit, 1, [ramp[1]] * 5)


@directed("STMC-DEC-03", "STMC-MOT-08", "STMC-IN-02")
async def stmc_dec_03_stop_at_once_is_at_once(dut: Any) -> None:
    """After a deceleration request in gap 0, BUSY falls within 8 cycles of the pin edge, or within 12 cycles
    of the byte (STMC-DEC-03).
    """
    env = await Env.start(dut)
    for how, latest in (("l3_n", 8), ("c 41", PINS_LATEST)):
        await env.go(0x43, 60)
        await env.in_gap(0, 60)
        stamp = env.bench.now
        await request(env, how)
        end = await env.wait_end()
        writes = [a.t for a in env.bench.accesses if a.kind == "write"]
        edge0 = writes[-1] if how == "c 41" else stamp
        env.window("STMC-DEC-03", f"{how} to int_n", end - edge0, 0, latest)
        await env.outcome("STMC-DEC-03", 1, 0xC3 if how == "c 41" else 0x8B, 58, [])


@directed("STMC-DEC-02", "STMC-STP-04", "STMC-FIN-03", "STMC-DEC-05")
async def stmc_dec_02_second_requests(dut: Any) -> None:
    """After an accepted deceleration request, a further code 41 returns error 7, and a further slow-down
    limit has no effect (STMC-DEC-02).
    """
    env = await Env.start(dut)
    await env.go(0x43, 100)
    await env.in_gap(6)
    env.check("STMC-DEC-02", "41", await env.command(0x41), BUSY)
    env.check("STMC-STP-04", "41 again", await env.command(0x59), 0xF4)
    await env.in_gap(8)
    await env.blip("l3_n")
    await env.outcome("STMC-FIN-03", len(slowed(100, 6)) + 1, 0xC3, 99 - 14, slowed(100, 6))
    await env.go(0x43, 100)
    await env.in_gap(6)
    await env.blip("l3_n")
    env.check("STMC-STP-04", "41", await env.command(0x41), 0xF4)
    await env.outcome("STMC-FIN-03", len(slowed(100, 6)) + 1, 0x8B, 99 - 14, slowed(100, 6))


@directed("STMC-DEC-06", "STMC-STP-06", "STMC-FIN-02", "STMC-STP-01", "STMC-IN-02")
async def stmc_dec_06_stops_in_the_ramp_down(dut: Any) -> None:
    """During a deceleration that code 41 or l3_n requested, l1_n, mon or code 40 stops the motion
    immediately, and the bits of all these causes are set (STMC-DEC-06).
    """
    env = await Env.start(dut)
    for how, first in REQUESTS:
        for stop, second in (("l1_n", 0x10), ("mon", 0x20), ("c 40", 0x40)):
            await env.go(0x46)
            await env.in_gap(10)
            await request(env, how)
            await env.in_gap(12)
            if stop == "c 40":
                await env.command(0x40)
            else:
                await env.blip(stop)
            await env.outcome("STMC-DEC-06", 13, 0x86 | first | second, MOST - 13, gaps(100)[:11] + [5])


@directed("STMC-STP-01", "STMC-STP-02", "STMC-MOT-08", "STMC-MOT-09")
async def stmc_stp_01_emergency_stop(dut: Any) -> None:
    """In each motion, no step follows code 40 or 41 that is sent at various times before a step
    (STMC-STP-01).
    """
    env = await Env.start(dut)
    moves = ((0x43, 200, None), (0x44, 200, 5), (0x45, None, 5), (0x46, None, None), (0x47, None, 5))
    for code, n, rate in moves:
        number = code & 7
        for before in range(0, 16, 3):
            stop = 0x41 if number in (4, 5, 7) and before & 1 else 0x40 | before << 3 & 0x38
            await env.go(code, n, rate)
            await env.in_gap(8, 5 * EXT - before)
            edge0 = await env.host.command(stop, poll=False)
            end = await env.wait_end()
            late = [t for t in env.pulses if t > edge0 + 12]
            env.check("STMC-STP-01", f"steps later than 12 cycles, {before} cycles before", late, [])
            made = len(env.pulses)
            env.window("STMC-STP-01", "steps", made, 9, 10)
            env.window("STMC-MOT-08", "stop to int_n", end - edge0, 0, 12 + END_LATEST)
            total = n or ALL
            await env.result("STMC-STP-01", made, 0xC0 | number, total - 1 - made)


@directed("STMC-IN-01", "STMC-IN-02", "STMC-IN-03", "STMC-MOT-08")
async def stmc_in_02_pins_before_a_step(dut: Any) -> None:
    """If a stop pin changes 4 or more cycles before a step, this step is suppressed (STMC-IN-02)."""
    env = await Env.start(dut)
    safe = 4 + 2 * env.bench.slack  # with JITTER=1, the pin may be late, and the step may be early
    for code, pin, bits in (
        (0x45, "l1_n", 0x10),
        (0x4D, "l2_n", 0x10),
        (0x45, "mon", 0x20),
        (0x47, "cnp_n", 0x00),
        (0x47, "l3_n", 0x08),
        (0x4F, "l4_n", 0x08),
    ):
        for before in (0, 1, 2, 3, 4, 5, 6, 9):
            await env.go(code, rate=6)
            step = await env.in_gap(3)
            await env.bench.until(step + 6 * EXT - before)
            stamp = env.bench.now
            await env.blip(pin, 2)
            end = await env.wait_end()
            made = len(env.pulses)
            env.window("STMC-IN-02", f"{pin}, {before} cycles before", made, 4, 4 if before >= safe else 5)
            env.window("STMC-IN-02", "pin to int_n", end - stamp, 0, 8)
            await env.result("STMC-IN-02", made, 0x80 | bits | code & 7, MOST - made)


@directed("STMC-IN-03", "STMC-IN-05", "STMC-FIN-01", "STMC-FIN-04", "STMC-RUN-03")
async def stmc_in_03_what_is_ignored(dut: Any) -> None:
    """In each motion in both directions, switches that do not apply to the motion have no effect
    (STMC-IN-03).
    """
    env = await Env.start(dut)
    cases = (
        (0x43, 12, None, ("l2_n", "l4_n", "cnp_n"), ("l1_n", "l3_n", "cnp_n")),
        (0x44, 6, 9, ("l2_n", "l4_n", "l3_n", "cnp_n"), ("l1_n", "l3_n", "l4_n", "cnp_n")),
    )
    for code, n, rate, cw, ccw in cases:
        for direction, pins in ((0, cw), (8, ccw)):
            await env.go(code | direction, n, rate)
            for i, pin in enumerate(pins):
                await env.in_gap(i)
                await env.blip(pin)
            await env.outcome("STMC-IN-03", n, 0x80 | code & 7, 0, gaps(n) if code == 0x43 else [9] * 5)
    for code, pins, stop in (
        (0x47, ("l2_n", "l4_n"), "cnp_n"),
        (0x4D, ("l1_n", "l3_n", "l4_n", "cnp_n"), "l2_n"),
    ):
        await env.go(code, rate=9)
        for i, pin in enumerate(pins):
            await env.in_gap(i)
            await env.blip(pin)
        await env.in_gap(6)
        await env.blip(stop)
        finish = 0x87 if code == 0x47 else 0x95
        await env.idle()
        for pin in SWITCHES:
            await env.blip(pin)
        await env.outcome("STMC-IN-03", 7, finish, MOST - 7, [9] * 6)
        env.check("STMC-FIN-04", "FIN with switches at rest", await env.finish(), finish)


@directed("STMC-IN-04", "STMC-FIN-02", exact="the switches must be sampled at the same edge")
async def stmc_in_04_causes_in_one_clk(dut: Any) -> None:
    """If several stop causes occur on one edge, all of them are recorded (STMC-IN-04)."""
    env = await Env.start(dut)
    for code, pins, bits, made in (
        (0x43, ("l1_n", "l3_n"), 0x10, 5),
        (0x43, ("l1_n", "mon"), 0x30, 5),
        (0x43, ("l1_n", "l3_n", "mon", "l2_n", "l4_n"), 0x30, 5),
        (0x44, ("l1_n", "l3_n"), 0x10, 5),
        (0x47, ("l1_n", "l3_n"), 0x18, 5),
        (0x47, ("cnp_n", "l3_n"), 0x08, 5),
        (0x47, ("cnp_n", "mon", "l1_n", "l3_n"), 0x38, 5),
        (0x4B, ("l2_n", "l4_n"), 0x10, 5),
        (0x4F, ("l2_n", "l4_n", "l1_n"), 0x18, 5),
    ):
        await env.go(code, 100 if code & 7 in (3, 4) else None, 9 if code & 7 in (4, 7) else None)
        await env.in_gap(4)
        env.set(**dict.fromkeys(pins, 0))
        await env.bench.clocks(3)
        env.set(**dict.fromkeys(pins, 1))
        total = 100 if code & 7 in (3, 4) else ALL
        await env.result("STMC-IN-04", made, 0x80 | bits | code & 7, total - 1 - made)


@directed("STMC-IN-04", "STMC-FIN-02", "STMC-IN-03", exact="the switches must be sampled at the same edge")
async def stmc_in_04_limit_and_monitor_on_one_edge(dut: Any) -> None:
    """If l1_n and mon fall on the same edge, both bits are set, in each operation and with either clock
    (STMC-IN-04).
    """
    env = await Env.start(dut)
    for code in (0x1A, 0x0A):
        await env.init(code, 19, 9, 4)
        await two_causes(env, "STMC-IN-04", ("l1_n", "mon"))
        env.set(l1_n=0, mon=0)
        await env.go(0x42)
        await env.result("STMC-IN-04", 0, BOTH | 2, 0)
        env.set(l1_n=1, mon=1)


@directed("STMC-IN-04", "STMC-DEC-07", "STMC-FIN-02")
async def stmc_in_04_command_and_limit_together(dut: Any) -> None:
    """If code 41 and l3_n occur near the same edge, one bit or both are set, and one deceleration follows
    (STMC-IN-04).
    """
    env = await Env.start(dut)
    for lead in range(-2, 9):
        await env.go(0x43, 100)
        step = await env.in_gap(10, 10)
        env.bench.at(step + 20 + lead, l3_n=0)
        await env.bench.until(step + 14)
        await env.host.write(1, 0x41)
        await env.bench.until(step + 40)
        env.set(l3_n=1)
        await env.idle()
        env.check("STMC-IN-04", "steps", len(env.pulses), 20)
        env.train("STMC-DEC-04", slowed(100, 10))
        env.check("STMC-FIN-02", "FIN", await env.finish() in (0xC3, 0x8B, 0xCB), True)


@directed("STMC-DEC-07", "STMC-DEC-04")
async def stmc_dec_07_requests_at_a_step(dut: Any) -> None:
    """A deceleration request 4 or more cycles before a step counts for the gap before this step
    (STMC-DEC-07).
    """
    env = await Env.start(dut)
    safe = 4 + 2 * env.bench.slack  # with JITTER=1, the request may be late, and the step may be early
    for how, _ in REQUESTS:
        for before in (0, 1, 2, 3, 4, 6, 12):
            await env.go(0x43, 100)
            step = await env.in_gap(4)
            await env.bench.until(step + 7 * EXT - before - (4 if how == "c 41" else 0))
            await request(env, how)
            await env.idle()
            choices = [slowed(100, 4)] + ([slowed(100, 5)] if before < safe else [])
            got = [(gap + env.bench.slack) // EXT for gap in differences(env.pulses)]
            env.check("STMC-DEC-07", f"{how}, {before} cycles before: {got}", got in choices, True)
            await env.finish()


@directed("STMC-FIN-02", "STMC-FIN-04", "STMC-MOT-08", "STMC-STP-04")
async def stmc_mot_08_after_the_last_step(dut: Any) -> None:
    """Switches and stops directly after the last step have no effect (STMC-MOT-08)."""
    env = await Env.start(dut)
    for wait in range(0, 10):
        for how, code in (("l1_n", 0x43), ("mon", 0x43), ("c 40", 0x43), ("c 41", 0x43), ("c 41", 0x44)):
            await env.go(code, 3, 20 if code == 0x44 else None)
            last = await env.pulse(2)
            await env.bench.until(last + 20 * EXT + wait - (3 if "_" in how or how == "mon" else 12))
            if how.startswith("c"):
                await env.host.write(1, int(how[2:], 16))
            else:
                await env.blip(how, 3)
            await env.idle()
            made = len(env.pulses)
            finish = await env.finish()
            if made == 3:
                env.check("STMC-MOT-08", f"FIN with {how}", finish, 0x80 | code & 7)
            else:
                env.check("STMC-FIN-02", f"FIN with {how}", finish & 0x70 > 0, True)


@directed("STMC-DEC-03", "STMC-STP-03", "STMC-MOT-06")
async def stmc_dec_03_requests_before_step_0(dut: Any) -> None:
    """After a deceleration request in state S of commands 3 and 6, step 0 is made and is the last
    (STMC-DEC-03).
    """
    env = await Env.start(dut, clock=0)
    for code, n in ((0x43, 30), (0x43, 1), (0x46, None)):
        for how, bit in REQUESTS:
            await env.go(code, n)
            await request(env, how)
            await env.bench.clocks(200)
            env.check("STMC-DEC-03", "steps before a tick", env.pulses, [])
            env.check("STMC-DEC-02", "41", await env.command(0x41), 0xF4)
            await env.ticks(2)
            total = n or ALL
            finish = 0x80 | code & 7 | (bit if n != 1 else 0)
            await env.result("STMC-DEC-03", 1, finish, max(total - 2, 0))


@directed("STMC-REM-01", "STMC-FIN-02", "STMC-RUN-01")
async def stmc_rem_01_the_rest_can_be_sent_again(dut: Any) -> None:
    """If REM of a stopped move is sent as the number of another command, exactly the missing steps are made
    (STMC-REM-01).
    """
    env = await Env.start(dut)
    for n, gap in ((30, 4), (12, 9), (6, 4)):
        for code, rate in ((0x43, None), (0x44, 6)):
            await env.go(code, n, rate)
            await env.in_gap(gap)
            await env.command(0x40)
            await env.result("STMC-REM-01", gap + 1, 0xC0 | code & 7, n - 2 - gap)
            left = await env.remaining()
            await env.go(code, left + 1, rate)
            await env.result("STMC-REM-01", n - gap - 1, code & 7 | 0x80, 0)
