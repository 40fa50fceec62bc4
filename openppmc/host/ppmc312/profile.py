"""Acceleration tables of the PPMC-312 from speeds in pulses per second: linear and sigmoid ones. Pure.

A speed is base clock / rate with 16-bit rates; a table has 127 of them, or up to 127 of a free curve.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import ceil

from ...model.ppmc312.stages import tables
from ...model.ppmc312.stages.tables import DIVIDERS, LEAST_PULSES, STAGES, SettingError, Table
from ..basis import units
from ..basis.errors import OutOfRange
from . import blocks
from .errors import refused

SLOWEST_RATE, FASTEST_RATE = 0xFFFF, 2
RISING = 6
MOST_HZ = 2_000_000


def base_clocks(xtal_hz: int) -> list[units.BaseClock]:
    """The internal base clocks, fastest first.

    >>> [float(clock.hertz) for clock in base_clocks(16_000_000)]
    [8000000.0, 1000000.0, 500000.0, 250000.0, 62500.0, 15625.0]
    >>> base_clocks(16_000_000)[1].choose(1000).rate
    1000
    """
    return [_clock(Fraction(divider, xtal_hz), clk) for clk, divider in DIVIDERS.items()]


def _clock(period: Fraction, clk: int, external: bool = False) -> units.BaseClock:
    return units.BaseClock(
        period,
        external=external,
        least_rate=FASTEST_RATE,
        beyond=0,
        slowest_rate=SLOWEST_RATE,
        clk=clk,
    )


def choose_clock(
    xtal_hz: int,
    slowest_pps: units.Number,
    base_clock: units.Number | None = None,
    external_clock: units.Number | None = None,
) -> units.BaseClock:
    """The base clock of a table; frequencies in Hz, None to take the fastest one that reaches the slowest
    speed: its speeds lie closest together. external_clock: at the pin extck, up to 2 MHz. OutOfRange."""
    if external_clock is not None:
        if not 0 < units.exact(external_clock, "external clock") <= MOST_HZ:
            raise OutOfRange(f"external clock {units.nearby(external_clock)} Hz is outside 0 to {MOST_HZ} Hz")
        return _clock(1 / Fraction(external_clock), RISING, external=True)
    clocks = base_clocks(xtal_hz)
    if base_clock is None:
        slowest = units.exact(slowest_pps, "start speed")
        return next((clock for clock in clocks if clock.slowest <= slowest), clocks[-1])
    for clock in clocks:
        if clock.hertz == units.exact(base_clock, "base clock"):
            return clock
    there = ", ".join(units.nearby(clock.hertz) for clock in clocks)
    raise OutOfRange(f"base clock {units.nearby(base_clock)} Hz: this part has {there} Hz")


@dataclass(frozen=True)
class Setup:
    """A table and its instruction blocks. start, stop, high: its end speeds as asked for and as reached."""

    clock: units.BaseClock = field(repr=False)
    start: units.Speed
    stop: units.Speed
    high: units.Speed
    table: Table = field(repr=False)
    shape: str

    def __str__(self) -> str:
        stop = f", stop {self.stop}, down {self.table.nd} pulses" if self.table.separate else ""
        ramp = f"{self.shape}{'' if self.shape == 'free curve' else ' ramp'} {self.ramp_pulses} pulses"
        return f"start {self.start}, high {self.high}, {ramp}{stop}, {self.clock}"

    @cached_property
    def blocks(self) -> list[bytes]:
        """What the part is told, in logical order."""
        table, clk = self.table, self.clock.clk
        if self.shape == "free curve":
            lists = [list(reversed(values)) for values in (table.rates, table.pa, table.pd)]
            rates, up, down = (
                values[: STAGES - first]
                for values, first in zip(lists, (table.first, table.sa, table.sd), strict=True)
            )
            return blocks.free_curve(clk, rates, up, down if table.separate else None)
        speeds, sigmoid = (self.start.rate, self.high.rate), self.shape == "sigmoid"
        if not table.separate:
            return [blocks.initial_setting(clk, *speeds, table.na, sigmoid=sigmoid)]
        return [blocks.initial_setting(clk, *speeds, table.na, self.stop.rate, table.nd, sigmoid)]

    @property
    def ramp_pulses(self) -> int:
        """Pulses of the acceleration."""
        return self.table.na

    def seconds(self, pulses: Sequence[int]) -> float:
        """Time of an acceleration or deceleration, table.pa or table.pd, in s."""
        ticks = sum(n * rate for n, rate in zip(pulses, self.table.rates, strict=True))
        return float(ticks * self.clock.period)

    def rate_of(self, pps: units.Number, what: str = "speed") -> int:
        """The rate of a speed that lies in the table. OutOfRange."""
        rate = self.clock.choose(pps, what).rate
        if not self.table.contains(rate):
            low, high = (
                units.nearby(self.clock.speed(rate)) for rate in (self.table.slowest, self.table.high)
            )
            raise OutOfRange(
                f"{what} {units.nearby(pps)} pps is outside {low} to {high} pps, the speeds of the table"
            )
        return rate


def plan_setup(
    clock: units.BaseClock,
    start_pps: units.Number,
    high_pps: units.Number,
    up: int,
    stop_pps: units.Number | None = None,
    down: int | None = None,
    sigmoid: bool = False,
) -> Setup:
    """A linear or sigmoid table. up, down: pulses of acceleration and deceleration, 24 bits; stop_pps and
    down default to start_pps and up. OutOfRange for what the part would refuse.

    >>> setup = plan_setup(base_clocks(16_000_000)[1], 1000, 5000, 2000)
    >>> setup.blocks[0].hex(" ")
    '03 09 00 01 03 e8 00 c8 00 07 d0'
    >>> plan_setup(base_clocks(16_000_000)[1], 1000, 5000, 761)
    Traceback (most recent call last):
    openppmc.host.basis.errors.OutOfRange: 761 pulses: the ramp is too short: each of its stages needs 2 \
