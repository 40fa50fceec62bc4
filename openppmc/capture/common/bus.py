"""Strobes on a parallel bus: when, which register, which byte."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from .kind import Access, Wires
from .signals import Channel, numpy

Strobe = Callable[[Mapping[str, int]], tuple[bool, bool]]
"""Whether these levels are a write strobe, a read strobe."""


def accesses(
    wires: Wires, pins: Sequence[str], address: str, idle: Mapping[str, int], strobes: Strobe, bus: str = "d"
) -> list[Access]:
    """All strobes of a capture, in order. pins: those that make a strobe. idle: levels of pins that were not
    captured. bus: name of the data. A strobe that the capture begins or ends in is left out."""
    np = numpy()
    data, where = _bus(wires, bus), wires.ports.get(address)
    channels = {pin: wires.ports[pin] for pin in pins if pin in wires.ports}
    moments = np.unique(np.concatenate([np.zeros(0, np.int64), *(one.times for one in channels.values())]))
    # Each combination of levels is decoded once: it is a number with the levels of one pin after the other.
    number = np.zeros(len(moments), np.int64)
    start = 0
    bases = {}
    base = 1
    for pin, channel in channels.items():
        number += channel.at_all(moments).astype(np.int64) * base
        start += channel.initial * base
        bases[pin] = base
        base <<= channel.width

    def kind(value: int) -> int:
        levels = {pin: value // bases[pin] & (1 << one.width) - 1 for pin, one in channels.items()}
        write, read = strobes({**idle, **levels})
        return int(write) | int(read) << 1

    values, back = np.unique(number, return_inverse=True)
    kinds = np.array([kind(value) for value in values.tolist()], np.int8)[back.reshape(-1)]
    before = np.concatenate((np.array([kind(start)], np.int8), kinds[:-1])) if len(kinds) else kinds
    turns = np.flatnonzero(kinds != before)
    times, kinds = moments[turns], kinds[turns]
    whole = np.flatnonzero(kinds[:-1] != 0)
    begin, end, write = times[whole], times[whole + 1], kinds[whole] & 1
    # What the bus had while the strobe was still there. Sampled wires that change together may be a sample
    # apart: before the last sample of the strobe, or in its middle if it is that short.
    seen = np.maximum((begin + end) // 2, end - wires.sample - 1)
    place = where.at_all(seen) if where else seen & 0
    byte = np.where(write == 1, data[True].at_all(seen), data[False].at_all(seen))
    columns = (begin.tolist(), end.tolist(), (write == 1).tolist(), place.tolist(), byte.tolist())
    return [Access(*row) for row in zip(*columns, strict=True)]


def _bus(wires: Wires, bus: str) -> dict[bool, Channel]:
    """Data bus by direction, True = write: one bus of the chip, or two of the core."""
    if bus in wires.ports:
        return {True: wires.ports[bus], False: wires.ports[bus]}
    nothing = Channel()
    return {True: wires.ports.get(f"{bus}_i", nothing), False: wires.ports.get(f"{bus}_o", nothing)}
