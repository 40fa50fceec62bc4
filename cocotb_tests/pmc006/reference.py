"""Phase currents according to P006-EXC-10 to 23, calculated from the sine, as reference values."""

from __future__ import annotations

from math import floor, sin, tau

FULL_STEP = 128
"""Angle units per full step."""
HOME = 64
"""Angle after reset."""


def sines(angle: int, peak: int) -> tuple[int, int, int, int]:
    """Return reference and sign of phase A, then reference and sign of phase B, at an angle (512 units per
    electrical period, P006-EXC-10..12).
    """

    def one(units: int) -> tuple[int, int]:
        value = sin(tau * (units % 512) / 512)
        size = floor(256 * abs(value) + 0.5)
        return (size * peak + 128) >> 8, int(value < 0 and size > 0)

    return *one(angle + FULL_STEP), *one(angle)


def code(current: int) -> int:
    """Return the peak code of a current in mA.

    The current is rounded to the nearest value 400 + 150 k mA, ties up (P006-EXC-20).
    """
    nearest = min(range(400, 4001, 150), key=lambda drive: (abs(drive - current), -drive))
    return floor(255 * nearest / 4000 + 0.5)


def increment(microstepping: int) -> int:
    """Return the angle units per step (P006-EXC-01)."""
    return FULL_STEP // max(1, microstepping)


def boost(current: int, speed: int, microstepping: int, factor: int) -> int:
    """Return B, the current compensation, as an addend of the peak code (P006-EXC-22)."""
    return code(current) * factor * (speed // max(1, microstepping)) // 2**22


def lead(speed: int, microstepping: int, factor: int) -> int:
    """Return W, the lead angle, in angle units (P006-EXC-23)."""
    return min(64, factor * (speed // max(1, microstepping)) // 2**16)
