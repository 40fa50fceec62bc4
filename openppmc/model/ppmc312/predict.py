"""Prediction of one move of a PPMC-312 from its table: pulse times and speeds (P312-MOT-01, -10..12)."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate

from ..common.timebase import Timebase
from ..single.predict import Move
from .codes import FO, LE
from .stages.plan import constant, ramped
from .stages.tables import DIVIDERS, SettingError, Table, build


@dataclass(frozen=True)
class TableMove(Move):
    """Rates are in ticks of the base clock, `divider` crystal periods each; indices are stages of the table,
    None at constant speed; kind: status bits of the answer."""

    divider: int
    kind: int

    @property
    def speeds(self) -> list[float]:
        return [self.timebase.xtal_hz / (self.divider * rate) for rate in self.rates]


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
        tuple(timebase.cyc(divider * t) for t in ticks),
        tuple(step.stage for step in steps[:-1]),
        tuple(step.rate for step in steps[:-1]),
        divider,
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


def predict(
    init: bytes, n: int, rate: int | None, csel: int, vsel: int, timebase: Timebase | None
) -> TableMove:
    """See `single.predict.predict_move`; csel and vsel, which the part has not, are not looked at."""
    return predict_setting(init, n, rate, timebase)
