"""Characters on a wire: 8 data bits, no parity, one stop bit, at a known rate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from .errors import CaptureError
from .signals import SECOND, Channel, numpy

if TYPE_CHECKING:
    from .signals import Column

GAP = 2.0
"""Shortest gap between two frames, in character times."""


class Character(NamedTuple):
    """Character on the wire.

    Attributes:
        begin: time in ps at which the start bit begins.
        end: time in ps at which the stop bit ends.
        byte: value of the character; `None` if its stop bit is missing.
    """

    begin: int
    end: int
    byte: int | None


def characters(channel: Channel, rate: float) -> list[Character]:
    """Return all characters on the wire. A start bit that is shorter than half a bit is ignored."""
    np = numpy()
    bit = SECOND / rate

    def sampled(begin: Column, bits: float) -> Column:
        return channel.at_all(np.rint(begin + bits * bit).astype(np.int64))

    falls = channel.times[channel.levels == 0]
    falls = falls[sampled(falls, 0.5) == 0]
    byte = falls & 0
    for place in range(8):
        byte |= sampled(falls, 1.5 + place).astype(np.int64) << place
    found: list[Character] = []
    free = 0
    for t, value, stop in zip(falls.tolist(), byte.tolist(), sampled(falls, 9.5).tolist(), strict=True):
        if t >= free:
            found.append(Character(t, round(t + 10 * bit), value if stop else None))
            free = round(t + 9.5 * bit)
    return found


def rate_of(channel: Channel, rates: Sequence[float], what: str) -> float:
    """Return the line rate, of `rates`, at which the largest fraction of the characters is correctly framed.

    Raises:
        CaptureError: no rate matches.
    """
    np = numpy()
    best, most = 0.0, 0.0
    for rate in rates:
        found = characters(channel, rate)
        if not found:
            continue
        bit = SECOND / rate
        # At the right rate, every change of the wire is near a boundary between two bits; at a wrong rate,
        # only few changes are near such a boundary.
        begin, end = (np.array([one[side] for one in found]) for side in (0, 1))
        place = begin.searchsorted(channel.times, "right") - 1
        inside = (place >= 0) & (channel.times < end[place] - bit / 2)
        bits = (channel.times[inside] - begin[place[inside]]) / bit
        near = (np.abs(bits - np.rint(bits)) < 0.25).mean() if len(bits) else 0.0
        good = sum(one.byte is not None for one in found) / len(found) * near
        # At a multiple of the right rate, all changes are near boundaries as well. Therefore, of two rates
        # that match equally well, the lower one is used.
        score = good if good > 0.95 else 0.0
        if score and (score > most + 0.02 or (score > most - 0.02 and rate < best)):
            best, most = rate, score
    if not best:
        speeds = ", ".join(f"{rate:.0f}" for rate in rates)
        raise CaptureError(f"{what}: no characters at {speeds} baud: is this the right pin, not inverted?")
    return best
