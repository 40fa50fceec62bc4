"""Puts the core into each state of the state table and keeps it there, by controlling each edge of an
external clock.
"""

from __future__ import annotations

from .env import Lab
from .expected_timing import INIT_EXT

# Ramp PA of INIT_EXT: interval I(PA + 1), the one after pulse PA + 1, is the first on the plateau.
PLATEAU = INIT_EXT[3] + 1

IDLE = ("UNINIT", "READY")
RAMP = ("START ramp", "ACC", "HIGH", "DEC", "DEC natural", "FIN ramp")
CONSTANT = ("START constant", "CONST", "FIN constant")
MOVING = (*RAMP, *CONSTANT)


async def fresh(lab: Lab) -> None:
    """Reset, then wait until the mailbox is open."""
    await lab.bench.reset()
    await lab.bench.clocks(6)


async def enter(lab: Lab, state: str, ramp_code: int = 0x43, constant_code: int = 0x44) -> None:
    """Reset and enter `state`; a moving state stays until more clock edges follow.

    FIN lasts only the W cycles of the last low time: use it immediately. Raises KeyError for an unknown
    state.
    """
    await fresh(lab)
    if state == "UNINIT":
        return
    await lab.init(*INIT_EXT)
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
        await lab.go(ramp_code, None if ramp_code & 7 == 6 else count)
    else:
        pulses = {"START constant": 0, "CONST": 2, "FIN constant": 0}[state]
        rate = 0 if constant_code & 7 in (4, 5, 7) else None
        n = (1 if state.startswith("FIN") else 1000) if constant_code & 7 == 4 else None
        await lab.go(constant_code, n, rate)
    await lab.bench.clocks(lab.cfg.w + 4)
    await lab.tick_until(pulses)
    if state == "DEC":
        await lab.host.command(0x41)
    if state.startswith("FIN"):
        await lab.ticks(1)
        await lab.bench.level_is("pout_n", 0)
