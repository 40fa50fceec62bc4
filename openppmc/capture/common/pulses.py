"""Pulses of an axis in a capture, and the moves that they form."""

from __future__ import annotations

from array import array
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain, pairwise
from typing import TYPE_CHECKING

from .part_decoder import PulseTrain, Wires
from .signals import SECOND, Bits, Channel, joined, level_code, level_type, numpy

if TYPE_CHECKING:
    from .signals import Column

CHOPPED = 20 * 10**9
"""Longest off-time of a chopper in ps, rounded up."""


@dataclass(frozen=True)
class Move:
    """A move: pulses without a pause between them.

    Attributes:
        way: direction of the move; 1 = CW, -1 = CCW, 0 = unknown.
        begin, end: times in ps.
        first, highest, last: first, highest and last speed of the move in pps.
    """

    axis: int
    begin: int
    end: int
    way: int
    pulses: int
    first: float
    highest: float
    last: float


def runs(train: PulseTrain, pause: int) -> list[tuple[Column, int | None]]:
    """Return groups of consecutive pulses in one direction, with no gap longer than `pause` ps."""
    np = numpy()
    times = train.times
    if not len(times):
        return []
    gaps = np.diff(times)
    split = gaps > pause
    if train.directions is not None:
        split |= train.directions[1:] != train.directions[:-1]
    # The intervals of slow pulses may be longer than `pause`. Therefore, an interval of at most 2.5 times the
    # previous interval does not end a group.
    last_split = -1
    for place in np.flatnonzero(split).tolist():
        turned = train.directions is not None and train.directions[place] != train.directions[place + 1]
        begun = last_split + 1
        if not turned and place > begun and gaps[place] <= 5 * gaps[place - 1] // 2:
            split[place] = False
        else:
            last_split = place
    bounds = [0, *(np.flatnonzero(split) + 1).tolist(), len(times)]
    return [
        (times[a:b], None if train.directions is None else int(train.directions[a]))
        for a, b in zip(bounds, bounds[1:], strict=False)
    ]


def moves(trains: list[PulseTrain], pause: int) -> list[Move]:
    """Return the moves in the order in which they begin.

    Args:
        pause: shortest time between two moves in ps.
    """
    found = [_move(train.axis, *run) for train in trains for run in runs(train, pause)]
    return sorted(found, key=lambda move: move.begin)


def _move(axis: int, times: Column, way: int | None) -> Move:
    np = numpy()
    sign = 0 if way is None else -1 if way else 1
    begin, end = int(times[0]), int(times[-1])
    gaps = np.diff(times)
    if not len(gaps):
        return Move(axis, begin, end, sign, len(times), 0.0, 0.0, 0.0)
    # Sampling may shorten an interval by one sample. Therefore, compute the median of each three successive
    # intervals; the highest speed is that of the shortest median.
    least = min(gaps[:2].min(), gaps[-2:].min())
    if len(gaps) > 2:
        a, b, c = gaps[:-2], gaps[1:-1], gaps[2:]
        least = min(least, np.maximum(np.minimum(a, b), np.minimum(np.maximum(a, b), c)).min())
    first, highest, last = (SECOND / int(gap) for gap in (gaps[0], least, gaps[-1]))
    return Move(axis, begin, end, sign, len(times), first, highest, last)


def edges_of(channel: Channel, level: int) -> Column:
    """Return the times at which a wire changes to this level."""
    times: Column = channel.times[channel.levels == level]
    return times


def train(wires: Wires, axis: int, port: str, bit: int, level: int, way: str) -> PulseTrain | None:
    """Return the pulses on a bit of a port; each pulse begins with a change to `level`.

    The result is `None` if that pin was not captured.

    Args:
        way: pin of the direction; its level 1 = CCW.
    """
    pulses = wires.bits.get(port, {}).get(bit)
    if pulses is None:
        return None
    direction = wires.bits.get(way, {}).get(bit)
    times = edges_of(pulses, level)
    return PulseTrain(axis, times, None if direction is None else direction.at_all(times))


def phase_train(wires: Wires, axis: int, port: str) -> PulseTrain | None:
    """Return the steps of an axis whose phases were all captured.

    The wires of a new pattern change one after the other within a few samples. Therefore, only levels that
    stay for 1 µs and three samples are a pattern. All phases off or all on is not a pattern, because the
    chopper causes it.
    """
    phases = wires.ports.get(port)
    if phases is None:
        return None
    np = numpy()
    full = (1 << phases.width) - 1
    settle = max(10**6, 3 * wires.sample)
    steady = np.ones(len(phases), bool)
    steady[:-1] = np.diff(phases.times) >= settle
    steady &= (phases.levels != 0) & (phases.levels != full)
    times, levels = phases.times[steady], phases.levels[steady]
    moved = np.zeros(len(times), bool)
    moved[1:] = (levels[1:] != levels[:-1]) & ((levels[1:] ^ levels[:-1]) != full)
    return PulseTrain(axis, times[moved], None)


def unchopped(bits: Mapping[int, Channel], width: int, window: int) -> Mapping[int, Channel]:
    """Return phases without the off-times of a chopper.

    During an off-time, all phases are off. Afterwards, the phases have the pattern that they had before.

    The wires of a new pattern change one after the other within `window` ps. If the wire of a phase was not
    captured, the phases are returned unchanged.
    """
    if len(bits) < width:
        return bits
    whole = joined([bits[bit] for bit in range(width)])
    times, levels = array("q"), array(level_code(width))
    pattern, off = whole.initial, (0, (1 << width) - 1)
    for one, after in pairwise(chain(_settled(whole, window), [None])):
        t, level = one or (0, 0)
        back, next_level = after or (t, pattern)
        if level in off and next_level == pattern and back - t < CHOPPED:
            continue
        if level != pattern:
            times.append(t)
            levels.append(level)
            pattern = level
    kept = Channel(whole.initial, width=width)
    np = numpy()
    kept.times, kept.levels = np.frombuffer(times, np.int64), np.frombuffer(levels, level_type(width))
    return Bits(kept)


def _settled(whole: Channel, window: int) -> Iterator[tuple[int, int]]:
    """Yield the changes of the phases. All changes within `window` ps after a change are combined with it."""
    begin, last = None, 0
    for t, level in whole:
        if begin is not None and t - begin > window:
            yield begin, last
            begin = None
        begin, last = t if begin is None else begin, level
    if begin is not None:
        yield begin, last
