"""Tables of the manual that are computed: the speeds of the rates."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

RATES = (0, 1, 2, 3, 4, 7, 8, 9, 12, 13, 14, 17, 18, 19, 24, 29, 39, 49, 74, 99, 124, 149, 199, 249, 255)
RATES_2104 = (1, 2, 3, 4, 5, 6, 8, 9, 11, 12, 17, 18, 20, 24, 25, 34, 35, 37, 49, 74, 99, 124, 199, 249, 255)
# Smallest rates of the PPMC-2104AFP at 500 and 125 kHz, the other axis at rest or operating (P2104-DS-30):
# P ramped moves in POUT mode, F moves with phases, O origin search.
LIMITS_2104 = {
    500: {"P1": 0x0C, "F1": 0x12, "O1": 0x14, "P2": 0x19, "F2": 0x23, "O2": 0x25},
    125: {"P1": 0x03, "F1": 0x04, "O1": 0x05, "P2": 0x06, "F2": 0x08, "O2": 0x09},
}
PHASE_LIMIT_US = 37  # shortest interval of the old chip with phases (P104-DS-12)
POUT_LIMIT_US = 25  # and with pulses only


def interval_us(rate: int, base_us: int, extra: bool) -> Fraction:
    """Interval in µs at a rate of 0…255 on an internal base clock (P104-INT-01, P104-INT-02)."""
    return (rate + 1) * base_us + (Fraction(15, 2) if extra else Fraction(0))


def _pps(interval: Fraction) -> str:
    pps = Fraction(1_000_000) / interval
    digits = 0 if pps >= 10_000 else 1
    return f"{float(pps):,.{digits}f}".replace(",", " ").removesuffix(".0")


def _cell(interval: Fraction) -> str:
    text = _pps(interval)
    if interval < POUT_LIMIT_US:
        return f"**{text}** *"
    return f"**{text}**" if interval < PHASE_LIMIT_US else text


def speed_table_104() -> str:
    """Markdown table: rate against pps for both internal base clocks and both levels of vsel."""
    lines = [
        "| R | hex | 500 kHz, `vsel` H | 500 kHz, `vsel` L | 125 kHz, `vsel` H | 125 kHz, `vsel` L |",
        "|---|---|---|---|---|---|",
    ]
    for rate in RATES:
        cells = [_cell(interval_us(rate, base, extra)) for base in (2, 8) for extra in (False, True)]
        lines.append(f"| {rate} | {rate:02X} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _accepted(rate: int, limits: Mapping[str, int]) -> str:
    """Moves that the PPMC-2104AFP accepts at a rate."""
    found = [name for name, smallest in limits.items() if rate >= smallest]
    return "all" if len(found) == len(limits) else " ".join(found) or "none"


def speed_table_2104() -> str:
    """Markdown table: rate against pps for both internal base clocks, and what the old chip allows there."""
    lines = [
        "| R | hex | 500 kHz | DATASHEET | 125 kHz | DATASHEET |",
        "|---|---|---|---|---|---|",
    ]
    for rate in RATES_2104:
        cells = [
            cell
            for khz, limits in LIMITS_2104.items()
            for cell in (_pps(interval_us(rate, 1000 // khz, False)), _accepted(rate, limits))
        ]
        lines.append(f"| {rate} | {rate:02X} | " + " | ".join(cells) + " |")
    return "\n".join(lines)
