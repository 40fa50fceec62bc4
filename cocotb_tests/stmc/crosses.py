"""Coverage crosses of the manual, counted in the golden model.

There are two crosses: operation with cause, phase and clock; and error with state.
"""

from __future__ import annotations

from dataclasses import replace

from cocotb_tests.harness.crosses import ERRORS, NO_EXTRA_TIME, Count, Crosses, hook_errors, hook_motion

NO_LIMIT = {("PA_TOO_LARGE", "*"): "every PA is legal"}


def _hook(count: Count) -> None:
    hook_motion(count)
    hook_errors(count)


CROSSES = Crosses((*NO_EXTRA_TIME, replace(ERRORS, never={**ERRORS.never, **NO_LIMIT})), _hook)
