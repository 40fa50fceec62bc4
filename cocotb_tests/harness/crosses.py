"""Coverage crosses: combinations of states and causes, counted in golden models on request."""

from __future__ import annotations

import functools
import json
import os
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from openppmc import parts
from openppmc.model.motion import codes
from openppmc.model.motion.motion import Motion
from openppmc.model.single.codes import Error
from openppmc.model.single.commands import ByteUnit

from .variants import COVERAGE

SUFFIX = ".crosses"
_counts: Counter[tuple[str, ...]] = Counter()
_hooked: set[str] = set()


@dataclass(frozen=True)
class Cross:
    """Table of the combinations of two properties of an event.

    `rows` and `columns` contain all values of the data sheet, under the names that are counted.

    Attributes:
        never: (row, column) -> reason why the combination cannot occur; "*" represents every row or every
            column.
    """

    name: str
    rows: Sequence[str]
    columns: Sequence[str]
    never: Mapping[tuple[str, str], str] = field(default_factory=dict)

    def why_never(self, row: str, column: str) -> str:
        """Return why a combination cannot occur; "" if it can."""
        places = ((row, column), (row, "*"), ("*", column))
        return next((self.never[place] for place in places if place in self.never), "")


@dataclass(frozen=True)
class Crosses:
    """Coverage crosses of a device. `hook(count)` makes its golden model call count(cross, row, column)."""

    tables: Sequence[Cross]
    hook: Callable[[Callable[[str, str, str], None]], None]


def watch(part: str) -> None:
    """If coverage is requested, count from now on in each golden model of a device that has crosses."""
    if os.environ.get(COVERAGE) and part not in _hooked and parts.part(part).crosses:
        _hooked.add(part)
        found: Crosses = parts.part(part).load("crosses")
        found.hook(lambda cross, row, column: _counts.update([(part, cross, row, column)]))


def before(owner: type, method: str, observe: Callable[..., None]) -> None:
    """Call `observe(model, *arguments)` before each call of `method` of the golden model `owner`."""
    original: Any = getattr(owner, method)

    @functools.wraps(original)
    def observed(self: Any, *arguments: Any) -> Any:
        observe(self, *arguments)
        return original(self, *arguments)

    setattr(owner, method, observed)


def after(owner: type, method: str, observe: Callable[..., None]) -> None:
    """Call `observe(model, result, *arguments)` after each call of `method` of the golden model `owner`."""
    original: Any = getattr(owner, method)

    @functools.wraps(original)
    def observed(self: Any, *arguments: Any) -> Any:
        result = original(self, *arguments)
        observe(self, result, *arguments)
        return result

    setattr(owner, method, observed)


def leave() -> None:
    """Append the counts since the last call to a file."""
    where = os.environ.get(COVERAGE)
    if where and _counts:
        Path(where).mkdir(parents=True, exist_ok=True)
        rows = [[*key, number] for key, number in _counts.items()]
        with open(Path(where) / f"{os.getpid()}{SUFFIX}", "a", encoding="utf-8") as file:
            file.write(json.dumps(rows) + "\n")
        _counts.clear()


Count = Callable[[str, str, str], None]

OPERATIONS = {
    codes.SINGLE_STEP: "single step",
    codes.ACC_DEC: "ramp, counted",
    codes.CONSTANT: "constant, counted",
    codes.CONTINUOUS: "constant, endless",
    codes.HIGH_SPEED: "ramp, endless",
    codes.ORIGIN: "origin search",
}
CAUSES = {
    codes.FINISH_STOP: "stop command",
    codes.FINISH_ALARM: "alarm",
    codes.FINISH_LIMIT: "limit",
    codes.FINISH_SLOW: "slow-down limit",
}
COUNT_DONE, ORIGIN_FOUND, TWO = "all pulses output", "origin", "two causes"
FIRST, UP, TOP, DOWN, CONSTANT = PHASES = (
    *("before the first pulse", "accelerating", "high speed", "decelerating", "constant speed"),
)
CLOCKS = (
    *("internal, extra time", "internal, no extra time"),
    *("external, extra time", "external, no extra time"),
)
STATES = ("before initialisation", "at standstill", "in motion", "decelerating")

ENDLESS = "an endless operation has no number of pulses to complete"
NO_RAMP = "a slow-down limit has no effect in this operation"
ORIGIN = "only an origin search samples the origin"
ONE_PULSE = "a single step does not wait for the external clock"
NEVER_CAUSE = {
    **{(name, COUNT_DONE): ENDLESS for name in ("constant, endless", "ramp, endless", "origin search")},
    **{
        (name, "slow-down limit"): NO_RAMP
        for name in ("single step", "constant, counted", "constant, endless", "origin search")
    },
    **{(name, ORIGIN_FOUND): ORIGIN for name in OPERATIONS.values() if name != "origin search"},
}
NEVER_PHASE = {
    ("slow-down limit", CONSTANT): "a slow-down limit has no effect at constant speed",
    ("slow-down limit", DOWN): "a slow-down limit has no effect during a deceleration",
    **{(ORIGIN_FOUND, phase): "an origin search has no ramp" for phase in (UP, TOP, DOWN)},
}
NEVER_CLOCK = {("single step", clock): ONE_PULSE for clock in CLOCKS[2:]}
ALL_CAUSES = (COUNT_DONE, *CAUSES.values(), ORIGIN_FOUND, TWO)