pulses: 762 or more
    """
    separate = stop_pps is not None or down is not None
    start, high = clock.choose(start_pps, "start speed"), clock.choose(high_pps, "high speed")
    stop = start if stop_pps is None else clock.choose(stop_pps, "stop speed")
    down = up if down is None else down
    for pulses, what in ((up, "acceleration"), (down, "deceleration")):
        if not 1 <= pulses <= 0xFFFFFF:
            raise OutOfRange(f"{what} of {pulses} pulses is outside 1 to {0xFFFFFF}")
    numbers = (start.rate, stop.rate, high.rate)

    try:
        table = tables.build(*numbers, up, down, clock.clk, sigmoid, separate)
    except SettingError as error:
        text = str(refused(0xF0, bytes([error.number])))
        if error.number == 5:
            least = _least(numbers, sigmoid)
            which = f"{least[0]} up and {least[1]} down" if separate else f"{least[0]}"
            raise OutOfRange(f"{up} pulses: {text}: {which} or more") from None
        raise OutOfRange(f"start {start}, stop {stop}, high {high}: {text}") from None
    return Setup(clock, start, stop, high, table, "sigmoid" if sigmoid else "linear")


def _least(numbers: tuple[int, int, int], sigmoid: bool) -> list[int]:
    """Return the fewest pulses of acceleration and deceleration; 127 * (1 + Rs / RH) for all 127 stages.

    The slowest stage of a side has the smallest share, so it alone decides (P312-TBL-04, P312-TBL-05).
    """
    start, stop, high = numbers
    speeds = tables.speeds(max(start, stop), high, sigmoid)
    rates = [int(1 / speed + Fraction(1, 2)) for speed in speeds]
    firsts = (tables.first_stage(rates, slow) for slow in (start, stop))
    return [ceil(LEAST_PULSES * sum(speeds[first:]) / speeds[first]) for first in firsts]
