"""Coverage crosses of the data sheet, counted in the golden model.

There are three crosses: instruction × state, rejection × source of the instruction, and cause of the end ×
state.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness.crosses import Count, Cross, Crosses, after, before
from openppmc.model.ppmc312.codes import Answer, Cause, Code, Source, State
from openppmc.model.ppmc312.instructions.starts import CODE_LAST, CODE_MORE
from openppmc.model.ppmc312.instructions.unit import Unit
from openppmc.model.ppmc312.motion.motion import Motion
from openppmc.model.ppmc312.motion.operation import Operation

NONE = "an undefined code"
CODES = {code.value: f"{code:02X} {code.name}" for code in Code}
INSTRUCTIONS = Cross(
    "instruction and state at its execution", (*CODES.values(), NONE), tuple(state.name for state in State)
)
NEVER_REFUSED = {
    **{("F5 COMMAND", "OVERRIDE"): "the code was checked at the registration"},
    **{("F6 SIZE", source): "the size was checked at the registration" for source in ("EVENT", "OVERRIDE")},
    **{("F7 REGISTRATION", source): "only the host registers blocks" for source in ("EVENT", "OVERRIDE")},
}
REFUSALS = Cross(
    "rejection and source",
    tuple(
        f"{answer:02X} {answer.name}"
        for answer in Answer
        if 0xF0 <= answer <= 0xF7 and answer != Answer.ALARM
    ),
    tuple(source.name for source in Source),
    NEVER_REFUSED,
)
HELD, FIRST, ACC, FIX = ("held by RUN", "before the first pulse", State.ACC.name, State.FIX.name)
NEVER_ENDED = {
    **{
        (cause.name, HELD): "a motion that waits for RUN outputs no pulses, and 80 is rejected"
        for cause in Cause
        if cause is not Cause.ALARM
    },
    **{
        (cause.name, FIRST): "before the first pulse the cause is LOW"
        for cause in (Cause.SLOW, Cause.LIMIT_SLOW)
    },
    **{
        (cause.name, FIX): "a deceleration ramp has the state ACC" for cause in (Cause.SLOW, Cause.LIMIT_SLOW)
    },
    (Cause.NORMAL.name, FIRST): "every motion has at least one pulse",
}
CAUSES = Cross(
    "cause of the end and state of the motion",
    tuple(cause.name for cause in Cause),
    (HELD, FIRST, ACC, FIX),
    NEVER_ENDED,
)


def _where(motion: Any) -> str:
    if motion.sequence.running is None:
        return FIRST
    return ACC if motion.sequence.in_table else FIX


def _hook(count: Count) -> None:
    boundaries: dict[int, str] = {}

    def begun(unit: Any, t: int, job: Any) -> None:
        header, body = job.block[0], job.block[2:]
        if header in (CODE_MORE, CODE_LAST) and body and unit._core.transfer is None:
            count(INSTRUCTIONS.name, CODES.get(body[0], NONE), unit._core.state.name)

    def rejected(unit: Any, t: int, job: Any, rejection: Any) -> None:
        count(REFUSALS.name, f"{rejection.answer:02X} {rejection.answer.name}", job.source.name)

    def stopped(operation: Any, t: int, cause: Cause = Cause.STOP) -> None:
        if operation._waiting_for_run:
            count(CAUSES.name, cause.name, HELD)

    def boundary(motion: Any, t: int) -> None:
        if motion.active:
            boundaries[id(motion)] = _where(motion)

    def past(motion: Any, result: None, t: int) -> None:
        boundaries.pop(id(motion), None)

    def ended(motion: Any, t: int, cause: Cause) -> None:
        found = Cause.NORMAL if motion.sequence.complete else cause
        count(CAUSES.name, found.name, boundaries.get(id(motion)) or _where(motion))

    before(Unit, "_begin", begun)
    before(Unit, "_reject", rejected)
    before(Operation, "stop", stopped)
    before(Motion, "_pulse", boundary)
    after(Motion, "_pulse", past)
    before(Motion, "_end", ended)


CROSSES = Crosses((INSTRUCTIONS, REFUSALS, CAUSES), _hook)
