"""Pulses in a capture: trains of an axis, and the moves that they make."""

from __future__ import annotations

from dataclasses import dataclass

from .kind import Train, Wires
from .signals import SECOND, Channel, joined, level_at

CHOPPED = 20 * 10**9
"""ps; off-times of choppers are shorter."""


@dataclass(frozen=True)
class Move:
    """Pulses without a pause. way: 1 CW, -1 CCW, 0 unknown. begin, end: ps. first, highest, last: pps."""

    axis: int
    begin: int
    end: int
    way: int
    pulses: int
    first: float
    highest: float
    last: float


def runs(train: Train, pause: int) -> list[tuple[list[int], int | None]]:
    """Pulses without a pause (ps), one way."""
    found: list[tuple[list[int], int | None]] = []
    for t, way in zip(train.times, train.ways, strict=True):
        last = found[-1][0] if found else []
        slow = 5 * (last[-1] - last[-2]) // 2 if len(last) > 1 else 0
        if not last or t - last[-1] > max(pause, slow) or way != found[-1][1]:
            found.append(([], way))
        found[-1][0].append(t)
    return found


def moves(trains: list[Train], pause: int) -> list[Move]:
    """In the order of their beginnings. pause: ps, between two of them at least."""
    found = [_move(train.axis, *run) for train in trains for run in runs(train, pause)]
    return sorted(found, key=lambda move: move.begin)


def _move(axis: int, times: list[int], way: int | None) -> Move:
    speeds = [SECOND / (b - a) for a, b in zip(times, times[1:], strict=False)] or [0.0]
    sign = 0 if way is None else -1 if way else 1
    # One interval alone may be short by a sample: the median of three says how fast it was.
    smooth = [
        sorted(speeds[max(0, n - 1) : n + 2])[len(speeds[max(0, n - 1) : n + 2]) // 2]
        for n in range(len(speeds))
    ]
    return Move(axis, times[0], times[-1], sign, len(times), speeds[0], max(smooth), speeds[-1])


def edges_of(channel: Channel, level: int) -> list[int]:
    """Times at which a wire takes this level."""
    return [t for t, now in channel.changes if now == level]


def train(wires: Wires, axis: int, port: str, bit: int, level: int, way: str) -> Train | None:
    """Pulses that begin with `level` on a bit of a port, `way` 1 = CCW; None if that pin was not captured."""
    pulses = wires.bits.get(port, {}).get(bit)
    if pulses is None:
        return None
    direction = wires.bits.get(way, {}).get(bit)
    times = edges_of(pulses, level)
    ways = [None if direction is None else level_at(direction, t) for t in times]
    return Train(axis, times, ways)


def phase_train(wires: Wires, axis: int, port: str) -> Train | None:
    """Steps of phases that were captured whole. Wires change one after the other within a few samples: what
    they are 1 µs after a change is the pattern. All off or all on is the chopper."""
    phases = wires.ports.get(port)
    if phases is None:
        return None
    times: list[int] = []
    last: int | None = None
    full = (1 << phases.width) - 1
    settle = max(10**6, 3 * wires.sample)
    changes = phases.changes
    for number, (t, level) in enumerate(changes):
        if number + 1 < len(changes) and changes[number + 1][0] - t < settle:
            continue
        if level in (0, full) or level == last:
            continue
        if last is not None and (level ^ last) != full:
            times.append(t)
        last = level
    return Train(axis, times, [None] * len(times))


def unchopped(bits: dict[int, Channel], width: int, window: int) -> dict[int, Channel]:
    """Phases without the off-times of a chopper: all off for a while, then the pattern of before. Wires
    change one after the other within `window` ps. Without all wires: as they are."""
    if len(bits) < width:
        return bits
    whole = joined([bits[bit] for bit in range(width)])
    settled: list[tuple[int, int]] = []
    for t, level in whole.changes:
        if settled and t - settled[-1][0] <= window:
            settled[-1] = (settled[-1][0], level)
        else:
            settled.append((t, level))
    kept = Channel(whole.initial, [], width)
    off = (0, (1 << width) - 1)
    for number, (t, level) in enumerate(settled):
        pattern = kept.changes[-1][1] if kept.changes else kept.initial
        back = settled[number + 1] if number + 1 < len(settled) else (t, pattern)
        if level in off and back[1] == pattern and back[0] - t < CHOPPED:
            continue
        kept.add(t, level)
    return {bit: kept.bit(bit) for bit in range(width)}
