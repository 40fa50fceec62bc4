"""Tables of rates that parts with a rate register share."""

from __future__ import annotations

from fractions import Fraction


def interval_us(rate: int, base_us: int, extra: bool) -> Fraction:
    """Return the interval in µs at a rate of 0…255 of an internal base clock (P104-INT-01, P104-INT-02)."""
    return (rate + 1) * base_us + (Fraction(15, 2) if extra else Fraction(0))


def pps(interval: Fraction) -> str:
    """Return the pulses per second at an interval in µs, as text."""
    speed = Fraction(1_000_000) / interval
    digits = 0 if speed >= 10_000 else 1
    return f"{float(speed):,.{digits}f}".replace(",", " ").removesuffix(".0")
