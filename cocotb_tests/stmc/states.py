"""Puts the core into each state of the accept/reject table (docs/stmc/README.md, States) and keeps it there.

A moving core stays in its state because `ext_clk` is stopped; the tests drive its edges one by one.
"""

from __future__ import annotations

from .env import Env

# With D1 = 3 and D2 = 1, gaps have few ticks: 3, 2, and 1 from gap 2 on.
SMALL = (0x1A, 3, 1, 4)
RESTING = ("U", "W from U", "I", "W from I")
RAMP = ("S", "S flagged", "A", "A top", "D", "D natural")
STEADY = ("S steady", "C", "S to limit", "S single")
MOVING = (*RAMP, *STEADY)


async def enter(env: Env, state: str) -> None:
    """Reset and enter `state`. Raises KeyError for an unknown state."""
    await env.reset()
    if state.endswith("U"):
        if state != "U":
            await env.host.command(0x1A)
        return
    await env.init(*SMALL)
    if state == "I":
        return
    if state == "W from I":
        await env.host.command(0x43)
        return
    code, n, divisor, steps = {
        "S": (0x43, 100, None, 0),
        "S flagged": (0x43, 100, None, 0),
        "A": (0x43, 100, None, 3),
        "A top": (0x43, 100, None, 8),
        "D": (0x43, 100, None, 6),
        "D natural": (0x43, 8, None, 6),
        "S steady": (0x44, 100, 1, 0),
        "C": (0x44, 100, 1, 3),
        "S to limit": (0x47, None, 1, 0),
        "S single": (0x42, None, None, 0),
    }[state]
    await env.go(code, n, divisor)
    if state == "S single":
        return
    await env.bench.clocks(env.cfg.cyc(80) + 8)
    await env.tick_until(steps)
    if state in ("D", "S flagged"):
        await env.host.command(0x41)


async def leave(env: Env) -> None:
    """Stop a motion, if one is running."""
    if env.bench.level("hold") == 0:
        await env.host.command(0x40)
        await env.idle()