MOTION = (
    Cross("operation and cause of its end", tuple(OPERATIONS.values()), ALL_CAUSES, NEVER_CAUSE),
    Cross("cause of the end and phase of the motion", ALL_CAUSES, PHASES, NEVER_PHASE),
    Cross("operation and base clock", tuple(OPERATIONS.values()), CLOCKS, NEVER_CLOCK),
    Cross("cause of the end and base clock", ALL_CAUSES, CLOCKS),
)


def without(crosses: Iterable[Cross], columns: Sequence[str], why: str) -> tuple[Cross, ...]:
    """Return these crosses, in which the `columns` cannot occur for the reason `why`."""
    never = {("*", column): why for column in columns}
    return tuple(
        replace(cross, never={**cross.never, **never}) if set(columns) <= set(cross.columns) else cross
        for cross in crosses
    )


NO_EXTRA_TIME = without(MOTION, CLOCKS[::2], "without vsel, intervals have no extra time")
UNINIT = "before initialisation"
BUSY_ONLY = "this error exists only during a motion"
REJECTED = "during a motion, an initialisation is rejected as NOT_WHILE_BUSY"
NEVER_ERROR = {
    **{("NOT_WHILE_BUSY", state): BUSY_ONLY for state in STATES[:2]},
    **{("NOT_INITIALISED", state): "this error exists only before initialisation" for state in STATES[1:]},
    **{("UNASKED_DATA", state): "during a motion, this is UNASKED_DATA_BUSY" for state in STATES[2:]},
    **{("UNASKED_DATA_BUSY", state): "at standstill, this is UNASKED_DATA" for state in STATES[:2]},
    **{(error, state): REJECTED for error in ("PA_TOO_LARGE", "BAD_RAMP") for state in STATES[2:]},
    **{("ALREADY_DECELERATING", state): BUSY_ONLY for state in STATES[:2]},
}
ERRORS = Cross("error and state", tuple(error.name for error in Error), STATES, NEVER_ERROR)


def phase(motion: Any) -> str:
    """Return the phase of an operation, such as acceleration or constant speed."""
    if not motion.done:
        return FIRST
    if not motion.is_ramp:
        return CONSTANT
    if motion.decelerating:
        return DOWN
    return TOP if motion.high else UP


def _clock(motion: Any) -> str:
    name = "external" if motion._external is not None else "internal"
    return f"{name}, no extra time" if motion._plain else f"{name}, extra time"


def hook_motion(count: Count, own: Sequence[type] = ()) -> None:
    """Count the end of each operation of any axis.

    Args:
        own: classes of the device whose own method `_end_now` can end an operation, in addition to that of
            `Motion`.
    """
    came: dict[int, str] = {}

    def begin(motion: Any, t: int) -> None:
        came.pop(id(motion), None)

    def on_cause(motion: Any, t: int, bits: int) -> None:
        if motion.busy and not motion.finishing:
            came.setdefault(id(motion), phase(motion))

    def finish(motion: Any, t: int) -> None:
        left = motion._total - motion.done
        bits = motion._stop_bits | motion._flag_bits if left else 0
        found = [name for bit, name in CAUSES.items() if bits & bit]
        found = found or [ORIGIN_FOUND if left else COUNT_DONE]
        cause = found[0] if len(found) == 1 else TWO
        where = came.pop(id(motion), DOWN if motion.is_ramp else CONSTANT)
        operation, clock = OPERATIONS[motion.operation], _clock(motion)
        count(MOTION[0].name, operation, cause)
        count(MOTION[1].name, cause, where)
        count(MOTION[2].name, operation, clock)
        count(MOTION[3].name, cause, clock)

    before(Motion, "_begin", begin)
    for owner in (Motion, *own):
        before(owner, "_end_now", on_cause)
    before(Motion, "_flag", on_cause)
    before(Motion, "_finish", finish)


def hook_errors(count: Count) -> None:
    """Count each error of a byte, together with the state in which the device received the byte."""

    def on_read(unit: Any, result: Any, t: int, *rest: Any) -> None:
        if unit.error is not None:
            motion = unit._motion
            state = "in motion" if motion.busy else "at standstill" if unit.setup else UNINIT
            if motion.decelerating:
                state = "decelerating"
            count(ERRORS.name, unit.error.name, state)

    after(ByteUnit, "take", on_read)
