"""Forced deceleration (P104-FDC, P104-EX-04, P104-EX-05).

I(j) is the interval that follows pulse j. The C-event of a byte is the edge on which the core consumes it.
"""

from __future__ import annotations

from cocotb_tests.harness import F16, F25, F100, directed

from .env import Env
from .expected_timing import INIT_B, forced, indices, rates

RAMP = INIT_B[1:]
LIMITS = {0: "l3_n", 1: "l4_n"}


@directed("P104-EX-04", "P104-FDC-02", "P104-FDC-03")
async def p104_ex_04_stop_in_each_phase(dut):
    """Command 0x41 or L3 in the acceleration, in I(1), on the plateau or in START results in the values of
    P104-EX-04.
    """
    env = await Env.start(dut, INIT_B)
    cases = ((4, 8, [19, 17, 15, 14, 15, 17, 19], 0x3DF), (1, 2, [19], 0x3E5))
    for j, count, expected, rest in cases:
        await env.go(0x43, 1000)
        await env.pulse(j, 100)
        await env.host.command(0x41)
        await env.result("P104-EX-04", count, 0xC3, rest)
        env.check_train("P104-EX-04", expected)
    await env.go(0x43, 1000)
    await env.pulse(29, 100)
    await env.host.command(0x41)
    await env.result("P104-EX-04", 40, 0xC3, 0x3BF)
    env.check(
        "P104-EX-04",
        "tail",
        [i // 32 - 1 for i in env.intervals[29:]],
        [9, 10, 10, 11, 12, 12, 14, 15, 17, 19],
    )
    env.bench.set(l3_n=0)
    await env.go(0x43, 1000)
    await env.result("P104-EX-04", 1, 0x8B, 0x3E6)
    await env.go(0xC3, 1000)
    await env.result("P104-EX-05", 22, 0x8B, 0x3D1)


@directed("P104-FDC-01", "P104-FDC-02", "P104-LIM-04", "P104-END-03", "P104-END-04", builds=(F16, F100))
async def p104_fdc_01_limit_in_each_interval(dut):
    """If the slow-down limit of the direction falls in any interval of a phase-mode move, the ramp is
    mirrored (P104-FDC-01).
    """
    env = await Env.start(dut, INIT_B)
    for direction in (0, 1):
        pin = LIMITS[direction]
        for j in range(1, 14, 1 if env.cfg is F16 or env.cfg.name == "f16" else 4):
            await env.go(0x43 | direction << 3, 200)
            await env.pulse(j, 30)
            env.bench.set(**{pin: 0})
            await env.idle()
            env.bench.set(**{pin: 1})
            which = forced(200, 10, j)
            env.check_train("P104-FDC-02", rates(RAMP, which))
            count = len(which) + 1
            await env.result("P104-FDC-01", count, 0x8B, 200 - count - 1)


@directed("P104-FDC-01", "P104-STP-04", "P104-GEN-07")
async def p104_fdc_01_running_interval_unaltered(dut):
    """A slow-down limit does not change the interval in which it occurs. The remaining intervals are the same
    for each position within this interval (P104-FDC-01).
    """
    env = await Env.start(dut, INIT_B)
    for delay in (1, 2, 3, 79, 80, 81, 300, 470):
        await env.go(0x43, 200)
        await env.pulse(4, delay)
        env.bench.set(l3_n=0)
        await env.bench.clocks(4)
        env.bench.set(l3_n=1)
        env.check("P104-FDC-01", "state is DEC: 0x41 gives", await env.host.command(0x41), 0xF4)
        await env.result("P104-FDC-01", 8, 0x8B, 191)
        env.check_train("P104-FDC-01", [19, 17, 15, 14, 15, 17, 19])


@directed("P104-FDC-03", "P104-LIM-04", "P104-EX-04")
async def p104_fdc_03_flag_in_start(dut):
    """With command 0x41 or the slow-down limit in START, exactly one pulse is output (P104-FDC-03)."""
    env = await Env.start(dut, INIT_B)
    for code, n in ((0x43, 50), (0x46, None), (0xC3, 50), (0x43, 1)):
        await env.go(code, n)
        env.check("P104-FDC-03", "0x41 in START", await env.host.command(0x41), 0x04)
        rest = (n or 1 << 24) - 2
        await env.result("P104-FDC-03", 1, 0x83 if n == 1 else 0xC0 | code & 7, max(rest, 0))
    for code in (0x43, 0x4B, 0x46, 0x4E):
        pin = LIMITS[code >> 3 & 1]
        await env.go(code, 50 if code & 7 == 3 else None)
        await env.bench.pulse_pin(pin, 0, 3)
        await env.result("P104-FDC-03", 1, 0x88 | code & 7)


@directed("P104-FDC-04", "P104-BAD-20", "P104-LIM-04")
async def p104_fdc_04_never_withdrawn(dut):
    """After the deceleration flag is set, a slow-down limit that bounces or is released does not change the
    deceleration (P104-FDC-04).
    """
    env = await Env.start(dut, INIT_B)
    await env.go(0x43, 200)
    await env.pulse(12, 30)
    env.bench.set(l3_n=0)
    while len(env.pulses) < 22:
        await env.bench.clocks(env.bench.rng.randrange(2, 60))
        env.bench.set(l3_n=env.bench.rng.randrange(2))
    env.bench.set(l3_n=1)
    await env.result("P104-FDC-04", 23, 0x8B, 176)
    env.check_train("P104-FDC-04", rates(RAMP, forced(200, 10, 12)))


@directed("P104-FDC-05", "P104-END-05", "P104-PRO-04")
async def p104_fdc_05_complete_all_the_same(dut):
    """If N equals the length of the mirrored ramp, command 0x41 or L3 is accepted, and the motion is
    nevertheless complete (P104-FDC-05).
    """
    env = await Env.start(dut, INIT_B)
    for j in (1, 4, 10):
        # A deceleration forced at index j - 1 results in 2j pulses. The natural deceleration for N = 2j
        # begins later, at the next pulse.
        for stop in ("41", "l3"):
            await env.go(0x43, 2 * j)
            await env.pulse(j, 20)
            if stop == "41":
                env.check("P104-FDC-05", f"0x41 in I({j})", await env.host.command(0x41), 0x04)
            else:
                await env.bench.pulse_pin("l3_n", 0, 4)
            await env.result("P104-FDC-05", 2 * j, 0x83, 0)
            env.check_train("P104-FDC-05", rates(RAMP, indices(2 * j, 10)))


@directed("P104-FDC-06", "P104-LIM-01", builds=(F16, F25))
async def p104_fdc_06_latency(dut):
    """If a slow-down limit falls at least 4 cycles before a pulse event, the deceleration begins with this
    event (P104-FDC-06).
    """
    env = await Env.start(dut, INIT_B)
    fifth = env.cfg.quanta(8 * (20 + 18 + 16 + 15))
    outcomes = []
    for before in range(12, -6, -1):
        await env.go(0x43, 200)
        first = await env.pulse(1)
        await env.bench.until(first + fifth - before)
        env.bench.set(l3_n=0)
        await env.bench.clocks(2)
        env.bench.set(l3_n=1)
        await env.idle()
        count = len(env.pulses)
        outcomes.append(count)
        env.check("P104-FDC-06", "8 pulses in time, 10 too late", count in (8, 10), True)
        # The pin changes at most 2 cycles after the pulse event.
        if before >= 4 + 2:
            env.check("P104-FDC-06", f"pulses, {before} cycles before", count, 8)
        await env.result("P104-FDC-06", count, 0x8B, 200 - count - 1)
    env.check("P104-FDC-06", "one switch-over", outcomes, sorted(outcomes))
    env.check("P104-FDC-06", "both outcomes were met", set(outcomes), {8, 10})


@directed("P104-FDC-06", "P104-STP-03")
async def p104_fdc_06_latency_of_the_command(dut):
    """If the C-event of command 0x41 occurs at least 4 cycles before a pulse event, the deceleration begins
    with this event (P104-FDC-06).
    """
    env = await Env.start(dut, INIT_B)
    fifth = 32 * (20 + 18 + 16 + 15)
    outcomes = []
    for before in range(22, 0, -1):
        await env.go(0x43, 200)
        first = await env.pulse(1)
        await env.bench.until(first + fifth - before - 2)
        await env.host.write(1, 0x41)
        await env.idle()
        count = len(env.pulses)
        outcomes.append(count)
        # Edge 0 is `before` cycles before the pin changes. The C-event follows edge 0 by 2 to 10 cycles; the
        # pin follows the pulse event by 2 cycles.
        if before >= 10 + 4 + 2:
            env.check("P104-FDC-06", f"pulses, {before} cycles before", count, 8)
        await env.result("P104-FDC-06", count, 0xC3, 200 - count - 1)
    env.check("P104-FDC-06", "one switch-over", outcomes, sorted(outcomes))
    env.check("P104-FDC-06", "both outcomes were met", set(outcomes), {8, 10})
