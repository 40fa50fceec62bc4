"""Prediction of one move of a PPMC-312 from its table: pulse times and speeds (P312-MOT-01, -10..12)."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate

from ..common.timebase import Timebase
from .codes import FO, LE
from .stages.plan import constant, ramped
from .stages.tables import DIVIDERS, SettingError, Table, build


@dataclass(frozen=True)
class TableMove:
    """A predicted move. `clk[j]` is pulse j+1 in clk after pulse 1; `rates[j]` in ticks and `indices[j]`
    (table stage, None at constant speed) belong to the interval that follows it; kind: status bits of the
    answer."""

    timebase: Timebase
    divider: int
    clk: tuple[int, ...]
    indices: tuple[int | None, ...]
    rates: tuple[int, ...]
    kind: int

    @property
    def seconds(self) -> list[float]:
        """Pulse times in s after pulse 1."""
        return [self.timebase.seconds(t) for t in self.clk]

    @property
    def speeds(self) -> list[float]:
        """Speed of each interval in pulses per second."""
        return [self.timebase.xtal_hz / (self.divider * rate) for rate in self.rates]

    @property
    def intervals(self) -> list[int]:
        """Length of each interval between two pulses in clk."""
        return [b - a for a, b in zip(self.clk, self.clk[1:], strict=False)]


def predict_table(
    table: Table, n: int, rate: int = 0, flat: bool = False, timebase: Timebase | None = None
) -> TableMove:
    """Undisturbed move of n pulses with an internal base clock.

    rate: speed aimed at, 0 for the high speed. flat: without ramps (83). Raises ValueError for a base clock
    from outside, a rate outside the table and n outside 1..2^32-1.
    """
    timebase = timebase or Timebase()
    if table.clk not in DIVIDERS:
        raise ValueError("the base clock comes from outside")
    rate = rate or table.high
    if not table.contains(rate):
        raise ValueError(f"rate {rate} is outside {table.high} to {table.slowest}")
    if not 1 <= n < 1 << 32:
        raise ValueError(f"{n} pulses")
    plan = constant(table, rate, n) if flat else ramped(table, rate, n)
    steps = plan.steps()
    divider = DIVIDERS[table.clk]
    ticks = accumulate((step.rate for step in steps[:-1]), initial=0)
    return TableMove(
        timebase,
        divider,
        tuple(timebase.cyc(divider * t) for t in ticks),
        tuple(step.stage for step in steps[:-1]),
        tuple(step.rate for step in steps[:-1]),
        plan.kind,
    )


def predict_setting(
    parameters: bytes, n: int, rate: int | None = None, timebase: Timebase | None = None
) -> TableMove:
    """The same from the parameters of an initial setting (8 or 13 bytes after its code); rate: of a move at
    constant speed, None for one with ramps. Raises ValueError for what the part refuses."""
    if len(parameters) not in (8, 13):
        raise ValueError(f"an initial setting has 8 or 13 parameters, not {len(parameters)}")
    flags, separate = parameters[0], bool(parameters[0] & LE)
    widths = (2, 2, 2, 3, 3) if len(parameters) == 13 else (2, 2, 3)
    values, at = [], 1
    for width in widths:
        values.append(int.from_bytes(parameters[at : at + width], "big"))
        at += width
    if len(values) == 3:
        if separate:
            raise ValueError("a deceleration of its own needs 13 parameters")
        start, high, na = values
        stop, nd = start, na
    else:
        start, stop, high, na, nd = values
    try:
        table = build(start, stop, high, na, nd, flags & 7, bool(flags & FO), separate)
    except SettingError as error:
        raise ValueError(f"refused setting: {error}") from None
    return predict_table(table, n, rate or 0, rate is not None, timebase)
