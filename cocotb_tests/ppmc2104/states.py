"""Puts an axis into each state of P2104-FSM-01 and keeps it there.

For a state within a motion, the external clock is stopped, so that the state lasts as long as a test needs.
"""

from __future__ import annotations

from .env import Axis
from .expected_timing import INIT_EXT

# Number of the pulse with which the plateau begins: PA + 1, where PA is the ramp length of INIT_EXT.
PLATEAU = INIT_EXT[3] + 1
NATURAL = 8

# Columns of the table: the states with BUSY = 0, then those with BUSY = 1.
RESTING = ("INITIAL", "INITP", "NORMAL")
RAMP = ("START", "ACC", "HIGH")
STEADY = ("START constant", "CONST", "FIN", "FIN ramp")
MOVING = ("RUNWAIT", *RAMP, "DEC", "DEC natural", "START flagged", *STEADY)


async def enter(axis: Axis, state: str, ccw: int = 0) -> None:
    """Bring an axis without a setting into a state.

    INITP is the build of a long table. FIN lasts only for the low time of the last pulse.
    """
    if state == "INITIAL":
        return
    if state == "INITP":
        await axis.host.init(0x0A | axis.axis_bit, 255, 1, 4)
        return
    await axis.init(*INIT_EXT)
    code = 8 if ccw else 0
    if state == "RUNWAIT":
        axis.set(run=0)
        await axis.go(0x43 | code, 1000)
    elif state in ("START", "START flagged"):
        await axis.go(0x43 | code, 1000)
        if state == "START flagged":
            await axis.command(0x41)
    elif state == "ACC":
        await axis.go(0x43 | code, 1000)
        await axis.tick_until(2)
    elif state in ("HIGH", "DEC"):
        await axis.go(0x43 | code, 1000)
        await axis.tick_until(PLATEAU)
        if state == "DEC":
            await axis.command(0x41)
    elif state == "DEC natural":
        await axis.go(0x43 | code, NATURAL)
        await axis.tick_until(5)
    elif state in ("START constant", "CONST"):
        await axis.go(0x44 | code, 1000, 1)
        if state == "CONST":
            await axis.tick_until(2)
    elif state == "FIN":
        await axis.go(0x42 | code)
        await axis.pulse(1, 2)
    elif state == "FIN ramp":
        await axis.go(0x43 | code, 1)
        while not axis.pulses:
            await axis.ticks(1, 8)


async def leave(axis: Axis) -> None:
    """Return from any state to the state after reset; clear errors and interrupts."""
    host = axis.host
    await axis.command(0x40)
    await axis.idle()
    axis.set(run=1)
    await axis.ready()
    await axis.command(0xC0)
    await axis.finish()
    for code in (0x86, 0xA6):
        await host.fetch(code)
