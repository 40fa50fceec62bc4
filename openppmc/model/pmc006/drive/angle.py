"""Electrical angle and current references of the PMC006B4 (P006-EXC-01..03, -10..-15, -30)."""

from __future__ import annotations

from functools import lru_cache
from math import floor, pi, sin
from typing import NamedTuple

CYCLE, QUARTER = 512, 128
"""Number of angle units in an electrical cycle, and in a full step."""
HOME = 64
"""Angle after a reset."""
SCALE = 256


class Phase(NamedTuple):
    """Current reference of a phase.

    The magnitude is 0..255, where 255 means 4000 mA. The sign is 1 for a current from M11 to M10, or from M21
    to M20.
    """

    ref: int
    sign: int


class References(NamedTuple):
    """References of both phases."""

    a: Phase
    b: Phase


OFF = References(Phase(0, 0), Phase(0, 0))
WAVE = tuple(floor(SCALE * sin(2 * pi * unit / CYCLE) + 0.5) for unit in range(QUARTER + 1))
"""Quarter of the sine table, S[0..128]."""


def wave(unit: int) -> int:
    """Return the sine of an angle in units, as a signed number -256..256.

    The other quarters are calculated from this table by symmetry.
    """
    unit %= CYCLE
    if unit >= CYCLE // 2:
        return -wave(unit - CYCLE // 2)
    return WAVE[min(unit, CYCLE // 2 - unit)]


def reference(unit: int, peak: int) -> Phase:
    """Return the reference of a phase for an angle and a peak code of 0..255 (P006-EXC-12)."""
    height = wave(unit)
    return Phase((2 * abs(height) * peak + SCALE) // (2 * SCALE), int(height < 0))


@lru_cache(maxsize=1 << 14)
def references(angle: int, peak: int) -> References:
    """Return the references of both phases at an angle (P006-EXC-12, -14).

    The angle includes the lead angle.
    """
    return References(reference(angle + QUARTER, peak), reference(angle, peak))


def peak_code(base: int, added: int, busy: bool, decayed: bool, att: int) -> int:
    """Return the peak code RI (P006-EXC-30).

    Args:
        base: peak code without compensation.
        added: code that the current compensation adds.
        busy: level of BUSY.
        decayed: True after the idle timer has expired; at standstill, the code is then divided by 2^att.
        att: exponent of the division.
    """
    if busy:
        return min(255, base + added)
    return base // (1 << att) if decayed else base
