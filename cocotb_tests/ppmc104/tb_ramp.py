"""The ramp table and the profile (P104-RMP, P104-PRO, P104-EX-01..03, P104-EX-07, P104-EX-11).

I(j) is the interval that follows pulse j.
"""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

from cocotb_tests.harness import F8, F16, F100, directed

from .env import Env
from .expected_timing import INIT_A, INIT_B, forced, indices, rate, rates


async def whole_ramp(env: Env, rule: str, ramp: tuple[int, int, int], code: int = 0xC3) -> None:
    """Run a trapezoidal profile with a short plateau, which uses the complete table, and check every
    pulse.
    """
    n = 2 * ramp[2] + 4
    await env.init(0x0A, *ramp)
    await env.move(code, n)
    env.check_train(rule, rates(ramp, indices(n, ramp[2])))


@directed("P104-RMP-01", "P104-RMP-02", builds=(F8, F16))
async def p104_rmp_01_corner_ramps(dut):
    """For ramps whose values are at their legal limits, every rate of the table is exact (P104-RMP-01)."""
    env = await Env.start(dut, None)
    for ramp in (
        (255, 0, 4),
        (255, 254, 5),
        (1, 0, 4),
        (0, 0, 4),
        (255, 255, 4),
        (100, 99, 30),
        (16, 0, 200),
    ):
        await whole_ramp(env, "P104-RMP-01", ramp)


@directed("P104-RMP-01", "P104-RMP-02", "P104-PRO-01")
async def p104_rmp_01_random_ramps(dut):
    """For random ramps, every rate of the table is exact (P104-RMP-01)."""
    env = await Env.start(dut, None)
    for _ in range(24):
        rl = env.bench.rng.choice((3, 9, 20, 41, 64, 90))
        rh = env.bench.rng.randrange(0, rl + 1)
        await whole_ramp(env, "P104-RMP-01", (rl, rh, env.bench.rng.randrange(4, 60)))


@directed("P104-RMP-01", "P104-RMP-04", "P104-RMP-05", "P104-PRO-02", builds=(F8,))
async def p104_rmp_04_longest_ramp(dut):
    """With RL 255, RH 0 and PA 11220, all 22444 pulses are exact, with the largest values in the computation
    (P104-RMP-04).
    """
    env = await Env.start(dut, None)
    ramp = (255, 0, 11220)
    await env.init(0x0A, *ramp)
    n = 2 * ramp[2] + 4
    await env.go(0xC3, n)
    await env.wait_end(4_000_000)
    env.check_train("P104-RMP-04", rates(ramp, indices(n, ramp[2])))


