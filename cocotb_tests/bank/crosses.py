"""Coverage crosses of the manual, counted in the golden model.

There are three crosses: operation with cause, phase and clock; error with state of the axis; GO with state of
the axis.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness.crosses import (
    CLOCKS,
    ERRORS,
    MOTION,
    UNINIT,
    Count,
    Cross,
    Crosses,
    before,
    hook_errors,
    hook_motion,
    without,
)
from openppmc.model.bank.axis import Axis
from openppmc.model.bank.motion import Motion

CLOCKED = without(MOTION, CLOCKS[2:], "a bank has no external base clock")
STATES = (UNINIT, "at standstill", "waiting for GO", "in motion", "decelerating")
GROUP = Cross("axis and its state at GO", ("member of the group", "other axis"), STATES)


def _hook(count: Count) -> None:
    hook_motion(count, [Motion])
    hook_errors(count)

    def on_go(axis: Any, t: int, go: int) -> None:
        motion = axis.motion
        rest = "at standstill" if axis.commands.initialised else UNINIT
        moves = "decelerating" if motion.decelerating else "in motion"
        state = "waiting for GO" if motion.waits_for_go else moves if motion.busy else rest
        count(GROUP.name, GROUP.rows[not motion.in_group], state)

    before(Axis, "go", on_go)


CROSSES = Crosses((*CLOCKED, ERRORS, GROUP), _hook)
