"""Characters as levels of a line: start bit, eight data bits, stop bit, at any speed."""

from __future__ import annotations

from math import ceil

Wave = list[tuple[int, int]]
"""Changes of a line that is high at the beginning and at the end: (edge, level from this edge on)."""


def wave(data: bytes, start: float, bit: float, gap: float = 0.0) -> Wave:
    """Return the levels of characters from time `start` on, each followed by `gap` idle bits.

    All times are in cycles.
    """
    changes: Wave = []
    level, at = 1, start
    for byte in data:
        for number, bit_level in enumerate((0, *(byte >> place & 1 for place in range(8)), 1)):
            if bit_level != level:
                level = bit_level
                changes.append((ceil(at + number * bit), level))
        at += (10 + gap) * bit
    return changes


def length(data: bytes, bit: float, gap: float = 0.0) -> float:
    """Return the duration of characters in cycles."""
    return len(data) * (10 + gap) * bit


def merged(*waves: Wave) -> Wave:
    """Return the levels of a line with several drivers, which is low while any of them is low."""
    changes: Wave = []
    levels = [1] * len(waves)
    for t, number, level in sorted((t, i, level) for i, one in enumerate(waves) for t, level in one):
        before = min(levels)
        levels[number] = level
        if min(levels) == before:
            continue
        if changes and changes[-1][0] == t:
            changes.pop()  # a low pulse of length 0
        else:
            changes.append((t, min(levels)))
    return changes
