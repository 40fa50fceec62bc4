"""Ramps and forced deceleration (P2104-RMP, P2104-PRO, P2104-FDC).

I(j) is the interval that follows pulse j.
"""

from __future__ import annotations

from itertools import product
from typing import Any

from cocotb_tests.harness import F11, F16, F48, directed
from cocotb_tests.harness.axis_driver import indices, rate, rates
from cocotb_tests.harness.checks import check_intervals

from .env import Axis, Env
from .expected_timing import INIT_A, INIT_B, slowed

RAMPS = (
    (9, 4, 4),
    (3, 1, 25),
    (14, 12, 16),
    (40, 1, 7),
    (2, 0, 5),
    (60, 58, 30),
    (21, 2, 40),
    (5, 3, 100),
)


def thresholds(rl: int, rh: int, pa: int) -> dict[int, int]:
    """Return thr(r) of P2104-RMP-02."""
    a, b = (rl + 1) ** 2, (rh + 1) ** 2
    return {
        r: pa * b * (4 * a - (2 * r + 1) ** 2) // ((a - b) * (2 * r + 1) ** 2) + 1
        for r in range(rh + 1, rl + 1)
    }


@directed("P2104-RMP-01", "P2104-RMP-02", "P2104-RMP-03", "P2104-RMP-05", "P2104-EX-01", "P2104-EX-06")
async def p2104_rmp_01_every_index(dut: Any) -> None:
    """For ramps of many shapes, each rate of a move is exact according to the formula and to the thresholds
    (P2104-RMP-01, P2104-RMP-02).
    """
    env = await Env.start(dut)
    for number, ramp in enumerate(RAMPS):
        axis = env.axes[number & 1]
        rl, rh, pa = ramp
        which = indices(2 * pa + 5, pa)
        expected = rates(ramp, which)
        thr = thresholds(*ramp)
        table = [rh + sum(k < t for t in thr.values()) for k in which]
        env.check("P2104-RMP-02", f"both forms of {ramp}", expected, table)
        env.check(
            "P2104-RMP-02", "thresholds do not rise", [*thr.values()], sorted(thr.values(), reverse=True)
        )
        code = 0x0A if rh == 0 else 0x02
        await axis.command(0xC0)
        await axis.init(code, *ramp)
        await axis.go(0x43, 2 * pa + 5)
        if rh == 0:
            await axis.tick_until(2 * pa + 5)
            edges = axis.clock_edges(axis.since)
            got = [
                sum(a < e <= b for e in edges) - 1 for a, b in zip(axis.pulses, axis.pulses[1:], strict=False)
            ]
            env.check("P2104-RMP-01", f"rates of {ramp}", got, expected)
        else:
            await axis.idle()
            axis.check_train("P2104-RMP-01", expected)
        await axis.finish()


@directed("P2104-RMP-01", "P2104-RMP-02", "P2104-EX-15", "P2104-RMP-04")
async def p2104_rmp_02_long_ramp_up(dut: Any) -> None:
    """For the largest ramp, the rates of the first 120 pulses are exact (P2104-RMP-01, P2104-EX-15)."""
    env = await Env.start(dut)
    axis = env.x2
    ramp = (255, 18, 11_220)
    await axis.init(0x02, *ramp)
    known = {0: 255, 1: 253, 2: 251, 10: 237, 100: 157, 1000: 61, 5000: 27, 11_219: 18}
    env.check("P2104-EX-15", "rates", {k: rate(*ramp, k) for k in known}, known)
    await axis.go(0x43, 30_000)
    await axis.pulse(121, 10)
    await axis.command(0x40)
    await axis.idle()
    axis.check_train("P2104-RMP-01", rates(ramp, range(120)))


@directed(
    "P2104-PRO-01", "P2104-PRO-02", "P2104-PRO-03", "P2104-PRO-06", "P2104-OPR-05", builds=(F16, F11, F48)
)
async def p2104_pro_01_every_length(dut: Any) -> None:
    """With PA = 4 and N = 1 to 14, profiles are triangular with odd and even counts, and trapezoidal from 2
    PA + 2 on (P2104-PRO-01).
    """
    env = await Env.start(dut)
    for axis in await env.both(INIT_A):
        for n in range(1, 15):
            await axis.move(0x43 if n & 1 else 0xC3, n)
            expected = rates(INIT_A[1:], indices(n, 4))
            axis.check_train("P2104-PRO-01", expected)
            env.check("P2104-PRO-06", f"intervals at RH, N = {n}", expected.count(4), max(0, n - 9))
            await axis.result("P2104-PRO-01", n, 0x83, 0)


