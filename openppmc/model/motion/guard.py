"""What ends or slows which operation: P104-LIM-02..06, P2104-LIM-02..07 and their tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from .codes import FINISH_ALARM, FINISH_LIMIT, ORIGIN


class GuardPins(NamedTuple):
    """Names of the active-low switches; pairs are (CW, CCW)."""

    limits: tuple[str, str]
    slow_limits: tuple[str, str]
    alarm: str
    origin: str

    @property
    def all(self) -> tuple[str, ...]:
        """All six names."""
        return (*self.limits, *self.slow_limits, self.alarm, self.origin)


class Seen(NamedTuple):
    """Causes active on an edge: `bits` are end-status bits of limit and alarm, `origin` counts for origin
    searches only, `slow` is the slow-down limit."""

    bits: int = 0
    origin: bool = False
    slow: bool = False

    @property
    def ends(self) -> bool:
        """Whether the motion ends now."""
        return bool(self.bits) or self.origin


def inspect(pins: GuardPins, levels: Mapping[str, int], operation: int, direction: int) -> Seen:
    """Judge the synchronised levels for an operation (low three code bits) and its direction."""
    bits = 0
    if not levels[pins.limits[direction]]:
        bits |= FINISH_LIMIT
    if not levels[pins.alarm]:
        bits |= FINISH_ALARM
    origin = operation == ORIGIN and not levels[pins.origin]
    return Seen(bits, origin, not levels[pins.slow_limits[direction]])


def input_register(levels: Mapping[str, int], bits: Mapping[int, str]) -> int:
    """Byte of the control input read: pin levels by bit number."""
    return sum(levels[pin] << bit for bit, pin in bits.items())
