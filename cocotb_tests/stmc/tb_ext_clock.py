"""Fast step clocks, compared with the formula (STMC-CLK-04)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cocotb_tests.harness import F16, directed
from cocotb_tests.harness.checks import TOO_MANY, ExtMoves, check_delays, clock_delays, shortest_levels, sweep

from .env import Env
from .expected_timing import F8X20, Ramp, divisor


def rates(ramp: Ramp, which: Sequence[int]) -> list[int]:
    """Return the divisors of the ramp at these levels, minus 1; `ramp` is (D1 - 1, D2 - 1, PA)."""
    slow, fast, pa = ramp
    return [divisor((slow + 1, fast + 1, pa), v) - 1 for v in which]


@directed("STMC-CLK-02", "STMC-CLK-04", builds=(F16, F8X20), uncompared=TOO_MANY)
async def stmc_clk_04_sweep(dut: Any) -> None:
    """With edges 4 to 17 cycles apart, D2 1 to 5, and any deceleration point, gaps are exact
    (STMC-CLK-04).
    """
    env = await Env.start(dut, None, clock=0)
    rng = env.bench.rng
    await env.init(0x1A, 10, 5, 4)
    moves = await ExtMoves.of(env, (9, 4, 4), "l3_n", lows=False, rate_of=rates)
    for fast in range(5):
        for ramp in (
            (rng.randint(fast + 1, 40), fast, 4),
            (fast + rng.randint(1, 9), fast, rng.randint(1, 9)),
        ):
            await env.init(0x1A, ramp[0] + 1, fast + 1, ramp[2])
            for move in sweep(ramp, rng, rates):
                await moves.check(move)


@directed("STMC-CLK-02", "STMC-CLK-03")
async def stmc_clk_02_shortest_levels(dut: Any) -> None:
    """With a clock that is sampled high or low for 1, 2 or 3 cycles, gaps are exact (STMC-CLK-02)."""
    env = await Env.start(dut, None, clock=0)
    ramp = (40, 0, 6)
    await env.init(0x1A, 10, 5, 4)
    moves = await ExtMoves.of(env, (9, 4, 4), "l3_n", lows=False, rate_of=rates)
    await env.init(0x1A, ramp[0] + 1, ramp[1] + 1, ramp[2])
    for move in shortest_levels(ramp, env.bench.rng):
        if move.rate is None:
            await moves.check(move)


@directed("STMC-CLK-03", "STMC-IN-01", "STMC-IN-02", builds=(F16, F8X20))
async def stmc_clk_03_delays(dut: Any) -> None:
    """Limits, MON and the step clock take effect with the same delay; with JITTER=1, also one cycle later
    (STMC-CLK-03, STMC-IN-02).
    """
    env = await Env.start(dut)
    ends = []
    for pin, code in (("l1_n", 0x45), ("l2_n", 0x4D), ("mon", 0x45), ("cnp_n", 0x47)) * 3:
        await env.go(code, rate=99)
        await env.pulse(1, 20)
        stamp = env.bench.set(**{pin: 0})
        ends.append(await env.wait_end() - stamp)
        env.bench.set(**{pin: 1})
        await env.finish()
    check_delays(env.bench, "STMC-IN-02", "from pin to int_n", ends, 2, 7)
    env = await Env.start(dut, clock=0)
    # The first step does not follow a tick.
    delays = (await clock_delays(env, rate=1))[1:]
    check_delays(env.bench, "STMC-CLK-03", "from ext_clk to s", delays, 2, 7)