async def start_and_decelerate(axis: Axis, how: str, n: int, j: int, plus: int, code: int) -> None:
    """Start a move of n pulses and request a deceleration `plus` cycles after pulse j."""
    await axis.go(code, n)
    await axis.pulse(j, plus)
    if how == "stop":
        await axis.command(0x41)
    else:
        await axis.blip(how, 3)


@directed(
    "P2104-FDC-01",
    "P2104-FDC-02",
    "P2104-FDC-03",
    "P2104-FDC-05",
    "P2104-PRO-04",
    "P2104-PRO-05",
    "P2104-OPR-09",
)
async def p2104_fdc_02_every_interval(dut: Any) -> None:
    """With N = 14 and 9, a deceleration request in each interval has the effect in the rules
    (P2104-FDC-02).
    """
    env = await Env.start(dut)
    for axis, (code, pin, n) in product(
        await env.both(INIT_A),
        ((0x43, "stop", 14), (0xCB, "bhl_n", 14), (0xC3, "fhl_n", 9), (0x4B, "stop", 9)),
    ):
        for j in range(1, n):
            await start_and_decelerate(axis, pin, n, j, 40, code)
            # Natural deceleration begins with the first interval whose index is lower than it would be while
            # accelerating.
            natural = indices(n, 4)[j - 1] < min(j - 1, 4)
            expected = rates(INIT_A[1:], indices(n, 4)) if natural else slowed(INIT_A[1:], n, j)
            if pin == "stop":
                await axis.idle()
                env.check("P2104-STP-03", f"error in I({j}) of {n}", await axis.error(), 8 if natural else 0)
            pulses = len(expected) + 1
            bits = 0 if pulses == n else 0x40 if pin == "stop" else 0x08
            await axis.result(f"P2104-FDC-03 I({j})", pulses, 0x83 | bits, max(n - pulses - 1, 0))
            axis.check_train("P2104-FDC-03", expected)


@directed("P2104-FDC-02", "P2104-EX-06", "P2104-FDC-03", "P2104-END-02")
async def p2104_fdc_02_flat_start(dut: Any) -> None:
    """In a ramp with four flat indices, a deceleration request ends the motion immediately while the rate is
    RL (P2104-FDC-02).
    """
    env = await Env.start(dut)
    ramp = (14, 12, 16)
    for axis, how in ((env.x1, "stop"), (env.x2, "fhl_n")):
        await axis.init(0x02, *ramp)
        bit = 0x40 if how == "stop" else 0x08
        for j in (1, 2, 3, 4, 5, 6, 17):
            await start_and_decelerate(axis, how, 60, j, 200, 0x43)
            expected = slowed(ramp, 60, j)
            env.check("P2104-FDC-02", "figures", len(expected) + 1, j if j <= 4 else 2 * j)
            await axis.result(f"P2104-FDC-02 I({j})", len(expected) + 1, 0x83 | bit, 60 - len(expected) - 2)
            axis.check_train("P2104-FDC-02", expected)
        # If the flat part is reached while decelerating, the deceleration flag is already set, so the
        # deceleration continues to its end.
        await start_and_decelerate(axis, how, 60, 6, 200, 0x43)
        await axis.pulse(10, 100)
        await axis.refused("P2104-STP-03", "41 on the way down", 8, 0x41)
        await axis.result("P2104-FDC-03", 12, 0x83 | bit, 47)


@directed("P2104-FDC-01", "P2104-FDC-04", "P2104-LIM-05", "P2104-FSM-03", "P2104-STP-02", "P2104-BAD-22")
async def p2104_fdc_04_before_pulse_1(dut: Any) -> None:
    """A deceleration request in START or RUN wait results in exactly one pulse (P2104-FDC-04)."""
    env = await Env.start(dut)
    for axis, code in product(await env.both(INIT_A), (0x43, 0x4B, 0xC3, 0x46, 0xCE)):
        pin = "bhl_n" if code & 8 else "fhl_n"
        n = 1000 if code & 7 == 3 else None
        left = (n or 1 << 24) - 2
        # The stop is requested in START, which lasts 5 us.
        await axis.go(code, n)
        await axis.command(0x41)
        await axis.command(0x41)
        env.check("P2104-FSM-03", "a second 41", await axis.error(), 8)
        await axis.result("P2104-FDC-04", 1, 0xC0 | code & 7, left)
        # The slow-down limit requests the deceleration in RUN wait or in START; it is active three times.
        for waiting in (False, True):
            axis.set(run=0 if waiting else 1)
            await axis.go(code, n, poll=False)
            await env.bench.clocks(10)
            for _ in range(3):
                await axis.blip(pin, 2)
                await env.bench.clocks(5)
            if waiting:
                env.check("P2104-FSM-03", "41 in RUN wait", await axis.command(0x41) & 0x80, 0x80)
                await axis.error()
                axis.set(run=1)
            await axis.result("P2104-FDC-04", 1, 0x88 | code & 7, left)


