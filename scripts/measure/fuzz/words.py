"""Characters of a line in the format of tb/fuzz/main.cpp: a word of 16 bits for each character."""

from __future__ import annotations

import random
from array import array
from collections.abc import Callable, Sequence

BROKEN, SILENCE = 0x100, 0x200
"""Flags of a word: a character without a stop bit; a long silence instead of a character."""
Frame = Callable[[random.Random], bytes]


def digest(data: bytes) -> int:
    """Return a digest of data bytes, 32 bits."""
    value = 0
    for byte in data:
        value = (value * 31 + byte + 1) & 0xFFFF_FFFF
    return value


def stream(rng: random.Random, size: int, good: Frame, special: Sequence[int]) -> array[int]:
    """Return at least `size` words: valid frames, frames with a fault, and noise.

    Args:
        special: characters with a meaning on this line; they are more frequent in noise.
    """
    words = array("H")
    while len(words) < size:
        line = list(_piece(rng, good, special))
        if rng.random() < 0.1:
            line.insert(rng.choice((rng.randint(0, len(line)), len(line))), SILENCE)
        if line and rng.random() < 0.06:
            line[rng.randrange(len(line))] |= BROKEN
        words.extend(line)
    return words


def _piece(rng: random.Random, good: Frame, special: Sequence[int]) -> bytes:
    """Return a valid frame, a frame with a fault, noise, or two pieces of frames."""
    kind = rng.random()
    if kind < 0.35:
        return good(rng)
    if kind < 0.75:
        return _spoilt(rng, good(rng), special)
    if kind < 0.85:
        return rng.randbytes(rng.randint(1, 24))
    if kind < 0.97:
        return bytes(rng.choices(special, k=rng.randint(1, 24)))
    first, second = good(rng), good(rng)
    return first[: rng.randint(0, len(first))] + second[rng.randint(0, len(second)) :]


def _spoilt(rng: random.Random, frame: bytes, special: Sequence[int]) -> bytes:
    """Return a frame with one fault: a changed bit or byte, a missing, repeated or added byte, or no end."""
    place = rng.randrange(len(frame))
    before, byte, after = frame[:place], frame[place], frame[place + 1 :]
    kind = rng.randrange(6)
    if kind == 0:
        return before + bytes([byte ^ 1 << rng.randrange(8)]) + after
    if kind == 1:
        return before + bytes([rng.choice(special)]) + after
    if kind == 2:
        return before + after
    if kind == 3:
        return before + bytes([byte, byte]) + after
    if kind == 4:
        return before + bytes([rng.choice(special), byte]) + after
    return before
