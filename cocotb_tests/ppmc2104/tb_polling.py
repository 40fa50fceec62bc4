"""The four examples of limit detection in the data sheet, with TIMING = "DATASHEET" (P2104-DS-20, -23)."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import D11, D16, directed

from .datasheet_timing import CONSTANT, REGULAR, SETTING, detection, last_byte, rest
from .env import Axis, Env
from .expected_timing import INIT_B

KPPS_10, KPPS_20 = 49, 24
"""Rates of the 500 kHz base clock."""
OFFSETS = (0, 9, 18, 27, 34)
"""Delays in us from a fixed moment to the fall of the limit; together they cover a polling cycle."""


async def limit(env: Env, axis: Axis, longest: int, own: int) -> int:
    """Hold the CW limit low until the operation ends; return the number of cycles from its fall to the end.

    Check that the operation ends within `longest` us (bound of the data sheet) and within `own` us (bound of
    P2104-DS-20).
    """
    us = env.cfg.us
    stamp = axis.set(fl_n=0)
    end = await env.bench.edge("int_n", 0, us(longest) + 100)
    env.window("P2104-DS-23", "limit to the end, data sheet", end - stamp, 2, us(longest) + 8)
    env.window("P2104-DS-20", "limit to the end", end - stamp, 2, us(own) + 40)
    env.check("P2104-DS-20", "BUSY", await env.host.status() & axis.busy, 0)
    axis.set(fl_n=1)
    return end - stamp


@directed("P2104-DS-20", "P2104-DS-23", "P2104-DS-01", builds=(D16,))
async def p2104_polling_example_1_initial_setting(dut: Any) -> None:
    """While the setting of the other axis is processed, an axis in RUN wait, which outputs no pulses, detects
    its limit within 71 035 us.
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    axis.set(run=0)
    await axis.go(0x45, rate=0xFF)
    await rest_of_window(env)
    await last_byte(env.x2, 0x02 | 0x20, *INIT_B[1:3], 0x0A, 0)
    took = await limit(env, axis, detection(SETTING, 0, 0), SETTING + REGULAR)
    # There is no polling tick while the setting is processed, so the detection needs nearly all of this time.
    env.window(
        "P2104-DS-20", "limit in the window", took, env.cfg.us(SETTING), env.cfg.us(SETTING + REGULAR) + 8
    )
    env.check("P2104-DS-20", "pulses", axis.pulses, [])
    env.check("P2104-DS-20", "end status", await axis.finish(), 0x95)


async def rest_of_window(env: Env) -> None:
    """Wait until the window of the last instruction is over."""
    await env.bench.clocks(env.cfg.us(150))


@cocotb.parametrize(offset=list(OFFSETS))
@directed("P2104-DS-20", "P2104-DS-23", builds=(D16, D11))
async def p2104_polling_example_2_one_axis_at_10_kpps(dut: Any, offset: int) -> None:
    """An axis that moves alone at constant 10 kpps detects its limit within 73 us, at any time of the polling
    cycle.
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x45, rate=KPPS_10)
    await axis.pulse(3, env.cfg.us(offset))
    await limit(env, axis, detection(0, CONSTANT, 0, 100), REGULAR)
    env.check("P2104-DS-20", "period", axis.pulses[2] - axis.pulses[1], env.cfg.us(100))
    env.check("P2104-DS-20", "end status", await axis.finish(), 0x95)


@cocotb.parametrize(offset=list(OFFSETS))
@directed("P2104-DS-20", "P2104-DS-23", builds=(D16, D11))
async def p2104_polling_example_3_both_axes_at_10_kpps(dut: Any, offset: int) -> None:
    """If both axes move at constant 10 kpps, each axis detects its limit within 187 us, and the other axis
    continues.
    """
    env = await Env.start(dut)
    for axis in await env.both(INIT_B):
        await axis.go(0x45, rate=KPPS_10)
        await axis.pulse(2)
    longest = detection(0, CONSTANT, CONSTANT, 100)
    for axis, other in (env.axes, env.axes[::-1]):
        if axis is env.x2:
            await other.finish()
            await rest_of_window(env)
        await env.bench.clocks(env.cfg.us(offset))
        await limit(env, axis, longest, REGULAR)
        if axis is env.x1:
            env.check("P2104-DS-20", "other axis", await env.host.status() & other.busy, other.busy)
    await rest(env)


@directed("P2104-DS-20", "P2104-DS-23", "P2104-DS-01", builds=(D16,))
async def p2104_polling_example_4_setting_during_20_kpps(dut: Any) -> None:
    """While the setting of the other axis is processed, an axis that moves at 20 kpps detects its limit
    within 295 995 us.
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x45, rate=KPPS_20)
    await axis.pulse(3)
    await last_byte(env.x2, 0x02 | 0x20, *INIT_B[1:3], 0x0A, 0)
    took = await limit(env, axis, detection(SETTING, CONSTANT, 0, 50), SETTING + REGULAR)
    env.window("P2104-DS-20", "pulses", len(axis.pulses), took // env.cfg.us(50), took // env.cfg.us(50) + 6)
    env.check("P2104-DS-20", "end status", await axis.finish(), 0x95)
