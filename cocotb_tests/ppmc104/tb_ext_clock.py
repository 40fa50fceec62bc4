"""Fast external clocks, compared with the formula, and thresholds of their period (P104-BCK-05, -TIM-05,
-INT-03).
"""

from __future__ import annotations

from cocotb_tests.harness import F8, F16, F25, directed
from cocotb_tests.harness.axis_driver import differences
from cocotb_tests.harness.checks import (
    BRISK,
    TOO_MANY,
    ExtMoves,
    Move,
    check_delays,
    clock_delays,
    shortest_levels,
    sweep,
)

from .env import Env
from .expected_timing import INIT_A
from .tb_baseclock import EXTERNAL, carried


@directed(
    "P104-BCK-05",
    "P104-TIM-05",
    "P104-BAD-14",
    builds=(F16, F8),
)
async def p104_bck_05_first_deceleration_interval(dut):
    """With edges 8 cycles apart, the low time at the deceleration point is shortened, and the interval is
    exact (P104-BCK-05).
    """
    ramp = (255, 1, 4)
    env = await Env.start(dut, (0x1A, *ramp))
    moves = await ExtMoves.of(env, ramp, "l3_n")
    for n in range(2, 14):
        await moves.check(Move(n, (8,), 4, ramp))


@directed(
    "P104-BCK-05",
    "P104-TIM-05",
    "P104-INT-01",
    "P104-INT-05",
    "P104-FDC-02",
    "P104-BAD-14",
    builds=(F16, F8),
    uncompared=TOO_MANY,
)
async def p104_bck_05_sweep(dut):
    """With edges 4 to 17 cycles apart, RH 0 to 4, and any deceleration point, pulses follow the formula
    (P104-BCK-05).
    """
    env = await Env.start(dut, EXTERNAL)
    moves = await ExtMoves.of(env, INIT_A[1:], "l3_n")
    rng = env.bench.rng
    for rh in range(5):
        for ramp in ((rng.randint(rh, 40), rh, 4), (rh + rng.randint(0, 9), rh, rng.randint(5, 9))):
            await env.init(0x1A, *ramp)
            for move in sweep(ramp, rng):
                await moves.check(move)


@directed("P104-TIM-05", builds=(F16, F8, F25))
async def p104_tim_05_brisk_threshold(dut):
    """At rate 0, the high time of the clock limits the low time only for periods below CYC(128)
    (P104-TIM-05).

    The test uses periods of CYC(128) - 1, CYC(128) and CYC(128) + 1 cycles.
    """
    env = await Env.start(dut, EXTERNAL)
    moves = await ExtMoves.of(env, INIT_A[1:], "l3_n")
    brisk = env.cfg.cyc(BRISK)
    for gaps in ((brisk - 1,), (brisk,), (brisk + 1,), (brisk - 1, brisk + 1, brisk, brisk - 1, brisk)):
        await moves.check(Move(9, gaps, 9, rate=0))
        await moves.check(Move(9, gaps, 9, rate=1))


@directed("P104-INT-03", builds=(F16, F8, F25))
async def p104_int_03_long_threshold(dut):
    """With vsel = L, the extra time is omitted only if the clock period exceeds H (P104-INT-03).

    The test uses periods of H - 1, H and H + 1 cycles, constant and mixed.
    """
    env = await Env.start(dut, EXTERNAL, vsel=0)
    h = (272 * env.cfg.clk_hz // env.cfg.xtal_hz + 1) // 2
    for gaps in ([h - 1] * 40, [h] * 40, [h + 1] * 40, [h, h + 1, h - 1, h] * 10):
        for rate in (0, 2):
            clock = env.bench.external_clock(gaps, high=9)
            await env.move(0x44, 6, rate)
            await clock
            edges = env.clock_edges(env.since)
            first = max(i for i, t in enumerate(edges) if t < env.pulses[0] - 1)
            expected = carried(env.cfg, edges, first, [rate] * 5)
            same = f"intervals at {gaps[:4]} cycles, rate {rate}"
            env.check("P104-INT-03", same, env.intervals, differences(expected))
            await env.bench.clocks(20)


@directed(
    "P104-BCK-04",
    "P104-TIM-05",
    builds=(F16, F8, F25),
    exact="a level of one cycle may not be sampled",
)
async def p104_bck_04_shortest_levels(dut):
    """With a clock that is sampled high or low for 1, 2 or 3 cycles, pulses and low times follow the formula
    (P104-BCK-04, P104-TIM-05).
    """
    env = await Env.start(dut, EXTERNAL)
    moves = await ExtMoves.of(env, INIT_A[1:], "l3_n")
    for ramp in ((40, 0, 6), (90, 0, 4), (9, 0, 15)):
        await env.init(0x1A, *ramp)
        for move in shortest_levels(ramp, env.bench.rng):
            await moves.check(move)


@directed("P104-PORT-02", "P104-BCK-04", "P104-END-02", builds=(F16, F25))
async def p104_port_02_delays(dut):
    """Limits, alarm and clock take effect with the same delay; with JITTER=1, also one cycle later
    (P104-PORT-02).
    """
    env = await Env.start(dut)
    ends = []
    for pin, code in (("l1_n", 0x45), ("l2_n", 0x4D), ("alm_n", 0x45), ("cnp_n", 0x47)) * 3:
        await env.go(code, rate=99)
        await env.pulse(1, env.cfg.w + 20)
        stamp = env.bench.set(**{pin: 0})
        ends.append(await env.wait_end() - stamp)
        env.bench.set(**{pin: 1})
        await env.finish()
    check_delays(env.bench, "P104-END-02", "from pin to int_n", ends, 2, 7)
    await env.init(*EXTERNAL)
    check_delays(env.bench, "P104-BCK-04", "from clock to pout_n", await clock_delays(env), 2, 4)
