"""Counts the events that random hosts cause in the golden model of the PPMC-312.

The counts reveal a loss of coverage. Each count has a text as its key, for example "pulses", "answer 82",
"event 83", "override 80", "answer F0 20", "event F8 01", "report E0 SLOW", "trigger POSITION 87", "decel
SLOW", "change 88", "change in RAMP", "cycles ABN".
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

from openppmc.model.ppmc312.codes import Answer, Cause, Source
from openppmc.model.ppmc312.front.responses import ENCODE, POSITION, Responses
from openppmc.model.ppmc312.instructions.overrides import Fifo, Triggered
from openppmc.model.ppmc312.motion.motion import MotionRequest
from openppmc.model.ppmc312.motion.operation import Operation
from openppmc.model.ppmc312.motion.sequence import Sequence, _Mode
from openppmc.model.ppmc312.part import Ppmc312

SLICE = 500
"""Number of cycles between two samples of the state."""

LEAST: dict[str, int] = {
    "pulses": 5_000,
    "pulses in table": 1_200,
    "equal neighbours in table": 200,
    "computed stages of 2": 60,
    "searched pulses": 20,
    "87 dropped at the point": 1,
    "start finite table": 80,
    "start endless table": 35,
    "start constant": 50,
    "change 87": 20,
    "change 88": 40,
    "change in RAMP": 4,
    "change in DECEL": 1,
    "final": 9,
    "decel SLOW": 30,
    "decel LIMIT_SLOW": 1,
    "decel RETURN": 3,
    "phase 2": 6,
    "trigger POSITION 80": 2,
    "trigger POSITION 81": 4,
    "trigger POSITION 87": 6,
    "trigger POSITION 88": 5,
    "trigger EVT0": 10,
    "trigger EVT1": 5,
    "override 8": 25,
    "override F9": 10,
    "event 2": 10,
    "event 4": 15,
    "event 8": 8,
    "event F8": 20,
    "answer F0": 40,
    "answer F2": 1,
    "answer F7 00": 10,
    "answer F7 01": 4,
    "report E0 ALARM": 20,
    "report E0 LIMIT": 10,
    "report E0 LOW": 15,
    "report E0 NORMAL": 100,
    "report E0 ORIGIN": 2,
    "report E0 SLOW": 20,
    "report E0 STOP": 30,
    "report E1": 6,
    "report E2": 8,
    "report E3": 60,
    "report E4": 15,
    "report E9 00": 20,
    "report E9 01": 1,
    "report F4 00": 10,
    "report F4 01": 50,
    "report F4 02": 2,
    "report F4 03": 3,
}
"""Key prefix -> minimum number of such events in one third of the hosts of `make test`."""

_SOURCES = {Source.HOST: "answer", Source.EVENT: "event", Source.OVERRIDE: "override"}
_BY_PARAMETER = {Answer.PARAMETER, Answer.REGISTRATION, Answer.ALARM, Answer.INPUT_CHANGE}
_BY_PARAMETER |= {Answer.EVENT_FAILED, Answer.OVERRIDE_FAILED}


def name_of(block: bytes, source: Source | None) -> str:
    """Return the key under which a response block (bytes in logical order) is counted."""
    code = block[2]
    who = _SOURCES[source] if source else "report"
    if code == Answer.STATUS:
        return f"{who} F1 {block[3]}" if block[3] in (1, 2) and len(block) == 4 else f"{who} F1"
    if code == Answer.STOPPED:
        return f"{who} E0 {Cause(block[3]).name}"
    if code in _BY_PARAMETER:
        return f"{who} {code:02X} {block[3]:02X}"
    return f"{who} {code:02X}"


@contextmanager
def counting() -> Iterator[Counter[str]]:
    """Count the internal events of all models that run in this context."""
    counts: Counter[str] = Counter()
    post, change = Responses.post, Responses.input_change
    release, begin, run = Fifo._release, Operation._begin, Ppmc312.run_until
    boundary, phase_2, final = Sequence.boundary, Operation._start_phase_2, Sequence._begin_final

    def counted_post(self: Responses, t: int, kind: int, blocks: list[bytes], source: Any = None) -> bool:
        done = post(self, t, kind, blocks, source)
        if kind in (POSITION, ENCODE):
            counts["report E4" if kind == POSITION else "report E3"] += done
        else:
            counts[name_of(next(iter(blocks)), source)] += done
        return done

    def counted_input(self: Responses, t: int, data: int) -> None:
        full = len(self._stores[6]) > 1
        change(self, t, data)
        counts["report E9 01"] += full

    def counted_release(self: Fifo, t: int) -> Triggered:
        released = release(self, t)
        counts[f"trigger {released.entry.trigger.name} {released.entry.block[2]:02X}"] += 1
        return released

    def counted_begin(self: Operation, t: int, order: MotionRequest) -> None:
        counts["starts"] += 1
        plan = order.plan
        kind = "endless" if plan.n is None else "constant" if not (plan.up or plan.down) else "finite"
        counts[f"start {kind} {'table' if plan.up or plan.down else 'flat'}"] += 1
        begin(self, t, order)

    def counted_boundary(self: Sequence, ramps: bool = True, found: bool = True) -> Any:
        changed, mode = self._change, self._mode
        step = boundary(self, ramps, found)
        counts["87 dropped at the point"] += self.change_dropped
        counts["searched pulses"] += self.was_searched
        if self.decel_begins:
            counts[f"decel {self._decel_cause.name}"] += 1
        if changed is not None and self._change is None and not (self.decel_begins or self.change_dropped):
            counts["change 87" if changed.ramp else "change 88"] += 1
            if mode in (_Mode.DECEL, _Mode.RAMP, _Mode.FINAL) or (mode is _Mode.PLAN and self.done > 1):
                counts[f"change in {mode.name}"] += 1
        if isinstance(step, Cause):
            return step
        counts["pulses"] += 1
        counts["pulses in table"] += step.stage is not None
        if step.stage is not None:
            around = self.plan.table.rates[max(step.stage - 1, self.plan.table.first) : step.stage + 2]
            counts["equal neighbours in table"] += around.count(step.rate) > 1
            side = self.plan.table.pd if step.planned else self.plan.table.pa
            counts["computed stages of 2"] += self.plan.table.first == 0 and side[step.stage] == 2
        return step

    def counted_final(self: Sequence) -> None:
        final(self)
        counts["final ramp" if self._stages else "final flat"] += 1

    def counted_phase_2(self: Operation, t: int) -> None:
        counts["phase 2"] += 1
        phase_2(self, t)

    def counted_run(self: Ppmc312, t: int) -> None:
        while self.now < t:
            before = self.now
            run(self, min(t, before + SLICE))
            counts[f"cycles {self.state.name}"] += self.now - before

    with (
        patch.object(Responses, "post", counted_post),
        patch.object(Responses, "input_change", counted_input),
        patch.object(Fifo, "_release", counted_release),
        patch.object(Operation, "_begin", counted_begin),
        patch.object(Operation, "_start_phase_2", counted_phase_2),
        patch.object(Sequence, "boundary", counted_boundary),
        patch.object(Sequence, "_begin_final", counted_final),
        patch.object(Ppmc312, "run_until", counted_run),
    ):
        yield counts


def thin(counts: Counter[str]) -> dict[str, tuple[int, int]]:
    """Return event -> (number seen, number needed), for the events that are too rare."""
    seen = {kind: sum(n for key, n in counts.items() if key.startswith(kind)) for kind in LEAST}
    return {kind: (seen[kind], least) for kind, least in LEAST.items() if seen[kind] < least}
