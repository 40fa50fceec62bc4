"""Plan of an operation of the PPMC-312: where it accelerates and decelerates (P312-MOT-10..13)."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass
from typing import NamedTuple

from .tables import Table

TRAPEZOID, TRIANGLE, RIGHT_DOWN, RIGHT_UP = 0x00, 0x10, 0x20, 0x40


class Step(NamedTuple):
    """One pulse and the interval after it: rate in ticks, table stage (None: constant speed), and whether it
    belongs to a planned final deceleration."""

    rate: int
    stage: int | None = None
    planned: bool = False


@dataclass(frozen=True)
class Plan:
    """n pulses (None: endless), the first `up` of them accelerating, the last `down` decelerating, between
    them constant at `rate`. kind: status bits of the answer."""

    table: Table
    rate: int
    n: int | None = None
    up: int = 0
    down: int = 0
    kind: int = TRAPEZOID

    def step(self, number: int) -> Step:
        """Pulse `number`, 1 .. n (P312-MOT-12)."""
        table = self.table
        if number <= self.up:
            stage = bisect_left(table.sums_up, number)
            return Step(table.rates[stage], stage)
        if self.n is not None and number > self.n - self.down:
            stage = bisect_left(table.sums_down, self.n - number + 1)
            return Step(table.rates[stage], stage, True)
        return Step(self.rate)

    def steps(self) -> list[Step]:
        """All pulses of an undisturbed operation. Raises ValueError for an endless one."""
        if self.n is None:
            raise ValueError("endless operation")
        return [self.step(number) for number in range(1, self.n + 1)]


def constant(table: Table, rate: int, n: int | None = None) -> Plan:
    """Constant speed: 83, 84, 86, 10."""
    return Plan(table, rate, n)


def ramped(table: Table, rate: int, n: int | None) -> Plan:
    """82 with n pulses, 85 and phase 1 of 11 without; `rate` is the speed aimed at."""
    top, sa, sd = table.stage(rate), table.sa, table.sd
    if top <= sa:
        down = 0 if n is None else min(n, sum(table.pd[sd : top + 1]))
        return Plan(table, rate, n, 0, down, RIGHT_DOWN)
    up, down = sum(table.pa[sa : top + 1]), sum(table.pd[sd : top + 1])
    if n is None:
        return Plan(table, rate, None, up)
    if n >= up + down:
        return Plan(table, rate, n, up, down)
    only_up = sum(table.pa[sa : min(sd, top + 1)])
    only_down = sum(table.pd[sd:sa])
    difference = only_up + only_down
    if difference and n <= difference:
        if only_up:
            return Plan(table, rate, n, n, 0, RIGHT_UP)
        return Plan(table, rate, n, 0, n, RIGHT_DOWN)
    common = up - only_up
    first = only_up + (n - difference) * common // (common + down - only_down)
    return Plan(table, rate, n, first, n - first, TRIANGLE)
