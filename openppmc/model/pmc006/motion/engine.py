"""Speed and steps of one motion of the PMC006B4, per update (P006-MOT-03, -22, -23, -30..-42).

This module contains only arithmetic, with times in us from t = 0; `motion` handles edges and events. Between
two updates, the speed is constant, so the steps of each 100 us are calculated in closed form.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from functools import lru_cache
from math import isqrt
from typing import NamedTuple

# Arithmetic of the PMC006B4's motions: accelerations, ramps, distances, plans (P006-MOT-02, -10..-21). Speeds
# are whole numbers of steps/s from 0 to 16000, distances are whole numbers of steps, and times are multiples
# of 1 us. All results are exact.

WHOLE = 1 << 32
"""Progress of a ramp at its end."""
UPDATES_HZ = 10_000
STEEPEST = 5
"""Largest ramp coefficient."""
SHORT = 256
"""Smallest displacement with an S-curve, in steps (P006-MOT-23)."""
SPARE = 3
"""Number of steps that `by_distance` leaves for the stage CREEP, after the ramp (P006-MOT-11)."""


def acceleration(n: int) -> int:
    """Return the mean acceleration in steps/s^2 for the ramp coefficient n = 0..5 (P006-MOT-02)."""
    return 1700 << n


def up(a: int, b: int) -> int:
    """Return a / b, rounded up."""
    whole, rest = divmod(a, b)
    return whole + (rest > 0)


def by_coefficient(change: int, n: int) -> int:
    """Return the progress per update of a ramp whose speeds differ by `change` >= 1 (P006-MOT-10)."""
    return min(WHOLE, WHOLE * acceleration(n) // (UPDATES_HZ * change))


def by_distance(v: int, ve: int, steps_left: int) -> int:
    """Return the progress per update of a ramp from speed v to speed ve in a limited distance (P006-MOT-11).

    When the ramp ends, `SPARE` of the `steps_left` steps remain.
    """
    way = max(1, steps_left - SPARE)
    return min(WHOLE, up(WHOLE * (v + ve), 2 * UPDATES_HZ * way))


def margin(v: int) -> int:
    """Return the number of steps that the plan adds to a distance at speed v (P006-MOT-12)."""
    return 4 + v // 4096


def ramp_steps(fast: int, slow: int, n: int) -> int:
    """Return the number of steps of a ramp between two speeds, fast >= slow, rounded up."""
    return up((fast + slow) * (fast - slow), 2 * acceleration(n))


@lru_cache(maxsize=1 << 14)
def stopping_distance(v: int, ve: int, n: int) -> int:
    """Return the number of steps that a stop takes from speed v to speed ve, v > ve (P006-MOT-15)."""
    return ramp_steps(v, ve, n) + margin(v)


class Ramp(NamedTuple):
    """Ramp from `begin` to `goal` steps/s. Each update adds `rate` to the progress.

    Attributes:
        smooth: True for an S-curve, False for a straight ramp.
    """

    begin: int
    goal: int
    rate: int
    smooth: bool

    def at(self, progress: int) -> int:
        """Return the speed at a progress of 0..WHOLE-1 (P006-MOT-13, -14)."""
        x = progress >> 16
        part = ((3 * x**2 << 16) - 2 * x**3) >> 16 if self.smooth else progress & -65536
        change = self.goal - self.begin
        moved = (2 * abs(change) * part + WHOLE) // (2 * WHOLE)
        return self.begin + (moved if change > 0 else -moved)


class Plan(NamedTuple):
    """Plan of a motion: goal of the first ramp, and the coefficients of the ramps."""

    goal: int
    acc: int
    dec: int


def plan(n: int, vs: int, ve: int, target: int, acc: int, dec: int) -> Plan:
    """Return the plan of a displacement of n >= 256 steps (P006-MOT-16, -17, -20, -21)."""
    if target < max(vs, ve):
        return Plan(target, acc, dec)
    rest = n - margin(target) - 4
    for lift in range(STEEPEST + 1):
        a, d = min(STEEPEST, acc + lift), min(STEEPEST, dec + lift)
        if ramp_steps(target, vs, a) + ramp_steps(target, ve, d) <= rest:
            return Plan(target, a, d)
    peak = isqrt(acceleration(STEEPEST) * rest + (vs * vs + ve * ve) // 2)
    return Plan(min(target, peak), STEEPEST, STEEPEST)


SECOND = 1_000_000
UPDATE = 100
"""Time between two updates in us."""


class Stage(Enum):
    """Stages of a motion."""

    CRUISE = "cruise"
    RAMP = "ramp"
    DEC = "dec"
    CREEP = "creep"
    STOP = "stop"
    END = "end"


FREE = (Stage.RAMP, Stage.CRUISE)
"""Stages in which a new target is accepted and a deceleration may begin."""
NEXT = {Stage.RAMP: Stage.CRUISE, Stage.DEC: Stage.CREEP, Stage.STOP: Stage.END}


class MotionStart(NamedTuple):
    """Values that a motion latches at its start.

    Attributes:
        n: number of steps, `None` in speed mode.
        vs: VSTART.
        ve: VSTOP.
        target: target speed.
        acc, dec: coefficients.
    """

    n: int | None
    vs: int
    ve: int
    target: int
    acc: int
    dec: int


class LiveRegisters(NamedTuple):
    """Registers that `advance` reads; they may change during the motion.

    Attributes:
        target: target speed.
        straight: True if ramps to the target are straight.
        stop: True after the speed mode was switched off.
    """

    target: int
    straight: bool = False
    stop: bool = False


class Engine:
    """One motion.

    At t = 0, the user calls `advance` and then `segment(99)`. At each update, the user calls `load` and
    `segment`, and then, unless `finished` is set, `advance`.

    Attributes:
        speed: current speed V.
        next_speed: speed V from the next update on.
        steps_left: remaining steps, `None` in speed mode.
        decel_start: (steps_left, speed) at the beginning of the last deceleration, `None` before the first.
    """

    def __init__(self, request: MotionStart) -> None:
        self.request = request
        self.steps_left = request.n
        self.acc, self.dec = request.acc, request.dec
        self.finished = False
        self.stage = Stage.CRUISE
        self.decel_start: tuple[int, int] | None = None
        self._target = request.target
        self._phase = 0
        self._progress = 0
        self._before = request.n
        self.short = request.n is not None and request.n < SHORT
        self.speed = request.vs if self.short else min(request.vs, request.target)
        self.next_speed = self.goal = self.speed
        if self.short:
            self._begin_short(request.vs, request.ve, request.n or 0)
        else:
            self._begin(request)

    def _begin(self, request: MotionStart) -> None:
        goal = request.target
        if request.n is not None:
            goal, self.acc, self.dec = plan(request.n, request.vs, request.ve, goal, request.acc, request.dec)
        if goal != self.speed:
            self._ramp(Stage.RAMP, goal, by_coefficient(abs(goal - self.speed), self.acc))

    def _begin_short(self, vs: int, ve: int, n: int) -> None:
        """Begin a displacement that has no S-curve (P006-MOT-23)."""
        if vs != ve:
            rate = by_coefficient(abs(ve - vs), self.dec if ve < vs else self.acc)
            self._ramp(Stage.RAMP, ve, max(rate, by_distance(vs, ve, n)), smooth=False)

    def _ramp(self, stage: Stage, goal: int, rate: int, smooth: bool = True) -> None:
        self.stage, self.goal, self._progress = stage, goal, 0
        self._curve = Ramp(self.speed, goal, rate, smooth)

    # ------------------------------------------------------------------ steps

    def load(self) -> None:
        """Begin an update: the new speed becomes active."""
        self.speed = self.next_speed

    def segment(self, ticks: int = UPDATE) -> Sequence[int]:
        """Return the times of the steps in the next `ticks` us, in which the speed is constant.

        Each time is a number of us, 1 .. ticks.

        The last step of the motion sets `finished`.
        """
        count, rest = divmod(self._phase + ticks * self.speed, SECOND)
        self._before = self.steps_left
        if not count:
            self._phase = rest
            return ()
        steps = [-((self._phase - k * SECOND) // self.speed) for k in range(1, count + 1)]
        self._phase = rest
        if self.steps_left is not None:
            self.finished = len(steps) >= self.steps_left
            steps = steps[: self.steps_left]
            self._before = self.steps_left - (steps[0] == 1)
            self.steps_left -= len(steps)
        return steps

    # ------------------------------------------------------------------ speed

    def advance(self, live: LiveRegisters) -> None:
        """Calculate `next_speed` (docs/pmc006/README.md, 6.1 Exact arithmetic).

        Call it once between two updates, with the register values after the first microsecond.
        """
        if self.stage in (Stage.STOP, Stage.END) and not live.stop:
            self.stage, self._target = Stage.CRUISE, self.speed
        if self.stage in FREE and not self.short:
            if self.request.n is None and live.stop:
                self._end_speed_mode()
            else:
                self._change_target(live)
                self._begin_final_decel()
        if self.stage in NEXT:
            self._advance_ramp()
        elif self.stage is not Stage.END:
            self.next_speed = self.speed

    def _end_speed_mode(self) -> None:
        """Decelerate after the speed mode was switched off (P006-MOT-41)."""
        slow = self.request.ve
        if self.speed <= slow:
            self.stage = Stage.END
        else:
            self._ramp(Stage.STOP, slow, by_coefficient(self.speed - slow, self.dec))

    def _change_target(self, live: LiveRegisters) -> None:
        """Begin a ramp to a new target (P006-MOT-30)."""
        if live.target == self._target:
            return
        self._target = live.target
        change = live.target - self.speed
        if change:
            rate = by_coefficient(abs(change), self.acc if change > 0 else self.dec)
            self._ramp(Stage.RAMP, live.target, rate, not live.straight)
        else:
            self.stage = Stage.CRUISE

    def _begin_final_decel(self) -> None:
        """Begin the final deceleration of a displacement if the number of remaining steps requires it."""
        slow, steps_left = self.request.ve, self._before
        if (
            steps_left is not None
            and self.speed > slow
            and steps_left <= stopping_distance(self.speed, slow, self.dec)
        ):
            self.decel_start = (steps_left, self.speed)
            self._ramp(Stage.DEC, slow, by_distance(self.speed, slow, steps_left))

    def _advance_ramp(self) -> None:
        self._progress += self._curve.rate
        if self._progress >= WHOLE:
            self.next_speed, self.stage = self._curve.goal, NEXT[self.stage]
        else:
            self.next_speed = self._curve.at(self._progress)
