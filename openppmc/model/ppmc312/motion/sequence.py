"""Sequence of pulses and rates of the PPMC-312 with changes of speed: P312-MOT-20..33.

This module does not model time: `boundary` is called at the end of every interval, and once before pulse 1.
"""

from __future__ import annotations

from enum import Enum, auto
from typing import NamedTuple

from ..codes import Cause
from ..stages import Plan, Step

_DECELERATING = (Cause.SLOW, Cause.LIMIT_SLOW)
_ORDER = (Cause.LIMIT_SLOW, Cause.SLOW, Cause.RETURN)


class Change(NamedTuple):
    """A change of speed: target rate, with a ramp (instruction 87) or immediately (instruction 88)."""

    rate: int
    ramp: bool


class _Mode(Enum):
    PLAN = auto()
    CONSTANT = auto()
    RAMP = auto()
    DECEL = auto()
    FINAL = auto()


class Sequence:
    """Pulses of an operation.

    Attributes:
        done: number of pulses that were output.
        running: current pulse and interval, `None` before pulse 1.
        decel_begins: True if a requested deceleration began at the last boundary.
        change_dropped: True if the last boundary discarded a waiting instruction 87.
        was_searched: True if the constant rate at the last boundary had been that of a stage, so that a
            search for t(x), the stage of this rate (`stages.Table.stage`), was required.
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.done = 0
        self.running: Step | None = None
        self._mode = _Mode.PLAN
        self._stages: list[list[int]] = []
        self._rate = plan.rate
        self._decel_cause = Cause.SLOW
        self._requests: set[Cause] = set()
        self._limit = False
        self.decel_begins = self.change_dropped = self.was_searched = False
        self._change: Change | None = None
        self._change_waits = self._changed = self._from_stage = False

    @property
    def complete(self) -> bool:
        """True after the last pulse, number N."""
        return self.done == self.plan.n

    @property
    def in_table(self) -> bool:
        """State ACC: the running interval, or pulse 1 before its output, uses a rate of the table."""
        return self.present.stage is not None

    @property
    def present(self) -> Step:
        """Current pulse with its interval; before pulse 1, pulse 1 with its interval."""
        return self.running or self.plan.step(1)

    # ------------------------------------------------------------------ requests

    def request(self, cause: Cause) -> None:
        """Request a deceleration for instruction 81, or at the origin of a zero return.

        Rules: P312-MOT-30, -43.
        """
        if self._mode is _Mode.DECEL:
            if self._decel_cause is Cause.RETURN and cause in _DECELERATING:
                self._decel_cause = cause
            return
        self._requests.add(cause)

    def limit_level(self, active: bool) -> None:
        """Set whether a high-speed limit forbids the current speed."""
        if active:
            self.request(Cause.LIMIT_SLOW)
        else:
            self._requests.discard(Cause.LIMIT_SLOW)
        self._limit = active

    def announce_change(self) -> None:
        """Record that an instruction 87 is waiting; it may take effect soon."""
        self._change_waits = True

    def change(self, change: Change) -> None:
        """Record an instruction 87 or 88 for the next boundary.

        The new instruction replaces an instruction that is waiting.
        """
        self._change = change
        self._change_waits = change.ramp

    def drop_change(self) -> None:
        """Discard a waiting change, because a newer one follows or changes are no longer possible."""
        self._change = None
        self._change_waits = False

    # ------------------------------------------------------------------ boundary

    def boundary(self, ramps: bool = True, found: bool = True) -> Step | Cause:
        """Return the next pulse with its interval, or the cause of the end.

        Cause.RETURN means that phase 1 of a zero return is over.

        Args:
            ramps: True if instruction 87 may take effect at this boundary.
            found: True if the search for t(x) has ended. The argument has no effect if no search was
                required.
        """
        self.decel_begins = self.change_dropped = False
        if self.complete:
            return Cause.NORMAL
        if self._mode is _Mode.DECEL and not self._stages_left():
            return self._decel_cause
        if found or not self.was_searched or not self._decel_from(self.present):
            causes = self._requests
            self._requests = {Cause.LIMIT_SLOW} if self._limit else set()
        else:
            causes = set()  # the first stage of the deceleration is not known yet
        if causes and self._mode is not _Mode.DECEL:
            end = self._decelerate(next(cause for cause in _ORDER if cause in causes))
            if end is not None:
                return end
        self._ramps = ramps
        self._apply_change()
        plan = self.plan
        if plan.n is not None and plan.n - self.done == plan.down and self._mode is not _Mode.DECEL:
            if self._change_waits:
                # The change could only accelerate the remaining pulses, so it is discarded.
                self.drop_change()
                self.change_dropped = self._changed = True
            if self._changed:
                self._begin_final()
        self.running = self._next()
        self.done += 1
        self.was_searched = self._mode is _Mode.FINAL and self._from_stage and self.running.stage is None
        return self.running

    def _decel_from(self, step: Step) -> list[list[int]]:
        """Return the stages of a deceleration that begins at a step, with their pulses (P312-MOT-20).

        The list is empty if no deceleration is required.
        """
        table = self.plan.table
        top = table.stage(step.rate) if step.stage is None else step.stage
        if step.rate >= table.rates[table.sd] or top < table.sd:
            return []
        return [[i, table.pd[i]] for i in range(top, table.sd - 1, -1)]

    def _decelerate(self, request: Cause) -> Cause | None:
        decel = self._decel_from(self.present)
        if self.running is None or not decel:
            return Cause.RETURN if request is Cause.RETURN else Cause.LOW
        if not self.running.planned:
            self._mode, self._stages, self._decel_cause = _Mode.DECEL, decel, request
            self.drop_change()
            self.decel_begins = True
        return None

    def _apply_change(self) -> None:
        """Apply a waiting instruction 87 or 88. Instruction 87 waits until the speed is constant."""
        change = self._change
        if change is None or (change.ramp and not self._ramps):
            return
        if change.ramp and self.running is not None and self.running.stage is not None:
            return
        self.drop_change()
        self._changed = True
        self._rate = change.rate
        if not change.ramp:
            self._mode = _Mode.CONSTANT
            return
        table, now = self.plan.table, self.present.rate
        if change.rate < now:
            stages = range(max(table.sa, table.stage(now) + 1), table.stage(change.rate) + 1)
            pulses = table.pa
        elif change.rate > now:
            last = max(table.sd, table.stage(change.rate + 1) + 1)
            stages = range(table.stage(now + 1), last - 1, -1)
            pulses = table.pd
        else:
            stages, pulses = range(0), table.pa
        self._mode = _Mode.RAMP
        self._stages = [[i, pulses[i]] for i in stages if pulses[i]]

    def _begin_final(self) -> None:
        """Begin the final deceleration after a change (P312-MOT-33)."""
        table = self.plan.table
        start = Step(self._rate) if self._mode is _Mode.CONSTANT else self.present
        self._stages = self._decel_from(start)
        self._rate = table.rates[table.sd] if self._stages else start.rate
        self._from_stage = bool(self._stages) or start.stage is not None
        self._mode = _Mode.FINAL

    def _stages_left(self) -> bool:
        while self._stages and not self._stages[0][1]:
            self._stages.pop(0)
        return bool(self._stages)

    def _next(self) -> Step:
        if self._mode is _Mode.PLAN:
            return self.plan.step(self.done + 1)
        if self._mode is not _Mode.CONSTANT and self._stages_left():
            self._stages[0][1] -= 1
            stage = self._stages[0][0]
            return Step(self.plan.table.rates[stage], stage, self._mode is _Mode.FINAL)
        return Step(self._rate)
