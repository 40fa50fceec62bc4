"""Coverage crosses of the manual, counted in the golden model.

There are two crosses: operation with cause, phase and clock; and error with state.
"""

from __future__ import annotations

from cocotb_tests.harness.crosses import ERRORS, MOTION, Count, Crosses, hook_errors, hook_motion


def _hook(count: Count) -> None:
    hook_motion(count)
    hook_errors(count)


CROSSES = Crosses((*MOTION, ERRORS), _hook)
