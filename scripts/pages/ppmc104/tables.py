"""Computed tables of docs/ppmc104/: the speeds of the rates."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from scripts.pages.pictures.tables import interval_us, pps

RATES = (0, 1, 2, 3, 4, 7, 8, 9, 12, 13, 14, 17, 18, 19, 24, 29, 39, 49, 74, 99, 124, 149, 199, 249, 255)
PHASE_LIMIT_US = 37  # shortest interval of the old chip with phases (P104-DS-12)
POUT_LIMIT_US = 25  # the same with pulses only


def _cell(interval: Fraction) -> str:
    text = pps(interval)
    if interval < POUT_LIMIT_US:
        return f"**{text}** *"
    return f"**{text}**" if interval < PHASE_LIMIT_US else text


def speed_table() -> str:
    """Return a table of rates and pps for both internal base clocks and both levels of vsel."""
    lines = [
        "| R | hex | 500 kHz, `vsel` H | 500 kHz, `vsel` L | 125 kHz, `vsel` H | 125 kHz, `vsel` L |",
        "|---|---|---|---|---|---|",
    ]
    for rate in RATES:
        cells = [_cell(interval_us(rate, base, extra)) for base in (2, 8) for extra in (False, True)]
        lines.append(f"| {rate} | {rate:02X} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


TABLES: dict[str, Callable[[], str]] = {"speed-table": speed_table}
