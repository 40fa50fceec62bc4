"""Channels of a logic analyser with their changes, in columns.

Times are whole ps from the first sample.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ...errors import needs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Column = NDArray[Any]

US = 1_000_000
"""Number of picoseconds in a microsecond."""
SECOND = 10**12
BLOCK = 1 << 16
"""Number of rows of a column that are processed together, so that temporary columns stay short."""


def numpy(what: str = "a capture") -> Any:
    """Return the numpy module. Raises MissingExtraError."""
    needs("decode", what, "numpy")
    import numpy as np

    return np


def level_type(width: int) -> str:
    """Return the numpy type of a level of `width` bits."""
    return "u1" if width <= 8 else "u2" if width <= 16 else "u4" if width <= 32 else "u8"


def level_code(width: int) -> str:
    """Return the type code of an array for a level of `width` bits."""
    return {"u1": "B", "u2": "H", "u4": "I", "u8": "Q"}[level_type(width)]


class Channel:
    """Changes of one wire, or of up to 64 wires as one number, in columns.

    Attributes:
        times: times of the changes in ps, int64, rising.
        levels: level after each change.
        initial: level before the first change.
        width: number of bits.
        unknown: mask of the bits that are unknown after each change; `None` if all levels are known.
        unknown_first: mask of the unknown bits of `initial`.
        indices: declared indices of the bits, lowest bit first.
    """

    __slots__ = ("indices", "initial", "levels", "times", "unknown", "unknown_first", "width")

    def __init__(
        self,
        initial: int = 0,
        changes: Sequence[tuple[int, int]] = (),
        width: int = 1,
        indices: range | None = None,
    ) -> None:
        np = numpy()
        self.initial, self.width = initial, width
        self.times: Column = np.array([t for t, _ in changes], np.int64)
        self.levels: Column = np.array([level for _, level in changes], level_type(width))
        self.unknown: Column | None = None
        self.unknown_first = 0
        self.indices = indices or range(width)

    @classmethod
    def of(
        cls,
        initial: int,
        times: Column,
        levels: Column,
        width: int = 1,
        unknown: Column | None = None,
        unknown_first: int = 0,
        indices: range | None = None,
    ) -> Channel:
        """Return a channel from columns.

        Levels may repeat. If several rows have the same time, only the last one is used.
        """
        np = numpy()
        one = cls(initial, (), width, indices)
        levels = levels.astype(level_type(width), copy=False)
        keep = np.ones(len(times), bool)
        if len(times) > 1:
            keep[:-1] = times[1:] != times[:-1]
            if not keep.all():
                times, levels = times[keep], levels[keep]
                unknown = None if unknown is None else unknown[keep]
        if len(times):
            keep = np.ones(len(times), bool)
            keep[1:] = levels[1:] != levels[:-1]
            keep[0] = int(levels[0]) != initial
            if unknown is not None:
                keep[1:] |= unknown[1:] != unknown[:-1]
                keep[0] |= int(unknown[0]) != unknown_first
            if not keep.all():
                times, levels = times[keep], levels[keep]
                unknown = None if unknown is None else unknown[keep]
        one.times, one.levels, one.unknown_first = times, levels, unknown_first
        one.unknown = unknown if unknown is not None and unknown.any() else None
        return one

    def __len__(self) -> int:
        return len(self.times)

    def __iter__(self) -> Iterator[tuple[int, int]]:
        """Yield the changes as (ps, level)."""
        for at in range(0, len(self), BLOCK):
            piece = self.times[at : at + BLOCK].tolist(), self.levels[at : at + BLOCK].tolist()
            yield from zip(*piece, strict=True)

    @property
    def changes(self) -> list[tuple[int, int]]:
        """Changes as (ps, level), for channels with few changes."""
        return list(self)

    @property
    def doubtful(self) -> bool:
        """True if any level is unknown."""
        return bool(self.unknown_first) or self.unknown is not None

    @property
    def blank(self) -> bool:
        """True if no level is known at all."""
        full = (1 << self.width) - 1
        return self.unknown_first == full and (
            not len(self) or (self.unknown is not None and bool((self.unknown == full).all()))
        )

    def bit(self, place: int) -> Channel:
        """Return one bit as a channel; 0 is the lowest bit."""
        if self.width == 1 and place == 0:
            return self
        levels = (self.levels >> self.levels.dtype.type(place)) & self.levels.dtype.type(1)
        unknown = self.unknown
        if unknown is not None:
            unknown = (unknown >> unknown.dtype.type(place)) & unknown.dtype.type(1)
        first = self.unknown_first >> place & 1
        if unknown is None and first:
            unknown = levels & 0
        return Channel.of(self.initial >> place & 1, self.times, levels, 1, unknown, first)

    def inverted(self) -> Channel:
        """Return the inverted channel."""
        flip = self.levels ^ 1
        return Channel.of(1 - self.initial, self.times, flip, 1, self.unknown, self.unknown_first)

    def settled(self, idle: int, hold: bool) -> Channel:
        """Return a channel without unknown levels.

        Each unknown level is replaced with `idle`, or with the last known level if `hold` is set.
        """
        if not self.doubtful:
            return self
        np = numpy()
        unknown = self.unknown if self.unknown is not None else self.levels & 0
        one = self.levels.dtype.type
        levels, last = self.levels.copy(), idle if self.unknown_first else self.initial
        first = last
        if hold and self.width == 1:
            place = np.where(unknown == 0, np.arange(len(levels)), -1)
            place = np.maximum.accumulate(place) if len(place) else place
            levels = np.where(place >= 0, levels[place], one(last)) if len(place) else levels
        else:
            levels = (levels & ~unknown) | (one(idle) & unknown)
        return Channel.of(first, self.times, levels, self.width)

    def at(self, t: int) -> int:
        """Return the level immediately after the changes at this time."""
        place = int(self.times.searchsorted(t, "right"))
        return int(self.levels[place - 1]) if place else self.initial

    def at_all(self, times: Column) -> Column:
        """Return the levels at several times."""
        np = numpy()
        if not len(self):
            one: Column = np.full(len(times), self.initial, self.levels.dtype)
            return one
        found: Column = np.empty(len(times), self.levels.dtype)
        for at in range(0, len(times), BLOCK):
            place = self.times.searchsorted(times[at : at + BLOCK], "right")
            piece = self.levels[np.maximum(place - 1, 0)]
            piece[place == 0] = self.initial
            found[at : at + BLOCK] = piece
        return found

    def since(self, t: int) -> tuple[Column, Column]:
        """Return times and levels of the changes from `t` on."""
        place = int(self.times.searchsorted(t, "left"))
        return self.times[place:], self.levels[place:]


@dataclass
class Capture:
    """A complete capture.

    Attributes:
        name: name of the file.
        end: time of the last sample.
        sample: sample period in ps if the file states it, else 0.
        part, parameters: part and parameters of the core; only files of this project contain them.
        doubled: names that several channels have.
        notes: remarks on the file for the user.
    """

    name: str
    channels: dict[str, Channel]
    end: int
    sample: int = 0
    part: str = ""
    parameters: dict[str, object] = field(default_factory=dict)
    doubled: frozenset[str] = frozenset()
    notes: list[str] = field(default_factory=list)

    @property
    def finest(self) -> int:
        """Sample period in ps.

        The value is the period that the file states. Otherwise, it is a common divisor of the times of all
        changes, or 0 if there are no changes.
        """
        if self.sample:
            return self.sample
        np = numpy()
        step = 0
        for one in self.channels.values():
            if not len(one) or step == 1:
                continue
            step = int(np.gcd(step, np.gcd.reduce(one.times[:1000])))
            for at in range(0, len(one), BLOCK):
                piece = one.times[at : at + BLOCK]
                if (piece % step).any():
                    step = int(np.gcd(step, np.gcd.reduce(piece)))
        return step


def without_glitches(channel: Channel, shortest: int) -> tuple[Channel, int]:
    """Return a wire without its pulses shorter than `shortest` ps, and the number of removed pulses.

    >>> wire, count = without_glitches(Channel(1, [(100, 0), (103, 1), (200, 0)]), 10)
    >>> wire.initial, wire.changes, count
    (1, [(200, 0)], 1)
    """
    np = numpy()
    if len(channel) < 2 or not (short := np.diff(channel.times) < shortest).any():
        return channel, 0
    # Process only groups of changes with short intervals between them; keep all other changes.
    keep = np.ones(len(channel), bool)
    times, dropped = channel.times, 0
    for place in np.flatnonzero(short & ~np.concatenate(([False], short[:-1]))).tolist():
        stack = [place]
        after = place + 1
        while after < len(times) and (after == place + 1 or short[after - 1]):
            if stack and times[after] - times[stack[-1]] < shortest:
                keep[stack.pop()] = keep[after] = False
                dropped += 1
            else:
                stack.append(after)
            after += 1
    kept = Channel(channel.initial)
    kept.times, kept.levels = times[keep], channel.levels[keep]
    return kept, dropped


def joined(bits: Sequence[Channel]) -> Channel:
    """Return a channel whose level is the number that these wires form, bit 0 first."""
    np = numpy()
    width = len(bits)
    if width == 1:
        return bits[0]
    kind = np.dtype(level_type(width)).type
    level = sum(bit.initial << place for place, bit in enumerate(bits))
    times, levels = array("q"), bytearray()
    for piece in slices([bit.times for bit in bits]):
        now = np.zeros(len(piece), kind)
        for place, bit in enumerate(bits):
            now |= bit.at_all(piece).astype(kind, copy=False) << kind(place)
        times.frombytes(piece.tobytes())
        levels += now.tobytes()
    whole = Channel(level, (), width)
    whole.times, whole.levels = np.frombuffer(times, np.int64), np.frombuffer(levels, kind)
    return whole


def slices(columns: Sequence[Column]) -> Iterator[Column]:
    """Yield all times of these columns in short sorted pieces without duplicates."""
    longest = max(columns, key=len)
    places = [0] * len(columns)
    for at in range(BLOCK, len(longest) + BLOCK, BLOCK):
        ends = [len(one) for one in columns]
        if at < len(longest):
            ends = [int(one.searchsorted(longest[at], "left")) for one in columns]
        parts = [one[a:b] for one, a, b in zip(columns, places, ends, strict=True)]
        places = ends
        yield moments(parts)


def moments(columns: Sequence[Column]) -> Column:
    """Return all times of these columns, sorted, without duplicates."""
    np = numpy()
    times: Column = np.concatenate([np.zeros(0, np.int64), *columns])
    times.sort(kind="stable")
    keep = np.ones(len(times), bool)
    np.not_equal(times[1:], times[:-1], out=keep[1:])
    times = times[keep]
    return times


class Bits(Mapping[int, Channel]):
    """Single bits of a port; the file contains the port as one number.

    Each bit is extracted when it is used.
    """

    def __init__(self, whole: Channel) -> None:
        self.whole = whole

    def __getitem__(self, place: int) -> Channel:
        if not 0 <= place < self.whole.width:
            raise KeyError(place)
        return self.whole.bit(place)

    def __iter__(self) -> Any:
        return iter(range(self.whole.width))

    def __len__(self) -> int:
        return self.whole.width


def level_at(channel: Channel, t: int) -> int:
    """Return the level immediately after the changes at this time."""
    return channel.at(t)


def merged(parts: Iterable[tuple[str, Channel]]) -> tuple[Column, Column, list[str]]:
    """Return the changes of all channels in order of time.

    The result consists of three items: the time of each change, the number of its channel, and the names of
    the channels by number.
    """
    np = numpy()
    rows = list(parts)
    times = np.concatenate([one.times for _, one in rows] or [np.zeros(0, np.int64)])
    owners = np.concatenate(
        [np.full(len(one), n, np.int16) for n, (_, one) in enumerate(rows)] or [np.zeros(0, np.int16)]
    )
    order = np.argsort(times, kind="stable")
    return times[order], owners[order], [name for name, _ in rows]
