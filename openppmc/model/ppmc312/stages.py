"""Acceleration tables of the PPMC-312 from an initial setting: P312-TBL-01..06, P312-CMD-00.

Rates are rounded from exact speeds. The pulses of a stage are the difference of two successive exact running
sums, each rounded down. The raised cosine is calculated from its power series. Thus, the model does not use
the stepwise divisions of the RTL.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import ROUND_HALF_UP, Decimal, localcontext
from fractions import Fraction
from functools import cache, cached_property, lru_cache
from itertools import accumulate
from math import floor
from typing import NamedTuple

from .codes import LE

STAGES = 127
LAST = STAGES - 1
SLOWEST_START, FASTEST, SLOWEST = 0x0011, 0x0002, 0xFFEF
LEAST_DIFFERENCE, LEAST_PULSES = 127, 2
DIVIDERS = {0: 2, 1: 16, 2: 32, 3: 64, 4: 256, 5: 1024}
"""Number of crystal cycles in a tick of the base clock, by CLK.

With CLK 6 and 7, the ticks are the edges of EXTCK.
"""


class SettingError(ValueError):
    """Rejected setting.

    Args:
        number: error number of F0 (docs/ppmc312/README.md, 6.1 Blocks).
        table: table that was built, but is invalid.
    """

    def __init__(self, number: int, table: Table | None = None) -> None:
        super().__init__(f"setting refused with error {number:#04x}")
        self.number, self.table = number, table


@dataclass(frozen=True)
class Table:
    """Valid table of 127 stages.

    It has 127 rates in ticks, the pulses of each stage for both ramps, and the first stage of each ramp.

    Index 126 is the fastest stage. Stages below the first stage of a ramp have 0 pulses in this ramp. Below
    the first stages of both ramps, the rates have no meaning.

    Attributes:
        clk: base clock 0..7.
        separate: True if the deceleration ramp is not the reversed acceleration ramp (LE = 1).
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
        """Slowest stage that either ramp uses."""
        return min(self.sa, self.sd)

    @property
    def high(self) -> int:
        """Rate RH of the high speed in ticks."""
        return self.rates[LAST]

    @property
    def slowest(self) -> int:
        """Rmax: slowest rate that an instruction may contain."""
        return self.rates[self.first]

    @property
    def na(self) -> int:
        """Sum of the acceleration pulses of all stages."""
        return sum(self.pa)

    @property
    def nd(self) -> int:
        """Sum of the deceleration pulses of all stages."""
        return sum(self.pd)

    @cached_property
    def sums_up(self) -> list[int]:
        """For each stage, the sum of the acceleration pulses in this stage and in all slower stages."""
        return list(accumulate(self.pa))

    @cached_property
    def sums_down(self) -> list[int]:
        """For each stage, the sum of the deceleration pulses in this stage and in all slower stages."""
        return list(accumulate(self.pd))

    def stage(self, rate: int) -> int:
        """Return t(rate), the fastest stage that is not faster than this rate.

        If there is no such stage, the result is the number of the first stage minus 1.
        """
        for i in range(LAST, self.first - 1, -1):
            if self.rates[i] >= rate:
                return i
        return self.first - 1

    def contains(self, rate: int) -> bool:
        """Return True if this rate is valid in an instruction."""
        return self.high <= rate <= self.slowest


def _pi() -> Decimal:
    """Return pi in the current precision of `decimal`, calculated with Machin's formula."""

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
    """Return W_i = round(65536 (1 - cos(pi i / 126)) / 2), i = 0..126."""
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
    """Return the position of each stage on a scale from the slowest speed (0) to the fastest speed (1)."""
    if sigmoid:
        return [Fraction(w, 65536) for w in sigmoid_weights()]
    return [Fraction(i, LAST) for i in range(STAGES)]