@directed("P104-RMP-02", "P104-RMP-05")
async def p104_rmp_02_thresholds(dut):
    """The first index of each rate in a move equals the index that the thresholds state (P104-RMP-02)."""
    env = await Env.start(dut, None)
    for rl, rh, pa in ((9, 4, 4), (90, 81, 40), (30, 2, 33), (12, 0, 77)):
        await env.init(0x0A, rl, rh, pa)
        await env.move(0xC3, 2 * pa + 3)
        seen = [clk // 32 - 1 for clk in env.intervals[: pa + 1]]
        a, b = (rl + 1) ** 2, (rh + 1) ** 2
        for r in range(rh + 1, rl + 1):
            threshold = pa * b * (4 * a - (2 * r + 1) ** 2) // ((a - b) * (2 * r + 1) ** 2) + 1
            first = next(k for k, got in enumerate(seen) if got < r)
            env.check("P104-RMP-02", f"first k with R(k) < {r} of {(rl, rh, pa)}", first, threshold)


def half_cases() -> list[tuple[int, int, int]]:
    """Return small ramps in which x(k) is exactly n + 1/2 for some k, so that the rounding is visible."""
    found = []
    for rl in range(2, 12):
        for rh in range(rl):
            for pa in range(4, 33):
                a, b = (rl + 1) ** 2, (rh + 1) ** 2
                for k in range(1, pa):
                    x2 = Fraction(a * b * pa, b * pa + (a - b) * k) * 4
                    root = isqrt(x2.numerator) if x2.denominator == 1 else 0
                    if root % 2 and root * root == x2:
                        found.append((rl, rh, pa))
                        break
    return found


@directed("P104-RMP-03", "P104-RMP-01")
async def p104_rmp_03_exact_halves(dut):
    """In ramps where x(k) is exactly n + 1/2, the half is rounded up (P104-RMP-03)."""
    env = await Env.start(dut, None)
    cases = half_cases()
    env.check("P104-RMP-03", "the example of the rule is among them", (4, 0, 8) in cases, True)
    for ramp in [(4, 0, 8), *cases[:: max(1, len(cases) // 20)]]:
        await whole_ramp(env, "P104-RMP-03", ramp)
    env.check("P104-RMP-03", "R(0..8)", [rate(4, 0, 8, k) for k in range(9)], [4, 2, 1, 1, 0, 0, 0, 0, 0])


@directed("P104-PRO-01", "P104-PRO-02", "P104-PRO-03", "P104-PRO-04", "P104-EX-02", builds=(F16, F100))
async def p104_pro_01_all_lengths(dut):
    """With a ramp of 6 pulses, the profiles for N = 1 to 24 are symmetric in both modes (P104-PRO-01)."""
    env = await Env.start(dut, (0x0A, 30, 3, 6))
    ramp = (30, 3, 6)
    for n in range(1, 25):
        for code in (0x43, 0xCB):
            await env.move(code, n)
            env.check_train("P104-PRO-01", rates(ramp, indices(n, 6)))
            await env.result("P104-PRO-01", n, 0x83, 0)


@directed("P104-PRO-02", "P104-PRO-03", "P104-EX-02")
async def p104_pro_03_shapes_in_full(dut):
    """With initialisation A, N = 2, 3, 6, 7, 9, 10, 11 result in the index lists that the rules print
    (P104-PRO-03).
    """
    env = await Env.start(dut, INIT_A)
    lists = {2: [0], 3: [0, 0], 6: [0, 1, 2, 1, 0], 7: [0, 1, 2, 2, 1, 0], 9: [0, 1, 2, 3, 3, 2, 1, 0]}
    lists |= {10: [0, 1, 2, 3, 4, 3, 2, 1, 0], 11: [0, 1, 2, 3, 4, 4, 3, 2, 1, 0]}
    by_index = [9, 7, 5, 5, 4]
    for n, which in lists.items():
        await env.move(0x43, n)
        env.check_train("P104-PRO-03", [by_index[k] for k in which])


@directed("P104-PRO-04", "P104-FDC-02", "P104-FDC-05")
async def p104_pro_04_forced_coincides_with_the_end(dut):
    """With N near the length of the mirrored ramp, either the index or the count ends a forced deceleration
    (P104-PRO-04).
    """
    env = await Env.start(dut, INIT_B)
    ramp = INIT_B[1:]
    for j in (3, 5, 8):
        short = forced(1000, 10, j)
        for n in range(len(short), len(short) + 4):
            await env.go(0x43, n)
            await env.pulse(j, 20)
            natural = indices(n, 10)
            in_dec = j < n and natural[j - 1] == n - 1 - j < min(j - 1, 10)
            status = await env.host.command(0x41)
            env.check("P104-STP-04", f"status, N = {n}, j = {j}", status, 0xF4 if in_dec else 0x04)
            count = min(n, len(short) + 1)
            which = natural if count == n else short
            await env.idle()
            env.check_train("P104-PRO-04", rates(ramp, which))
            complete = count == n
            await env.result(
                "P104-FDC-05", count, 0x83 if complete else 0xC3, 0 if complete else n - count - 1
            )


@directed("P104-PRO-05", "P104-STP-04")
async def p104_pro_05_natural_deceleration_begins(dut):
    """For several N, the first interval in which command 0x41 returns error 7 is the one that P104-PRO-05
    states; in all later intervals it returns the error, too.
    """
    env = await Env.start(dut, INIT_A)
    for n in (5, 8, 10, 12):
        running = indices(n, 4)
        for j in range(1, n):
            kp = running[j - 2] if j > 1 else -1
            decelerating = any(
                n - i - 1 < min((running[i - 2] if i > 1 else -1) + 1, 4) for i in range(1, j + 1)
            )
            env.check("P104-PRO-04", "index", running[j - 1], min(kp + 1, n - j - 1, 4))
            await env.go(0x43, n)
            await env.pulse(j, 20)
            got = await env.host.command(0x41)
            env.check("P104-PRO-05", f"0x41 in I({j}) of N = {n}", got, 0xF4 if decelerating else 0x04)
            await env.host.command(0x40)
            await env.idle()


@directed("P104-PRO-06", "P104-LIM-04")
async def p104_pro_06_high_exists_from_2pa_plus_2(dut):
    """In POUT mode with L3 low, L3 takes effect in a move of 2·PA+2 pulses, but not in a move of 2·PA+1
    (P104-PRO-06).
    """
    env = await Env.start(dut, INIT_A)
    env.bench.set(l3_n=0)
    await env.go(0xC3, 9)
    await env.result("P104-PRO-06", 9, 0x83, 0)
    for n in (10, 11, 12, 40):
        await env.go(0xC3, n)
        env.bench.set(l3_n=0)
        await env.idle()
        # The deceleration flag is set in the first plateau interval I(5): this results in 5 + 1 + 4 pulses,
        # the whole move for N = 10.
        complete = n == 10
        await env.result("P104-PRO-06", 10, 0x83 if complete else 0x8B, 0 if complete else n - 11)


@directed("P104-EX-01", "P104-EX-07", "P104-EX-11", "P104-INT-02")
async def p104_ex_07_worked_examples(dut):
    """In the examples with vsel = L and with RL = RH, the intervals are those that are printed
    (P104-EX-07).
    """
    env = await Env.start(dut, INIT_A, vsel=0)
    await env.move(0x43, 14)
    expected = [440, 376, 312, 312, 280, 280, 280, 280, 280, 312, 312, 376, 440]
    env.check("P104-EX-07", "intervals", env.intervals, expected)
    env.check("P104-EX-07", "total", sum(env.intervals), 4280)
    env.bench.set(vsel=1)
    await env.bench.clocks(4)
    await env.move(0x43, 14)
    env.check("P104-EX-01", "total", sum(env.intervals), 2720)
    await env.init(0x0A, 10, 10, 4)
    await env.move(0x43, 12)
    env.check("P104-EX-11", "intervals", env.intervals, [352] * 11)


@directed("P104-EX-03", builds=(F8,))
async def p104_ex_03_slow_base_clock(dut):
    """With csel = L, the intervals at the start of EX-03 are four times as long (P104-EX-03)."""
    env = await Env.start(dut, (0x0A, 199, 49, 100), csel=0)
    env.check(
        "P104-EX-03",
        "R(89..100)",
        rates((199, 49, 100), range(89, 101)),
        [52, 52, 51, 51, 51, *[50] * 4, 49, 49, 49],
    )
    await env.move(0x43, 28)
    env.check_train("P104-EX-03", rates((199, 49, 100), indices(28, 100)), csel=0)
    got = [clk * 2 for clk in env.intervals[:8]]
    env.check(
        "P104-EX-03",
        "first intervals",
        got,
        [4 * x for x in (6400, 5984, 5600, 5312, 5056, 4832, 4640, 4480)],
    )
