"""Puts the core into each state of the state table and holds it there by driving each external clock edge
separately.
"""

from __future__ import annotations

from .env import Env
from .expected_timing import INIT_EXT

# Number of the pulse with which the plateau begins: PA + 1, where PA is the ramp length of INIT_EXT.
PLATEAU = INIT_EXT[3] + 1

IDLE = ("UNINIT", "READY")
RAMP = ("START ramp", "ACC", "HIGH", "DEC", "DEC natural", "FIN ramp")
CONSTANT = ("START constant", "CONST", "FIN constant")
MOVING = (*RAMP, *CONSTANT)


async def fresh(env: Env) -> None:
    """Reset, then wait until the mailbox is open."""
    await env.bench.reset()
    await env.bench.clocks(6)


async def enter(env: Env, state: str, ramp_code: int = 0x43, constant_code: int = 0x44) -> None:
    """Reset and enter `state`. A state of a motion does not change until the test drives further clock edges.

    The state FIN lasts only W cycles, the last low time, so use it immediately. Raises KeyError for an
    unknown state.
    """
    await fresh(env)
    if state == "UNINIT":
        return
    await env.init(*INIT_EXT)
    if state == "READY":
        return
    if state in RAMP:
        pulses = {
            "START ramp": 0,
            "ACC": 2,
            "HIGH": PLATEAU,
            "DEC": PLATEAU,
            "DEC natural": 6,
            "FIN ramp": 0,
        }[state]
        count = {"FIN ramp": 1, "DEC natural": 8}.get(state, 1000)
        await env.go(ramp_code, None if ramp_code & 7 == 6 else count)
    else:
        pulses = {"START constant": 0, "CONST": 2, "FIN constant": 0}[state]
        rate = 0 if constant_code & 7 in (4, 5, 7) else None
        n = (1 if state.startswith("FIN") else 1000) if constant_code & 7 == 4 else None
        await env.go(constant_code, n, rate)
    await env.bench.clocks(env.cfg.w + 4)
    await env.tick_until(pulses)
    if state == "DEC":
        await env.host.command(0x41)
    if state.startswith("FIN"):
        await env.ticks(1)
        await env.bench.level_is("pout_n", 0)
