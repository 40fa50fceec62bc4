"""Strobes on a parallel bus: when, which register, which byte."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from .kind import Access, Wires
from .signals import Channel, level_at

Strobe = Callable[[Mapping[str, int]], tuple[bool, bool]]
"""Whether these levels are a write strobe, a read strobe."""


def accesses(
    wires: Wires, pins: Sequence[str], address: str, idle: Mapping[str, int], strobes: Strobe, bus: str = "d"
) -> list[Access]:
    """All strobes of a capture, in order. pins: those that make a strobe. idle: levels of pins that were not
    captured. bus: name of the data. A strobe that the capture begins or ends in is left out."""
    data, where = _bus(wires, bus), wires.ports.get(address)
    channels = {pin: wires.ports[pin] for pin in pins if pin in wires.ports}
    levels = dict(idle) | {pin: channel.initial for pin, channel in channels.items()}
    events = sorted((t, pin, level) for pin, channel in channels.items() for t, level in channel.changes)
    found: list[Access] = []
    begun: int | None = None
    place = 0
    before = strobes(levels)
    while place < len(events):
        t = events[place][0]
        while place < len(events) and events[place][0] == t:
            levels[events[place][1]] = events[place][2]
            place += 1
        now = strobes(levels)
        if now == before:
            continue
        if any(before) and begun is not None:
            # What the bus had while the strobe was still there. Sampled wires that change together may be a
            # sample apart: before the last sample of the strobe, or in its middle if it is that short.
            seen = max((begun + t) // 2, t - wires.sample - 1)
            found.append(
                Access(
                    begun,
                    t,
                    before[0],
                    level_at(where, seen) if where else 0,
                    level_at(data[before[0]], seen),
                )
            )
        begun = t if any(now) else None
        before = now
    return found


def _bus(wires: Wires, bus: str) -> dict[bool, Channel]:
    """Data bus by direction, True = write: one bus of the chip, or two of the core."""
    if bus in wires.ports:
        return {True: wires.ports[bus], False: wires.ports[bus]}
    nothing = Channel()
    return {True: wires.ports.get(f"{bus}_i", nothing), False: wires.ports.get(f"{bus}_o", nothing)}
