"""Times of a PPMC-104 in microseconds to parameter bytes and back, exactly. Pure."""

from __future__ import annotations

from fractions import Fraction

from ..basis.errors import OutOfRange
from ..basis.units import Number, exact, nearby


def chop_byte(xtal_hz: int, microseconds: Number, phase: str, vsel: int) -> tuple[int, Fraction]:
    """Parameter byte of the chopper nearest to a time, and the time it makes in us (P104-SW-04).

    phase: "on" or "off". Raises OutOfRange with the possible range.
    """
    quantum = Fraction(4_000_000, xtal_hz)
    offset = {("on", 1): 108, ("on", 0): 100, ("off", 1): 132, ("off", 0): 115}[phase, vsel] * quantum
    unit = 12 * quantum
    low, high = offset, offset + 255 * unit
    asked = exact(microseconds, f"{phase} time")
    if not low <= asked <= high:
        raise OutOfRange(
            f"{phase} time {nearby(microseconds)} us is outside {nearby(low)} to {nearby(high)} us"
        )
    byte = min(255, int((asked - offset) / unit + Fraction(1, 2)))
    return byte, offset + byte * unit
