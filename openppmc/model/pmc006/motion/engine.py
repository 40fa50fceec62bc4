"""Speed and steps of one motion of the PMC006B4, per update (P006-MOT-03, -22, -23, -30..-42).

This module is pure arithmetic in us from t = 0; `motion` has edges and events. Between two updates the speed
is constant, so the steps of each 100 us are known in closed form.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from functools import lru_cache
from math import isqrt
from typing import NamedTuple

# Arithmetic of the PMC006B4's motions: accelerations, ramps, distances, plans (P006-MOT-02, -10..-21).
# Speeds are whole steps/s 0..16000, distances whole steps, all times multiples of 1 us. All results are
# exact.

WHOLE = 1 << 32
"""Progress of a complete ramp."""
UPDATES_HZ = 10_000
STEEPEST = 5
"""Largest coefficient."""
SHORT = 256
"""Displacements below this one have no S-curve (P006-MOT-23)."""
SPARE = 3
"""Steps that a fitted ramp leaves for CREEP (P006-MOT-11)."""


def acceleration(n: int) -> int:
    """Return the mean acceleration of coefficient n = 0..5 in steps/s^2 (P006-MOT-02)."""
    return 1700 << n


def up(a: int, b: int) -> int:
    """Return a / b, rounded up."""
    whole, rest = divmod(a, b)
    return whole + (rest > 0)


def by_coefficient(change: int, n: int) -> int:
    """Return the progress per update of a ramp over `change` >= 1 steps/s (P006-MOT-10)."""
    return min(WHOLE, WHOLE * acceleration(n) // (UPDATES_HZ * change))


def by_distance(v: int, ve: int, left: int) -> int:
    """Return the progress per update of a ramp from v to ve (P006-MOT-11).

    The ramp ends `SPARE` steps before `left`.
    """
    way = max(1, left - SPARE)
    return min(WHOLE, up(WHOLE * (v + ve), 2 * UPDATES_HZ * way))


def margin(v: int) -> int:
    """Return the steps that planning adds to a distance at speed v (P006-MOT-12)."""
    return 4 + v // 4096


def way(fast: int, slow: int, n: int) -> int:
    """Return the steps between two speeds at coefficient n, rounded up; fast >= slow."""
    return up((fast + slow) * (fast - slow), 2 * acceleration(n))


@lru_cache(maxsize=1 << 14)
def reach(v: int, ve: int, n: int) -> int:
    """Return the stopping distance from v > ve (P006-MOT-15)."""
    return way(v, ve, n) + margin(v)


class Ramp(NamedTuple):
    """Ramp from `begin` to `goal` steps/s, `rate` of WHOLE per update.

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
    """Goal of the first ramp, and the active coefficients."""

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
        if way(target, vs, a) + way(target, ve, d) <= rest:
            return Plan(target, a, d)
    peak = isqrt(acceleration(STEEPEST) * rest + (vs * vs + ve * ve) // 2)
    return Plan(min(target, peak), STEEPEST, STEEPEST)


SECOND = 1_000_000
UPDATE = 100
"""Time between two updates in us."""


class Stage(Enum):
    """States of the speed."""

    CRUISE = "cruise"
    RAMP = "ramp"
    DEC = "dec"
    CREEP = "creep"
    STOP = "stop"
    END = "end"


FREE = (Stage.RAMP, Stage.CRUISE)
"""Stages that accept a new target or begin to decelerate."""
NEXT = {Stage.RAMP: Stage.CRUISE, Stage.DEC: Stage.CREEP, Stage.STOP: Stage.END}


class Order(NamedTuple):
    """Values that a motion latches at its start.

    Attributes:
        n: steps (`None`: speed mode).
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


class Live(NamedTuple):
    """Registers that `advance` reads.

    Attributes:
        target: target speed.
        straight: True if ramps to it are straight.
        stop: True if speed mode was switched off.
    """

    target: int
    straight: bool = False
    stop: bool = False


class Engine:
    """One motion.

    Per update, call `load`, `segment`, then `advance` unless `over`. At t = 0, call `advance`, then
    `segment(99)`.

    Attributes:
        speed: current V.
        following: V of the next update.
        left: remaining steps, `None` without an end.
        braked: (left, speed) at which the last deceleration began, `None` before it.
    """

    def __init__(self, order: Order) -> None:
        self.order = order
        self.left = order.n
        self.acc, self.dec = order.acc, order.dec
        self.over = False
        self.stage = Stage.CRUISE
        self.braked: tuple[int, int] | None = None
        self._target = order.target
        self._phase = 0
        self._progress = 0
        self._before = order.n
        self.short = order.n is not None and order.n < SHORT
        self.speed = order.vs if self.short else min(order.vs, order.target)
        self.following = self.goal = self.speed
        if self.short:
            self._begin_short(order.vs, order.ve, order.n or 0)
        else:
            self._begin(order)

    def _begin(self, order: Order) -> None:
        goal = order.target
        if order.n is not None:
            goal, self.acc, self.dec = plan(order.n, order.vs, order.ve, goal, order.acc, order.dec)
        if goal != self.speed:
            self._ramp(Stage.RAMP, goal, by_coefficient(abs(goal - self.speed), self.acc))

    def _begin_short(self, vs: int, ve: int, n: int) -> None:
        """Begin a displacement without S-curve (P006-MOT-23)."""
        if vs != ve:
            rate = by_coefficient(abs(ve - vs), self.dec if ve < vs else self.acc)
            self._ramp(Stage.RAMP, ve, max(rate, by_distance(vs, ve, n)), smooth=False)

    def _ramp(self, stage: Stage, goal: int, rate: int, smooth: bool = True) -> None:
        self.stage, self.goal, self._progress = stage, goal, 0
        self._line = Ramp(self.speed, goal, rate, smooth)

    # ------------------------------------------------------------------ steps

    def load(self) -> None:
        """Begin an update: the new speed becomes active."""
        self.speed = self.following

    def segment(self, ticks: int = UPDATE) -> Sequence[int]:
        """Return the steps of the next `ticks` us at the current speed, as 1 .. ticks.

        The last step of the motion sets `over`.
        """
        count, rest = divmod(self._phase + ticks * self.speed, SECOND)
        self._before = self.left
        if not count:
            self._phase = rest
            return ()
        made = [-((self._phase - k * SECOND) // self.speed) for k in range(1, count + 1)]
        self._phase = rest
        if self.left is not None:
            self.over = len(made) >= self.left
            made = made[: self.left]
            self._before = self.left - (made[0] == 1)
            self.left -= len(made)
        return made

    # ------------------------------------------------------------------ speed

    def advance(self, live: Live) -> None:
        """Calculate `following` (P006 5.5).

        In an update, call it after the first us was processed, and before the second one.
        """
        if self.stage in (Stage.STOP, Stage.END) and not live.stop:
            self.stage, self._target = Stage.CRUISE, self.speed
        if self.stage in FREE and not self.short:
            if self.order.n is None and live.stop:
                self._brake_to_end()
            else:
                self._aim(live)
                self._brake()
        if self.stage in NEXT:
            self._climb()
        elif self.stage is not Stage.END:
            self.following = self.speed

    def _brake_to_end(self) -> None:
        """Decelerate after the speed mode was switched off (P006-MOT-41)."""
        slow = self.order.ve
        if self.speed <= slow:
            self.stage = Stage.END
        else:
            self._ramp(Stage.STOP, slow, by_coefficient(self.speed - slow, self.dec))

    def _aim(self, live: Live) -> None:
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

    def _brake(self) -> None:
        """Begin the final deceleration of a displacement if it is required."""
        slow, left = self.order.ve, self._before
        if left is not None and self.speed > slow and left <= reach(self.speed, slow, self.dec):
            self.braked = (left, self.speed)
            self._ramp(Stage.DEC, slow, by_distance(self.speed, slow, left))

    def _climb(self) -> None:
        self._progress += self._line.rate
        if self._progress >= WHOLE:
            self.following, self.stage = self._line.goal, NEXT[self.stage]
        else:
            self.following = self._line.at(self._progress)
