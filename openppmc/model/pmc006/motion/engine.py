"""Speed and steps of one motion of the PMC006B4, update by update (P006-MOT-03, -22, -23, -30..-42).

Pure arithmetic in us from t = 0; edges and events are `motion`'s. Between two updates the speed is
constant, so the steps of each 100 us are known in closed form.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import NamedTuple

from .plan import SHORT, WHOLE, Ramp, by_coefficient, by_distance, plan, reach

SECOND = 1_000_000
UPDATE = 100
"""us between two updates."""


class Stage(Enum):
    """What the speed does."""

    CRUISE = "cruise"
    RAMP = "ramp"
    DEC = "dec"
    CREEP = "creep"
    STOP = "stop"
    END = "end"


FREE = (Stage.RAMP, Stage.CRUISE)
"""Stages that take a new target or begin to decelerate."""
NEXT = {Stage.RAMP: Stage.CRUISE, Stage.DEC: Stage.CREEP, Stage.STOP: Stage.END}


class Order(NamedTuple):
    """What a motion keeps from its start: steps (None: speed mode), VSTART, VSTOP, coefficients, target."""

    n: int | None
    vs: int
    ve: int
    target: int
    acc: int
    dec: int


class Live(NamedTuple):
    """What an advance reads of the registers: target, shape of ramps to it, speed mode switched off."""

    target: int
    straight: bool = False
    stop: bool = False


class Engine:
    """One motion. speed: V in force. following: that of the next update. left: steps to go, None without end.

    Per update: `load`, `segment`, then `advance` unless `over`; at t = 0 `advance`, then `segment(99)`.
    braked: (left, speed) at which the last deceleration began, None before it.
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
        """P006-MOT-23."""
        if vs != ve:
            rate = by_coefficient(abs(ve - vs), self.dec if ve < vs else self.acc)
            self._ramp(Stage.RAMP, ve, max(rate, by_distance(vs, ve, n)), smooth=False)

    def _ramp(self, stage: Stage, goal: int, rate: int, smooth: bool = True) -> None:
        self.stage, self.goal, self._progress = stage, goal, 0
        self._line = Ramp(self.speed, goal, rate, smooth)

    # ------------------------------------------------------------------ steps

    def load(self) -> None:
        """An update: the new speed is in force."""
        self.speed = self.following

    def segment(self, ticks: int = UPDATE) -> Sequence[int]:
        """Steps of the coming `ticks` us at the present speed, as 1 .. ticks; `over` with the last of all."""
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
        """Work out `following` (P006 5.5). In an update with its first us worked on, but no more of it."""
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
        """Speed mode has been switched off (P006-MOT-41)."""
        slow = self.order.ve
        if self.speed <= slow:
            self.stage = Stage.END
        else:
            self._ramp(Stage.STOP, slow, by_coefficient(self.speed - slow, self.dec))

    def _aim(self, live: Live) -> None:
        """A new target (P006-MOT-30)."""
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
        """The final deceleration of a displacement, if it is time for it."""
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
