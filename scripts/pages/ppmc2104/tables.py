"""Computed tables of docs/ppmc2104/: the speeds of the rates, and the limits of the old chip."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from scripts.pages.pictures.tables import interval_us, pps

RATES = (1, 2, 3, 4, 5, 6, 8, 9, 11, 12, 17, 18, 20, 24, 25, 34, 35, 37, 49, 74, 99, 124, 199, 249, 255)
# Smallest rates of the PPMC-2104AFP at 500 and 125 kHz, the other axis stopped or operating (P2104-DS-30):
# P ramped moves in POUT mode, F moves with phases, O origin search.
LIMITS = {
    500: {"P1": 0x0C, "F1": 0x12, "O1": 0x14, "P2": 0x19, "F2": 0x23, "O2": 0x25},
    125: {"P1": 0x03, "F1": 0x04, "O1": 0x05, "P2": 0x06, "F2": 0x08, "O2": 0x09},
}


def _accepted(rate: int, limits: Mapping[str, int]) -> str:
    """Return the moves that the PPMC-2104AFP accepts at a rate."""
    found = [name for name, smallest in limits.items() if rate >= smallest]
    return "all" if len(found) == len(limits) else " ".join(found) or "none"


def speed_table() -> str:
    """Return a table of rates and pps for both internal base clocks, with the limits of the old chip."""
    lines = [
        "| R | hex | 500 kHz | DATASHEET | 125 kHz | DATASHEET |",
        "|---|---|---|---|---|---|",
    ]
    for rate in RATES:
        cells = [
            cell
            for khz, limits in LIMITS.items()
            for cell in (pps(interval_us(rate, 1000 // khz, False)), _accepted(rate, limits))
        ]
        lines.append(f"| {rate} | {rate:02X} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


TABLES: dict[str, Callable[[], str]] = {"speed-table": speed_table}
