"""What a logic analyser has seen: channels with their changes. Times are whole picoseconds from its start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import gcd

from ...check import records

US = 1_000_000
"""Picoseconds of a microsecond."""
SECOND = 10**12
Changes = list[tuple[int, int]]


@dataclass
class Channel:
    """A wire, or several that a file has as one number. initial: level before the first change (ps, level).
    width: bits."""

    initial: int = 0
    changes: Changes = field(default_factory=list)
    width: int = 1

    def add(self, t: int, level: int) -> None:
        """A level from `t` on; the same level again is no change."""
        before = self.changes[-1][1] if self.changes else self.initial
        if level == before:
            return
        if self.changes and self.changes[-1][0] == t:
            self.changes.pop()
            self.add(t, level)
        else:
            self.changes.append((t, level))

    def bit(self, place: int) -> Channel:
        """One bit of it."""
        one = Channel(self.initial >> place & 1)
        for t, level in self.changes:
            one.add(t, level >> place & 1)
        return one


@dataclass
class Capture:
    """A whole capture. name: of the file. end: time of the last sample. sample: distance of two samples if
    the file tells it, else 0. part, parameters: of the core, where the file tells them (ours do)."""

    name: str
    channels: dict[str, Channel]
    end: int
    sample: int = 0
    part: str = ""
    parameters: dict[str, object] = field(default_factory=dict)

    @property
    def finest(self) -> int:
        """Distance of two samples, as the file tells it or as all changes are multiples of it, ps; 0: no
        changes."""
        return self.sample or gcd(*(t for one in self.channels.values() for t, _ in one.changes))


def without_glitches(channel: Channel, shortest: int) -> tuple[Channel, int]:
    """The channel without pulses shorter than `shortest` ps, and how many there were.

    >>> without_glitches(Channel(1, [(100, 0), (103, 1), (200, 0)]), 10)
    (Channel(initial=1, changes=[(200, 0)], width=1), 1)
    """
    kept: Changes = []
    dropped = 0
    for t, level in channel.changes:
        if (
            kept
            and t - kept[-1][0] < shortest
            and (kept[-2][1] if len(kept) > 1 else channel.initial) == level
        ):
            kept.pop()
            dropped += 1
        else:
            kept.append((t, level))
    return Channel(channel.initial, kept, channel.width), dropped


def level_at(channel: Channel, t: int) -> int:
    """Level at a time, changes at that time included."""
    return records.level_at(channel.changes, t, channel.initial)


def joined(bits: Sequence[Channel]) -> Channel:
    """Wires as one number, bit 0 first."""
    level = sum(bit.initial << place for place, bit in enumerate(bits))
    whole = Channel(level, [], len(bits))
    events = sorted((t, place, one) for place, bit in enumerate(bits) for t, one in bit.changes)
    for t, place, one in events:
        level = level & ~(1 << place) | one << place
        whole.add(t, level)
    return whole
