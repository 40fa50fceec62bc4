"""Strobes on a parallel bus: time, register and byte of each access."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Mapping, Sequence

from .part_decoder import Accesses, Wires
from .signals import Channel, numpy, slices

Strobe = Callable[[Mapping[str, int]], tuple[bool, bool]]
"""Function that returns, for levels of the pins, (True for a write strobe, True for a read strobe)."""


def accesses(
    wires: Wires, pins: Sequence[str], address: str, idle: Mapping[str, int], strobes: Strobe, bus: str = "d"
) -> Accesses:
    """Return all strobes of a capture in order.

    An incomplete strobe at the beginning or the end of the capture is omitted.

    Args:
        pins: pins whose levels form a strobe.
        idle: levels of pins that were not captured.
        bus: name of the data bus.
    """
    np = numpy()
    data, where = _bus(wires, bus), wires.ports.get(address)
    channels = {pin: wires.ports[pin] for pin in pins if pin in wires.ports}
    # `number` holds the levels of all pins. Each of its values is decoded only once.
    places: dict[str, int] = {}
    width = start = 0
    for pin, channel in channels.items():
        places[pin] = width
        start |= channel.initial << width
        width += channel.width

    def kind(value: int) -> int:
        levels = {pin: value >> places[pin] & (1 << one.width) - 1 for pin, one in channels.items()}
        write, read = strobes({**idle, **levels})
        return int(write) | int(read) << 1

    known: dict[int, int] = {}
    table = np.zeros(1 << width, np.int8)
    last = kind(start)
    found = [array(code) for code in "qqBBB"]
    before = np.zeros(0, np.int64)
    for times in slices([one.times for one in channels.values()] or [np.zeros(0, np.int64)]):
        number = np.zeros(len(times), np.uint16)
        for pin, channel in channels.items():
            number |= channel.at_all(times).astype(np.uint16) << np.uint16(places[pin])
        for value in np.flatnonzero(np.bincount(number)).tolist():
            if value not in known:
                known[value] = table[value] = kind(value)
        kinds = table[number]
        turn = np.empty(len(kinds), bool)
        turn[:1], turn[1:] = kinds[:1] != last, kinds[1:] != kinds[:-1]
        last = int(kinds[-1]) if len(kinds) else last
        # The two lowest bits of an entry contain the kind of the strobe; all higher bits contain its time.
        turned = np.concatenate((before, times[turn] << 2 | kinds[turn]))
        before = turned[-1:]
        whole = np.flatnonzero(turned[:-1] & 3)
        begin, end, write = turned[whole] >> 2, turned[whole + 1] >> 2, turned[whole] & 1 == 1
        # Sample the bus while the strobe is still active. Wires that change together may be captured one
        # sample apart. Therefore, use the byte just before the last sample of the strobe. If the middle of
        # the strobe is later, use the byte in the middle.
        seen = np.maximum((begin + end) // 2, end - wires.sample - 1)
        place = where.at_all(seen) if where else seen & 0
        byte = np.where(write, data[True].at_all(seen), data[False].at_all(seen))
        parts = begin, end, write, place.astype(np.uint8), byte.astype(np.uint8)
        for column, part in zip(found, parts, strict=True):
            column.frombytes(part.tobytes())
    kinds = ("i8", "i8", "?", "u1", "u1")
    return Accesses(*map(np.frombuffer, found, kinds))


def _bus(wires: Wires, bus: str) -> dict[bool, Channel]:
    """Return the channel of the data bus for writes (key True) and for reads (key False).

    The chip uses one bus for both, the core has a separate bus for each.
    """
    if bus in wires.ports:
        return {True: wires.ports[bus], False: wires.ports[bus]}
    nothing = Channel()
    return {True: wires.ports.get(f"{bus}_i", nothing), False: wires.ports.get(f"{bus}_o", nothing)}
