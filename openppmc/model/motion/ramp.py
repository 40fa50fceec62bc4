"""Exact linear ramp: the square of the speed grows linearly with the pulse index.

All parts of the PPMC family use this ramp.

P104-RMP-01: the interval of index k lasts x(k) = 1/sqrt(1/A + (1/B - 1/A) k/PA) base clock periods, rounded
half up. A and B are the squares of the start and high-speed periods. All values are calculated from the
closed formula with exact integer square roots. `period` is the number of base clock periods of an interval:
rate + 1 for parts with rates, the divisor itself for parts with divisors.

P104-PRO-01..06 and P104-FDC-02: this module also calculates the index of each interval of a move, interval by
interval or by a closed formula.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import isqrt


def ramp_period(start: int, high: int, pa: int, k: int) -> int:
    """Return the number of base clock periods of the interval with index k, 0 <= k <= pa.

    Args:
        start, high: period of index 0 and period of index pa, 1 <= high <= start.
        pa: number of ramp pulses; 0 means no ramp, and then start = high.

    Raises:
        ValueError: a value is out of range.
    """
    if not 1 <= high <= start or not 0 <= k <= pa or (pa == 0 and high < start):
        raise ValueError(f"no ramp value for start {start}, high {high}, pa {pa}, k {k}")
    if pa == 0:
        return start
    a, b = start * start, high * high
    numerator, denominator = a * b * pa, b * pa + (a - b) * k
    # p is the greatest integer with p - 1/2 <= sqrt(n/d), i.e. (2p - 1)^2 <= 4 n/d.
    return (isqrt(4 * numerator // denominator) + 1) // 2


def ramp_rate(rl: int, rh: int, pa: int, k: int) -> int:
    """Return R(k) of P104-RMP-01 for rates 0 <= rh <= rl."""
    return ramp_period(rl + 1, rh + 1, pa, k) - 1


def next_index(kp: int, m: int, pa: int, forced: bool) -> int | None:
    """Return the index of the next interval at a pulse event (P104-PRO-04), `None` after the last pulse.

    Args:
        kp: index of the interval that has just ended, -1 at pulse 1.
        m: remaining pulses.
        forced: True if the forced-deceleration flag is set.
    """
    if m == 0:
        return None
    if not forced:
        return min(kp + 1, m - 1, pa)
    k = min(kp - 1, m - 1)
    return k if k >= 0 else None


def natural_deceleration(kp: int, m: int, pa: int) -> bool:
    """Return True if a pulse event begins the natural deceleration of a move (P104-PRO-05)."""
    return 0 < m and m - 1 < min(kp + 1, pa)


def profile_index(n: int, pa: int, j: int) -> int:
    """Return the index of interval j (1..n-1) of an undisturbed move of n pulses (P104-PRO-01)."""
    return min(j - 1, n - 1 - j, pa)


def index_profile(n: int, pa: int, flagged_in: int | None = None) -> list[int]:
    """Return the indices of all intervals of a move of n pulses, by the closed formula.

    Memory is proportional to the number of pulses.

    Args:
        flagged_in: number of the interval in which a forced deceleration is requested, 0 = before pulse 1. In
            this case, the move ends as P104-FDC-02/03 define.
    """
    plain = [profile_index(n, pa, j) for j in range(1, n)]
    if flagged_in is None or flagged_in >= n:
        return plain
    if flagged_in == 0:
        return []
    peak = plain[flagged_in - 1]
    return plain[:flagged_in] + list(range(peak - 1, -1, -1))


def traverse_ramp(n: int, pa: int, flag: Callable[[int], bool] = lambda j: False) -> list[int]:
    """Return the indices of all intervals, calculated pulse by pulse.

    Args:
        flag: flag(j) returns True if a forced deceleration is requested at pulse j.
    """
    indices: list[int] = []
    kp, forced = -1, False
    for j in range(1, n + 1):
        forced = forced or flag(j)
        k = next_index(kp, n - j, pa, forced)
        if k is None:
            break
        indices.append(k)
        kp = k
    return indices


@dataclass(frozen=True)
class Ramp:
    """Initialised ramp: start rate rl, high-speed rate rh, pa ramp pulses.

    The constructor checks two conditions: 0 <= rh <= rl, and rl = rh if pa = 0. Each part checks further
    limits.

    Raises:
        ValueError: there is no such ramp.
    """

    rl: int
    rh: int
    pa: int

    def __post_init__(self) -> None:
        if not 0 <= self.rh <= self.rl or self.pa < int(self.rh < self.rl):
            raise ValueError(f"no ramp: rl {self.rl}, rh {self.rh}, pa {self.pa}")

    @cached_property
    def _known(self) -> dict[int, int]:
        return {}

    def rate(self, k: int) -> int:
        """Return R(k), 0 <= k <= pa; the result is cached."""
        cache = self._known
        if k not in cache:
            cache[k] = ramp_rate(self.rl, self.rh, self.pa, k)
        return cache[k]

    def rates(self) -> list[int]:
        """Return R(0) .. R(pa)."""
        return [self.rate(k) for k in range(self.pa + 1)]


@dataclass(frozen=True)
class BaseClock:
    """Internal base clock of an interval, with its extra time (P104-BCK-01, P104-INT-01/02).

    Attributes:
        tclock: period of the base clock in quanta: 8 (500 kHz) or 32 (125 kHz).
        extra: time that is added to each interval, in quanta: 0, or 30 (7.5 us).
    """

    tclock: int = 8
    extra: int = 0

    @classmethod
    def of_pins(cls, csel: int, vsel: int) -> BaseClock:
        """Return the clock that the pins csel and vsel select."""
        return cls(8 if csel else 32, 0 if vsel else 30)

    def quanta(self, rate: int) -> int:
        """Return the length of an interval at this rate in quanta."""
        return (rate + 1) * self.tclock + self.extra
