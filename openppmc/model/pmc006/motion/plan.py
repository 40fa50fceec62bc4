"""Arithmetic of the PMC006B4's motions: accelerations, ramps, ways, plans (P006-MOT-02, -10..-21).

Speeds are whole steps/s 0..16000, ways whole steps, all times multiples of 1 us. Everything is exact.
"""

from __future__ import annotations

from functools import lru_cache
from math import isqrt
from typing import NamedTuple

WHOLE = 1 << 32
"""Progress of a complete ramp."""
UPDATES_HZ = 10_000
STEEPEST = 5
"""The largest coefficient."""
SHORT = 256
"""Displacements below this one have no S-curve (P006-MOT-23)."""
SPARE = 3
"""Steps that a fitted ramp leaves to creep (P006-MOT-11)."""


def acceleration(n: int) -> int:
    """Mean acceleration of coefficient n = 0..5, steps/s^2 (P006-MOT-02)."""
    return 1700 << n


def up(a: int, b: int) -> int:
    """a / b, rounded up."""
    whole, rest = divmod(a, b)
    return whole + (rest > 0)


def by_coefficient(change: int, n: int) -> int:
    """Progress per update of a ramp over `change` >= 1 steps/s (P006-MOT-10)."""
    return min(WHOLE, WHOLE * acceleration(n) // (UPDATES_HZ * change))


def by_distance(v: int, ve: int, left: int) -> int:
    """Progress per update of a ramp from v to ve that ends `SPARE` steps before `left` (P006-MOT-11)."""
    way = max(1, left - SPARE)
    return min(WHOLE, up(WHOLE * (v + ve), 2 * UPDATES_HZ * way))


def margin(v: int) -> int:
    """Steps that planning adds to a way at speed v (P006-MOT-12)."""
    return 4 + v // 4096


def way(fast: int, slow: int, n: int) -> int:
    """Steps between two speeds at coefficient n, rounded up; fast >= slow."""
    return up((fast + slow) * (fast - slow), 2 * acceleration(n))


@lru_cache(maxsize=1 << 14)
def reach(v: int, ve: int, n: int) -> int:
    """Stopping distance from v > ve (P006-MOT-15)."""
    return way(v, ve, n) + margin(v)


class Ramp(NamedTuple):
    """From `begin` to `goal` steps/s, `rate` of WHOLE per update, smooth (S) or straight."""

    begin: int
    goal: int
    rate: int
    smooth: bool

    def at(self, progress: int) -> int:
        """Speed at a progress of 0..WHOLE-1 (P006-MOT-13, -14)."""
        x = progress >> 16
        part = ((3 * x**2 << 16) - 2 * x**3) >> 16 if self.smooth else progress & -65536
        change = self.goal - self.begin
        moved = (2 * abs(change) * part + WHOLE) // (2 * WHOLE)
        return self.begin + (moved if change > 0 else -moved)


class Plan(NamedTuple):
    """Goal of the first ramp, and the coefficients in force."""

    goal: int
    acc: int
    dec: int


def plan(n: int, vs: int, ve: int, target: int, acc: int, dec: int) -> Plan:
    """Plan of a displacement of n >= 256 steps (P006-MOT-16, -17, -20, -21)."""
    if target < max(vs, ve):
        return Plan(target, acc, dec)
    rest = n - margin(target) - 4
    for lift in range(STEEPEST + 1):
        a, d = min(STEEPEST, acc + lift), min(STEEPEST, dec + lift)
        if way(target, vs, a) + way(target, ve, d) <= rest:
            return Plan(target, a, d)
    peak = isqrt(acceleration(STEEPEST) * rest + (vs * vs + ve * ve) // 2)
    return Plan(min(target, peak), STEEPEST, STEEPEST)
