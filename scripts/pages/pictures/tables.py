"""Kinds of tables that parts share, and their formats."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from scripts.markdown import table

Entry = Mapping[str, Any]


def spaced(value: float, digits: int = 0) -> str:
    """Return a number as text, with spaces between thousands and without zeros at the end of its decimals."""
    text = f"{value:,.{digits}f}".replace(",", " ")
    return text.rstrip("0").rstrip(".") if digits else text


def _cell(rate: int, us: Fraction, column: Entry) -> list[str]:
    """Return the cells of a rate: its speed, marked if the interval is short, and moves that permit it."""
    speed = 1_000_000 / us
    text = spaced(float(speed), column.get("digits", 0 if speed >= 10_000 else 1))
    text = next((mark.format(text) for limit, mark in column.get("marks", {}).items() if us < limit), text)
    if "limits" not in column:
        return [text]
    names = [name for name, smallest in column["limits"].items() if rate >= smallest]
    return [text, "all" if len(names) == len(column["limits"]) else " ".join(names) or "none"]


def speeds(heads: Sequence[str], rates: Sequence[int], columns: Sequence[Entry], offset: int = 1) -> str:
    """Return a table of rates or divisors with the pulses per second at several clocks.

    The length of an interval is (rate + `offset`) * `us` + `extra` µs.

    Args:
        columns: each with `us`, `extra`, `digits`, `marks` (for an interval in µs, the format of speeds with
            shorter intervals) and `limits` (for the name of a kind of move, its smallest rate).
    """
    rows = []
    for rate in rates:
        cells = []
        for column in columns:
            us = (rate + offset) * Fraction(column["us"]) + Fraction(column.get("extra", 0))
            cells += _cell(rate, us, column)
        rows.append([rate, f"{rate:02X}", *cells])
    return table(heads, rows)
