"""Characters on a wire: 8 data bits, no parity, one stop bit, at a known rate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from .errors import CaptureError
from .signals import SECOND, Channel, level_at

GAP = 2.0
"""Characters that are farther apart belong to different frames, in characters."""


class Character(NamedTuple):
    """begin: ps of the start bit, end: of the stop bit. byte: None without a stop bit."""

    begin: int
    end: int
    byte: int | None


def characters(channel: Channel, rate: float) -> list[Character]:
    """All characters; a start bit shorter than half a bit is none."""
    bit = SECOND / rate
    found: list[Character] = []
    free = 0
    for t, level in channel.changes:
        if level or t < free or level_at(channel, round(t + bit / 2)):
            continue
        byte = sum(level_at(channel, round(t + (1.5 + place) * bit)) << place for place in range(8))
        stop = level_at(channel, round(t + 9.5 * bit))
        found.append(Character(t, round(t + 10 * bit), byte if stop else None))
        free = round(t + 9.5 * bit)
    return found


def rate_of(channel: Channel, rates: Sequence[float], what: str) -> float:
    """The rate whose characters fit best: start and stop bits where they must be. CaptureError if none."""
    best, most = 0.0, 0.0
    for rate in rates:
        found = characters(channel, rate)
        if not found:
            continue
        bit = SECOND / rate
        # Every change lies near a border of a bit; at a wrong rate few do.
        near = edges = 0
        place = 0
        for one in found:
            while place < len(channel.changes) and channel.changes[place][0] < one.begin:
                place += 1
            at = place
            while at < len(channel.changes) and channel.changes[at][0] < one.end - bit / 2:
                bits = (channel.changes[at][0] - one.begin) / bit
                near += abs(bits - round(bits)) < 0.25
                edges += 1
                at += 1
        good = sum(one.byte is not None for one in found) / len(found) * near / max(1, edges)
        # Slower rates swallow whole characters: the number of characters decides between those that fit.
        score = good if good > 0.95 else 0.0
        if score and (score > most + 0.02 or (score > most - 0.02 and rate < best)):
            best, most = rate, score
    if not best:
        speeds = ", ".join(f"{rate:.0f}" for rate in rates)
        raise CaptureError(f"{what}: no characters at {speeds} baud: is this the right pin, not inverted?")
    return best
