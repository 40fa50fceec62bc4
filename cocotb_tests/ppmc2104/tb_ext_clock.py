"""Fast external clocks, compared with the formula, and the threshold of their period (P2104-BCK-04,
P2104-TIM-05).
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import F8, F16, F48, directed
from cocotb_tests.harness.checks import BRISK, TOO_MANY, ExtMoves, Move, shortest_levels, sweep

from .env import Env

# Like INIT_A, but with the external base clock EXTCK.
EXTERNAL = (0x0A, 9, 4, 4)


@directed(
    "P2104-BCK-04", "P2104-TIM-05", "P2104-FDC-01", "P2104-BAD-19", builds=(F16, F8), uncompared=TOO_MANY
)
async def p2104_bck_04_sweep(dut: Any) -> None:
    """With edges 4 to 17 cycles apart, RH 0 to 4, and any deceleration point, pulses follow the formula
    (P2104-BCK-04).
    """
    env = await Env.start(dut)
    rng = env.bench.rng
    axes = await env.both(EXTERNAL)
    tries = [await ExtMoves.of(axis, EXTERNAL[1:], axis.pin("fhl_n")) for axis in axes]
    for rh in range(5):
        ramp = (rng.randint(rh + 2, 40), rh, rng.randint(4, 6))
        moves = tries[rh % 2]
        await moves.axis.init(EXTERNAL[0], *ramp)
        for move in sweep(ramp, rng):
            await moves.check(move)


@directed("P2104-TIM-05", builds=(F16, F8, F48))
async def p2104_tim_05_brisk_threshold(dut: Any) -> None:
    """At rate 0, the high time of the clock limits the low time only for periods below CYC(128)
    (P2104-TIM-05).

    The test uses periods of CYC(128) - 1, CYC(128) and CYC(128) + 1 cycles.
    """
    env = await Env.start(dut)
    brisk = env.cfg.cyc(BRISK)
    for axis in await env.both(EXTERNAL):
        moves = await ExtMoves.of(axis, EXTERNAL[1:], axis.pin("fhl_n"))
        for gaps in ((brisk - 1,), (brisk,), (brisk + 1,), (brisk - 1, brisk + 1, brisk, brisk - 1, brisk)):
            await moves.check(Move(9, gaps, 9, rate=0))
            await moves.check(Move(9, gaps, 9, rate=1))


@directed(
    "P2104-BCK-04",
    "P2104-TIM-05",
    builds=(F16, F48),
    exact="a level of one cycle may not be sampled",
)
async def p2104_bck_04_shortest_levels(dut: Any) -> None:
    """With a clock that is sampled high or low for 1, 2 or 3 cycles, pulses and low times follow the formula
    (P2104-BCK-04, P2104-TIM-05).
    """
    env = await Env.start(dut)
    for axis, ramp in zip(await env.both(EXTERNAL), ((40, 0, 6), (9, 0, 15)), strict=True):
        moves = await ExtMoves.of(axis, EXTERNAL[1:], axis.pin("fhl_n"))
        await axis.init(EXTERNAL[0], *ramp)
        for move in shortest_levels(ramp, env.bench.rng):
            await moves.check(move)
