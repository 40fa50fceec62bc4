"""What the sheet crosses: instruction and state, cause of the end and state. Counted in the golden model."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness.crosses import Cross, Crosses, before
from cocotb_tests.harness.family_crosses import Count
from openppmc.model.ppmc312.codes import Cause, State
from openppmc.model.ppmc312.motion.operation import Operation

STATES = ("at rest", State.ACC.name, State.FIX.name, State.WRN.name)
CAUSES = Cross(
    "cause of the end and state that it is reported in", tuple(cause.name for cause in Cause), STATES
)


def _hook(count: Count) -> None:
    def reported(operation: Any, t: int, cause: Cause) -> None:
        state = operation.state
        count(CAUSES.name, cause.name, state.name if state else "at rest")

    before(Operation, "_report", reported)


CROSSES = Crosses((CAUSES,), _hook)