@directed("P2104-FDC-06", "P2104-LIM-09", "P2104-FDC-01", "P2104-GEN-07", builds=(F16, F11))
async def p2104_fdc_06_around_a_pulse(dut: Any) -> None:
    """If FHL falls at least 4 cycles before a pulse event, the deceleration begins with this event
    (P2104-FDC-06).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    counts = []
    due = env.cfg.quanta(8 * 42)
    for before in range(9, -7, -1):
        await axis.go(0x43, 1000)
        # I(3) has index 2, rate 41, far from the plateau.
        third = await axis.pulse(3)
        offset = env.cfg.quanta(8 * (100 + 54 + 42)) - env.cfg.quanta(8 * (100 + 54))
        await env.bench.until(third + offset - before)
        await axis.blip("fhl_n", 3)
        await axis.idle()
        count = len(axis.pulses)
        counts.append(count)
        env.check("P2104-FDC-06", f"{before} cycles before", count in (6, 8), True)
        if before >= 4:
            env.check("P2104-FDC-06", f"pulses, {before} cycles before", count, 6)
        await axis.result("P2104-FDC-06", count, 0x8B, 999 - count)
    env.check("P2104-LIM-09", "one switch-over", counts, sorted(counts))
    env.check("P2104-LIM-09", "both results occurred", set(counts), {6, 8})
    env.window("P2104-FDC-06", "interval of rate 41 in cycles", due, 900, 1_400)


@directed(
    "P2104-LIM-09", "P2104-END-04", "P2104-FDC-01", exact="the switches must be sampled at the same edge"
)
async def p2104_lim_09_two_requests_on_one_edge(dut: Any) -> None:
    """If code 41 and FHL occur some cycles apart, only the first sets its bit; on the same edge, both bits
    are set (P2104-LIM-09).
    """
    env = await Env.start(dut)
    axis = await env.ready(2, INIT_B)
    kinds = []
    for shift in range(-4, 14):
        await axis.go(0x43, 200)
        base = await axis.pulse(4) + 60
        task = axis.at(base + shift, fhl_n=0)
        await env.bench.until(base - 2)
        await env.host.write(1, 0x61)
        await env.bench.clocks(14)
        await task
        error = await axis.error()
        await axis.idle()
        axis.set(fhl_n=1)
        finish = await axis.finish()
        env.check("P2104-LIM-09", "pulses", len(axis.pulses), 8)
        kinds.append(finish)
        env.check("P2104-STP-03", f"error at {finish:#x}", error, 8 if finish == 0x8B else 0)
    order = [0x8B, 0xCB, 0xC3]
    env.check("P2104-LIM-09", "FHL first, both, 41 first", kinds, sorted(kinds, key=order.index))
    env.check(
        "P2104-LIM-09", "each was met, both on one edge", (set(kinds), kinds.count(0xCB)), (set(order), 1)
    )


@directed(
    "P2104-INTV-01",
    "P2104-OPR-10",
    "P2104-BCK-05",
    "P2104-EX-14",
    builds=(F16, F11),
)
async def p2104_intv_01_both_at_full_speed(dut: Any) -> None:
    """Pulses of both axes are exact at 250 kpps with the internal clock and at 500 kpps with EXTCK
    (P2104-INTV-01).
    """
    env = await Env.start(dut)
    fast = (0x02, 40, 1, 25)
    first, second = await env.both(fast)
    env.bench.set(run=0)
    await first.go(0x43, 300)
    await second.go(0x44, 250, 1)
    env.bench.set(run=3)
    await first.idle()
    await second.idle()
    first.check_train("P2104-INTV-01", rates(fast[1:], indices(300, 25)))
    second.check_train("P2104-INTV-01", [1] * 249)
    for axis in env.axes:
        await axis.command(0xC0)
        await axis.init(0x0A, 3, 0, 4)
        await axis.go(0x44, 200, 0)
    for _ in range(220):
        env.bench.set(extck=3)
        await env.bench.clocks(16)
        env.bench.set(extck=0)
        await env.bench.clocks(16)
    for axis in env.axes:
        await axis.idle()
        # Pulse 1 has its full width, because the clock was stopped before it, so that no period is known yet
        # (P2104-TIM-05).
        check_intervals(axis.bench, "P2104-INTV-01", axis.intervals[1:], [32] * 198)
