"""Acceleration tables of the PPMC-312 from an initial setting: P312-TBL-01..06, P312-CMD-00.

Rates are rounded fractions of exact speeds, pulses are differences of floors of the exact running sum, and
the raised cosine comes from its power series: nothing here divides step by step as a table engine would.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal, localcontext
from fractions import Fraction
from functools import cache, cached_property
from itertools import accumulate
from math import floor

STAGES = 127
LAST = STAGES - 1
SLOWEST_START, FASTEST, SLOWEST = 0x0011, 0x0002, 0xFFEF
LEAST_DIFFERENCE, LEAST_PULSES = 127, 2
DIVIDERS = {0: 2, 1: 16, 2: 32, 3: 64, 4: 256, 5: 1024}
"""CLK to XTAL cycles of a tick; 6 and 7 are the edges of EXTCK."""


class SettingError(ValueError):
    """A setting is refused; `number` is the error number of F0 (10.2), `table` what was built for nothing."""

    def __init__(self, number: int, table: Table | None = None) -> None:
        super().__init__(f"setting refused with error {number:#04x}")
        self.number, self.table = number, table


@dataclass(frozen=True)
class Table:
    """A valid table: 127 rates in ticks, pulses of each stage for both sides, first stage of each side.

    Index 126 is the fastest stage. Below its first stage a side has 0 pulses; below both the rates mean
    nothing. clk: base clock 0..7. separate: deceleration has its own side (LE = 1).
    """

    rates: tuple[int, ...]
    pa: tuple[int, ...]
    pd: tuple[int, ...]
    sa: int
    sd: int
    clk: int
    separate: bool

    @property
    def first(self) -> int:
        """Slowest stage that either side uses."""
        return min(self.sa, self.sd)

    @property
    def high(self) -> int:
        """RH."""
        return self.rates[LAST]

    @property
    def slowest(self) -> int:
        """Rmax, the slowest rate that an instruction may ask for."""
        return self.rates[self.first]

    @property
    def na(self) -> int:
        """Acceleration pulses."""
        return sum(self.pa)

    @property
    def nd(self) -> int:
        """Deceleration pulses."""
        return sum(self.pd)

    @cached_property
    def sums_up(self) -> list[int]:
        """Acceleration pulses up to and including each stage."""
        return list(accumulate(self.pa))

    @cached_property
    def sums_down(self) -> list[int]:
        """Deceleration pulses of each stage and the slower ones."""
        return list(accumulate(self.pd))

    def stage(self, rate: int) -> int:
        """t(rate): the last stage that is at least as slow; one before the first if there is none."""
        for i in range(LAST, self.first - 1, -1):
            if self.rates[i] >= rate:
                return i
        return self.first - 1

    def contains(self, rate: int) -> bool:
        """Whether an instruction may ask for this rate."""
        return self.high <= rate <= self.slowest


def _pi() -> Decimal:
    """Machin's formula in the present precision."""

    def arccot(x: int) -> Decimal:
        term, n, total = Decimal(1) / x, 1, Decimal(0)
        while abs(term) > Decimal(10) ** -50:
            total += term / n if n % 4 == 1 else -term / n
            term /= x * x
            n += 2
        return total

    return 4 * (4 * arccot(5) - arccot(239))


@cache
def sigmoid_weights() -> tuple[int, ...]:
    """W_i = round(65536 (1 - cos(pi i / 126)) / 2), i = 0..126."""
    weights = []
    with localcontext() as context:
        context.prec = 60
        pi = _pi()
        for i in range(STAGES):
            x, term, total = pi * i / LAST, Decimal(1), Decimal(0)
            for n in range(1, 80, 2):
                total += term
                term = -term * x * x / (n * (n + 1))
            weights.append(int((32768 * (1 - total)).to_integral_value(ROUND_HALF_UP)))
    return tuple(weights)


def _shares(sigmoid: bool) -> list[Fraction]:
    """How much of the way from the slowest to the fastest speed each stage has made."""
    if sigmoid:
        return [Fraction(w, 65536) for w in sigmoid_weights()]
    return [Fraction(i, LAST) for i in range(STAGES)]


def speeds(slow: int, high: int, sigmoid: bool) -> list[Fraction]:
    """Speed of each stage in pulses a tick (P312-TBL-01)."""
    bottom, top = Fraction(1, slow), Fraction(1, high)
    return [bottom + (top - bottom) * share for share in _shares(sigmoid)]


def side(total: int, speed: Sequence[Fraction], first: int) -> tuple[int, ...]:
    """Pulses of each stage: `total` shared out in proportion to speed, the rest carried on (P312-TBL-04)."""
    whole = sum(speed[first:])
    sums = [floor(total * part / whole) for part in accumulate(speed[first:])]
    return (0,) * first + tuple(b - a for a, b in zip([0, *sums], sums, strict=False))


def first_stage(rates: Sequence[int], ordered: int) -> int:
    """Where the side begins whose slowest rate was ordered so (P312-TBL-03)."""
    if ordered == rates[0]:
        return 0  # the slower side has all stages, whatever rounding makes of R[1]
    return max(i for i in range(STAGES) if rates[i] >= ordered)


def build(
    start: int,
    stop: int,
    high: int,
    na: int,
    nd: int,
    clk: int = 1,
    sigmoid: bool = False,
    separate: bool = True,
) -> Table:
    """Table of an initial setting with LE = `separate`; without it stop and nd are not looked at.

    start, stop, high: 16-bit rates. na, nd: 24-bit pulses. Raises SettingError as P312-CMD-00 says.
    """
    if not separate:
        stop, nd = start, na
    if not FASTEST <= high <= SLOWEST or min(start, stop) < SLOWEST_START:
        raise SettingError(0x01)
    if min(start, stop) <= high:
        raise SettingError(0x03)
    if max(start, stop) - high <= LEAST_DIFFERENCE:
        raise SettingError(0x02)
    if min(start, stop) - high <= LEAST_DIFFERENCE:
        raise SettingError(0x04)
    speed = speeds(max(start, stop), high, sigmoid)
    rates = tuple(floor(1 / v + Fraction(1, 2)) for v in speed)
    sa, sd = (first_stage(rates, slow) for slow in (start, stop))
    pa, pd = side(na, speed, sa), side(nd, speed, sd)
    table = Table(rates, pa, pd, sa, sd, clk, separate)
    if min(*pa[sa:], *pd[sd:]) < LEAST_PULSES:
        raise SettingError(0x05, table)
    return table


def read_back(table: Table) -> list[tuple[int, bytes]]:
    """Blocks of the table read as (header, bytes after the length byte), in order (P312-CMD-41)."""
    upward = range(LAST, -1, -1)
    counts = (STAGES - table.first, STAGES - table.sa, STAGES - table.sd if table.separate else 0)
    head = bytes([0x41, *counts]) + table.na.to_bytes(3, "big") + table.nd.to_bytes(3, "big")
    blocks = [(0x02, head)]
    lists = ((1, table.rates, 2, 6), (2, table.pa, 3, 4), (3, table.pd, 3, 4))
    for (item, values, width, most), count in zip(lists, counts, strict=True):
        chosen = [values[i].to_bytes(width, "big") for i in upward][:count]
        for k in range(0, count, most):
            blocks.append((0x00, bytes([item]) + b"".join(chosen[k : k + most])))
    blocks[-1] = (0x01, blocks[-1][1])
    return blocks