def speeds(slow: int, high: int, sigmoid: bool) -> list[Fraction]:
    """Return the speed of each stage in pulses per tick (P312-TBL-01)."""
    bottom, top = Fraction(1, slow), Fraction(1, high)
    return [bottom + (top - bottom) * share for share in _shares(sigmoid)]


def side(total: int, speed: Sequence[Fraction], first: int) -> tuple[int, ...]:
    """Return the pulses of each stage (P312-TBL-04).

    `total` is distributed in proportion to the speeds, and remainders are carried to the next stage.
    """
    whole = sum(speed[first:])
    sums = [floor(total * part / whole) for part in accumulate(speed[first:])]
    return (0,) * first + tuple(b - a for a, b in zip([0, *sums], sums, strict=False))


def first_stage(rates: Sequence[int], ordered: int) -> int:
    """Return the first stage of the ramp with this slowest rate (P312-TBL-03)."""
    if ordered == rates[0]:
        return 0  # the slower ramp has all stages, whether R[1] is rounded up or down
    return max(i for i in range(STAGES) if rates[i] >= ordered)


@lru_cache(maxsize=8)
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
    """Return the table of an initial setting with LE = `separate`.

    If `separate` is False, stop and nd are ignored.

    Args:
        start, stop, high: 16-bit rates.
        na, nd: 24-bit pulses.

    Raises:
        SettingError: the setting is invalid (P312-CMD-00).
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
    """Return the response to a table read: per block (header, bytes after the length byte) (P312-CMD-41)."""
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


# Free-curve transfer of the PPMC-312: P312-CMD-01, P312-CMD-FC-1..10.

CODE_HEADER, MORE, LAST_BLOCK = 0x02, 0x00, 0x01
RATES, ACCELERATION, DECELERATION = range(3)
_WIDTH = (2, 3, 3)
_MOST_PULSES = 0xFFFFFF


class FreeCurve:
    """Transfer of a free curve, which a code block begins.

    Every error raises SettingError and ends the transfer.

    Attributes:
        table: finished table, `None` before the last block.
    """

    def __init__(self, header: int, parameters: bytes) -> None:
        """Process the code block, and check it for the errors 0x10 and 0x11.

        Args:
            parameters: bytes after the code.
        """
        if header != CODE_HEADER:
            raise SettingError(0x10)
        if len(parameters) not in (2, 3) or (len(parameters) == 2 and parameters[0] & LE):
            raise SettingError(0x11)
        flags, n_a = parameters[0], parameters[1]
        self._separate, self._clk = bool(flags & LE), flags & 7
        n_d = parameters[2] if self._separate else n_a
        if not (2 <= n_a <= STAGES and 2 <= n_d <= STAGES):
            raise SettingError(0x11)
        self._needs = [max(n_a, n_d), n_a, n_d if self._separate else 0]
        self._lists: list[list[int]] = [[], [], []]
        self.table: Table | None = None

    def _expected(self) -> int | None:
        """Return the list to which the next block belongs, `None` if all lists are complete."""
        for item, (need, values) in enumerate(zip(self._needs, self._lists, strict=True)):
            if len(values) < need:
                return item
        return None

    def answer(self) -> bytes:
        """Return the parameters of the response to the last block (P312-CMD-FC-1..3)."""
        if self.table:
            return b"\x0f" + self.table.na.to_bytes(3, "big") + self.table.nd.to_bytes(3, "big")
        item = self._expected()
        assert item is not None
        return bytes([item, self._needs[item] - len(self._lists[item])])

    def add(self, header: int, data: bytes) -> None:
        """Process a data block; check the errors 0x16..0x1A in the order of P312-CMD-FC-4."""
        item = self._expected()
        assert item is not None
        width, values = _WIDTH[item], self._lists[item]
        count, rest = divmod(len(data), width)
        if rest or not count or len(values) + count > self._needs[item]:
            raise SettingError(0x16)
        fresh = [int.from_bytes(data[k : k + width], "big") for k in range(0, len(data), width)]
        if min(fresh) <= 1:
            raise SettingError(0x18 if item == RATES else 0x19)
        values += fresh
        if item != RATES and sum(values) > _MOST_PULSES:
            raise SettingError(0x1A)
        if (header == LAST_BLOCK) != (self._expected() is None):
            raise SettingError(0x17)
        if header == LAST_BLOCK:
            self.table = self._finish()

    def _finish(self) -> Table:
        def slow_first(values: list[int]) -> tuple[int, ...]:
            return (0,) * (STAGES - len(values)) + tuple(reversed(values))

        rates, pa, pd = self._lists
        pd = pd if self._separate else pa
        return Table(
            slow_first(rates),
            slow_first(pa),
            slow_first(pd),
            LAST + 1 - len(pa),
            LAST + 1 - len(pd),
            self._clk,
            self._separate,
        )


def curve(rates: list[int], pa: list[int], pd: list[int] | None = None, clk: int = 1) -> Table:
    """Return the table of a complete free curve, fastest stage first. Raises SettingError."""
    stages = [len(pa), len(pd)] if pd else [len(pa)]
    transfer = FreeCurve(CODE_HEADER, bytes([clk | (LE if pd else 0), *stages]))
    for item, values in ((RATES, rates), (ACCELERATION, pa), (DECELERATION, pd or [])):
        for k in range(0, len(values), 10):
            data = b"".join(v.to_bytes(_WIDTH[item], "big") for v in values[k : k + 10])
            final = item == (DECELERATION if pd else ACCELERATION) and k + 10 >= len(values)
            transfer.add(LAST_BLOCK if final else MORE, data)
    assert transfer.table is not None
    return transfer.table


# Plan of an operation of the PPMC-312: its acceleration and deceleration (P312-MOT-10..13).

TRAPEZOID, TRIANGLE, RIGHT_DOWN, RIGHT_UP = 0x00, 0x10, 0x20, 0x40


class Step(NamedTuple):
    """Pulse, and the interval that follows the pulse.

    Attributes:
        rate: length of the interval in ticks.
        stage: stage of the table, `None` at constant speed.
        planned: True if the pulse belongs to a planned final deceleration.
    """

    rate: int
    stage: int | None = None
    planned: bool = False


@dataclass(frozen=True)
class Plan:
    """Plan of an operation.

    Attributes:
        n: number of pulses, `None` for an endless operation.
        up: number of accelerating pulses at the beginning.
        down: number of decelerating pulses at the end.
        rate: constant rate between acceleration and deceleration.
        kind: status bits in the response to the start instruction.
    """

    table: Table
    rate: int
    n: int | None = None
    up: int = 0
    down: int = 0
    kind: int = TRAPEZOID

    def step(self, number: int) -> Step:
        """Return pulse `number`, 1 .. n (P312-MOT-12)."""
        table = self.table
        if number <= self.up:
            stage = bisect_left(table.sums_up, number)
            return Step(table.rates[stage], stage)
        if self.n is not None and number > self.n - self.down:
            stage = bisect_left(table.sums_down, self.n - number + 1)
            return Step(table.rates[stage], stage, True)
        return Step(self.rate)

    def steps(self) -> list[Step]:
        """Return all pulses of an undisturbed operation. Raises ValueError for an endless one."""
        if self.n is None:
            raise ValueError("endless operation")
        return [self.step(number) for number in range(1, self.n + 1)]


def constant(table: Table, rate: int, n: int | None = None) -> Plan:
    """Return a plan at constant speed, for instruction 83, 84, 86 or 10."""
    return Plan(table, rate, n)


def ramped(table: Table, rate: int, n: int | None) -> Plan:
    """Return a plan with ramps.

    Instruction 82 has n pulses. For instruction 85 and phase 1 of instruction 11, n is `None`.

    Args:
        rate: target rate.
    """
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
