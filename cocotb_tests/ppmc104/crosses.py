"""Coverage crosses of the manual: operation, cause, phase and clock; error and state.

They are counted in the golden model.
"""

from __future__ import annotations

from cocotb_tests.harness.crosses import ERRORS, MOTION, Count, Crosses, hook_errors, hook_motion


def _hook(count: Count) -> None:
    hook_motion(count)
    hook_errors(count)


CROSSES = Crosses((*MOTION, ERRORS), _hook)
