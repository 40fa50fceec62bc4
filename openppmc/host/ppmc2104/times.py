"""Times of a PPMC-2104 in microseconds to parameter bytes and back, exactly. Pure."""

from __future__ import annotations

from fractions import Fraction

from ..basis.errors import OutOfRange
from ..basis.units import Number, exact, nearby


def half_us_byte(xtal_hz: int, microseconds: Number, phase: str) -> tuple[int, Fraction]:
    """Parameter byte of the chopper nearest to a time, and the time it makes in us
    (P2104-AUX-04): 0.5 us a unit at 16 MHz, 64 to 255  Raises OutOfRange with the possible range."""
    unit = Fraction(8_000_000, xtal_hz)
    asked = exact(microseconds, f"{phase} time")
    low, high = 64 * unit, 255 * unit
    if not low <= asked <= high:
        raise OutOfRange(
            f"{phase} time {nearby(microseconds)} us is outside {nearby(low)} to {nearby(high)} us"
        )
    byte = int(asked / unit + Fraction(1, 2))
    return byte, byte * unit


def hold_byte(xtal_hz: int, microseconds: Number) -> tuple[int, Fraction]:
    """Parameter byte of the hold delay nearest to a time, and the time it makes in us
    (P2104-AUX-05): 128 to 32 768 us at 16 MHz. Raises OutOfRange with the possible range."""
    unit = Fraction(2048_000_000, xtal_hz)
    asked = exact(microseconds, "hold delay")
    if not unit <= asked <= 256 * unit:
        raise OutOfRange(
            f"hold delay {nearby(microseconds)} us is outside {nearby(unit)} to {nearby(256 * unit)} us"
        )
    byte = int(asked / unit + Fraction(1, 2)) - 1
    return byte, (byte + 1) * unit
