"""Coverage crosses of the manual, counted in the golden model.

There are three crosses: operation with cause, phase and clock; error with state; and bus style with access.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness.crosses import NO_EXTRA_TIME, Count, Cross, Crosses, before, hook_motion
from openppmc.model.ppmc2104.codes import Error
from openppmc.model.ppmc2104.commands import CommandUnit
from openppmc.model.single.hostport import HostPort

INITIAL, BUILT, REST, MOVES, SLOWS = (
    *("before the first setting", "table being built", "at standstill", "in motion", "decelerating"),
)
STATES = (INITIAL, BUILT, REST, MOVES, SLOWS)
AT_START = "this error exists only at the start of an operation, at standstill with a complete table"
BUSY_ONLY = "this error exists only during a motion"
NEVER_ERROR = {
    **{("NOT_INITIALISED", state): "this error exists only before the first setting" for state in STATES[1:]},
    **{("NOT_WHILE_BUSY", state): BUSY_ONLY for state in (INITIAL, BUILT, REST)},
    **{("CANNOT_DECELERATE", state): BUSY_ONLY for state in (INITIAL, BUILT, REST)},
    ("NOTHING_TO_STOP", INITIAL): "before the first setting, a stop is NOT_INITIALISED",
    **{("NOTHING_TO_STOP", state): "during a motion, there is a motion to stop" for state in (MOVES, SLOWS)},
    **{
        (error, state): AT_START
        for error in ("START_REFUSED", "RATE_ONE_AXIS", "RATE_TWO_AXES")
        for state in (INITIAL, BUILT, MOVES, SLOWS)
    },
    **{
        (error, state): "a setting waits for a table, and is rejected as NOT_WHILE_BUSY during a motion"
        for error in ("BAD_RATE", "PA_TOO_LARGE")
        for state in (BUILT, MOVES, SLOWS)
    },
    **{
        ("BAD_SWITCHING", state): "during a motion, the instruction is rejected as NOT_WHILE_BUSY"
        for state in (MOVES, SLOWS)
    },
}
ERRORS = Cross(
    "error and state of its axis", tuple(error.name for error in Error if error), STATES, NEVER_ERROR
)
STYLES = ("busc L, at standstill", "busc L, in motion", "busc H, at standstill", "busc H, in motion")
ACCESSES = Cross(
    "access and bus style", ("instruction written", "data written", "status read", "data read"), STYLES
)


def _hook(count: Count) -> None:
    hook_motion(count)

    def charged(unit: Any, axis: int, error: Error) -> None:
        of = unit._axes[axis]
        rest = INITIAL if of.setup is None else BUILT if of.building else REST
        moves = SLOWS if of.motion.decelerating else MOVES
        count(ERRORS.name, error.name, moves if of.motion.busy else rest)

    def style(port: Any) -> str:
        moves = port._state() & 0x0C
        return STYLES[2 * port._pins["busc"] + bool(moves)]

    def written(port: Any, t: int, byte: int, command: bool) -> None:
        count(ACCESSES.name, "instruction written" if command else "data written", style(port))

    def read(port: Any, t: int) -> None:
        if port._reading:
            count(ACCESSES.name, "status read" if port._pins["a0"] else "data read", style(port))

    before(CommandUnit, "_report_error", charged)
    before(HostPort, "_store", written)
    before(HostPort, "_second_load", read)


CROSSES = Crosses((*NO_EXTRA_TIME, ERRORS, ACCESSES), _hook)
