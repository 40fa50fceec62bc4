"""A recording as a list of acts: what may be left out of it as a whole, and what it is in words.

An act is one access on the host's bus with all its pin changes, one run of characters on a serial line, one
reset, some periods of a clock, or one change of any other pin. Each stands for itself: whatever is left out
before it, the bus has its address and data, and of a port only the bits that the act moves change.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise
from typing import NamedTuple

from .part import Part, recorded
from .stimulus import Access, Change, Recording, bit_changes

LINE = "rxd"
BUSY = 64
"""A pin that changes more often is a clock; its periods are acts in groups, about so many in all."""


class Step(NamedTuple):
    """From edge `t` on the bits of `mask` of a port have the levels of `value`."""

    t: int
    port: str
    mask: int
    value: int


@dataclass(frozen=True)
class Act:
    """`what` says it in words, without the time. access: what the host's log says of it, if it is one."""

    what: str
    steps: tuple[Step, ...]
    access: Access | None = None

    @property
    def kind(self) -> str:
        """Register and direction of an access, name of a pin, "frame", "reset"."""
        return f"{self.access.kind} {self.access.reg}" if self.access else self.what.split()[0]

    @property
    def reads(self) -> bool:
        """Whether it is a read access."""
        return self.access is not None and self.access.kind.endswith("read")

    @property
    def begin(self) -> int:
        """Edge of its first pin change."""
        return self.steps[0].t

    @property
    def end(self) -> int:
        """Edge of its last one."""
        return self.steps[-1].t

    def moved(self, clk: int) -> Act:
        """The same so many clk later."""
        access = self.access and self.access._replace(t=self.access.t + clk)
        return Act(self.what, tuple(step._replace(t=step.t + clk) for step in self.steps), access)

    def __str__(self) -> str:
        return f"{self.what} at {self.begin}"


def acts_of(recording: Recording) -> list[Act]:
    """All that was done, in order of time."""
    part = recorded(recording.part, recording.params)
    bus = part.bus_pins - {LINE}
    changes = recording.stimulus
    others: dict[str, list[tuple[int, int]]] = {}
    for change in changes:
        if change.pin not in bus:
            others.setdefault(change.pin, []).append((change.t, change.value))
    found = list(_on_the_bus(part, bus, [c for c in changes if c.pin in bus], recording.accesses))
    for port, rows in others.items():
        if port == LINE:
            found += _on_the_line(rows)
        elif port == "rst_n":
            found += _resets(rows)
        else:
            found += _on_a_port(part, port, rows)
    return sorted(found, key=lambda act: (act.begin, act.end))


def changes_of(part: Part, acts: Iterable[Act]) -> list[Change]:
    """The pin changes of some acts; none that changes nothing."""
    levels, changes = {**part.inputs, "rst_n": 1}, []
    for t, port, mask, value in sorted((step for act in acts for step in act.steps), key=lambda step: step.t):
        level = levels[port] & ~mask | value
        if level != levels[port]:
            levels[port] = level
            changes.append(Change(t, port, level))
    return changes


# ---------------------------------------------------------------------- the host's bus


def _on_the_bus(
    part: Part, bus: Iterable[str], changes: Sequence[Change], accesses: Iterable[Access]
) -> Iterator[Act]:
    """Accesses, good and bad ones: each ends when all strobes are off."""
    strobes = {pin for pin in bus if part.inputs[pin] and part.width(pin) == 1 and pin != "cs_n"}
    levels = {pin: part.inputs[pin] for pin in sorted(bus)}
    done = {access.t: access for access in accesses}
    steps: list[Step] = []
    struck = False
    for t, group in groupby(changes, key=lambda change: change.t):
        if not steps:
            steps = [_whole(part, t, pin, level) for pin, level in levels.items()]
        for change in group:
            levels[change.pin] = change.value
            steps.append(_whole(part, *change))
        off = all(levels[pin] for pin in strobes)
        struck |= not off
        if off and struck:
            yield _access(steps, done)
            steps, struck = [], False
    if steps:
        yield _access(steps, done)


def _whole(part: Part, t: int, pin: str, level: int) -> Step:
    return Step(t, pin, (1 << part.width(pin)) - 1, level)


def _access(steps: list[Step], done: dict[int, Access]) -> Act:
    access = next((done[step.t] for step in steps if step.t in done), None)
    if access is None:
        moved = {step.port: None for step in steps if not step.port.startswith("d")}
        return Act(f"{', '.join(moved)} without an access", tuple(steps))
    if access.kind == "write":
        what = f"write {'C' if access.reg else 'D'} {access.byte:02X}"
    elif access.kind == "read":
        what = f"read {'status' if access.reg else 'data'}"
    elif access.kind.endswith("read"):
        what = access.kind
    else:
        what = f"{access.kind} {access.byte:02X}"
    return Act(what, tuple(steps), access)


# ---------------------------------------------------------------------- a serial line


def _on_the_line(rows: Sequence[tuple[int, int]]) -> Iterator[Act]:
    """Runs of characters: the line rests behind each, for longer than a character of ones lasts."""
    bit = _bit(rows)
    run: list[tuple[int, int]] = []
    for t, level in rows:
        if run and run[-1][1] and t - run[-1][0] > 11 * bit:
            yield _frame(run, bit)
            run = []
        run.append((t, level))
    if run:
        yield _frame(run, bit)


def _bit(rows: Sequence[tuple[int, int]]) -> int:
    """clk of a bit: the longest time between two changes of which most others are multiples, nearly."""
    lengths = Counter(b - a for (a, _), (b, _) in pairwise(rows))

    def fitting(bit: int) -> int:
        whole = {length: round(length / bit) for length in lengths}
        near = (d for d, bits in whole.items() if 0 < bits < 11 and abs(d - bit * bits) * 10 <= bit)
        return sum(lengths[length] for length in near)

    often = sorted((length for length, _ in lengths.most_common(40)), reverse=True)
    return max(often, key=fitting, default=1)


def _frame(run: Sequence[tuple[int, int]], bit: int) -> Act:
    return Act(f"frame {_characters(run, bit)}", tuple(Step(t, LINE, 1, level) for t, level in run))


def _characters(run: Sequence[tuple[int, int]], bit: int) -> str:
    """The bytes as a receiver would read them in the middle of their bits."""
    found, free = [], 0
    for start, level in run:
        if level or start < free:
            continue
        free = start + 19 * bit // 2
        middles = [start + (2 * place + 3) * bit // 2 for place in range(8)]
        read = [next(value for t, value in reversed(run) if t <= middle) for middle in middles]
        found.append(f"{sum(value << place for place, value in enumerate(read)):02X}")
    return " ".join(found)


# ---------------------------------------------------------------------- other pins


def _resets(rows: Sequence[tuple[int, int]]) -> Iterator[Act]:
    """rst_n low, and high again."""
    for (t, level), (end, _) in pairwise([*rows, (rows[-1][0], 1)]):
        if not level:
            yield Act(f"reset for {end - t} clk", (Step(t, "rst_n", 1, 0), Step(end, "rst_n", 1, 1)))


def _on_a_port(part: Part, port: str, rows: Sequence[tuple[int, int]]) -> Iterator[Act]:
    """Changes of the pins of a port; those of a wide one as a whole."""
    width, idle = part.width(port), part.inputs[port]
    if width > 2:
        yield from _on_a_pin(port, (1 << width) - 1, 0, rows)
        return
    for place in range(width):
        name = port if width == 1 else f"{port}[{place + part.lowest.get(port, 0)}]"
        yield from _on_a_pin(name, 1 << place, place, bit_changes(list(rows), place, idle))


def _on_a_pin(name: str, mask: int, place: int, rows: Sequence[tuple[int, int]]) -> Iterator[Act]:
    port = name.partition("[")[0]
    if len(rows) <= BUSY or mask != 1 << place:
        for t, level in rows:
            shown = level if mask == 1 << place else f"{level:#x}"
            yield Act(f"{name} = {shown}", (Step(t, port, mask, level << place),))
        return
    # A group begins with a rise, so that what is left of a clock has longer periods, not shorter ones.
    size = -(-len(rows) // 2 // BUSY)
    rises = [number for number, (_, level) in enumerate(rows) if level]
    starts = [0, *rises[:: max(1, size)][1:], len(rows)]
    for first, last in pairwise(starts):
        periods = sum(level for _, level in rows[first:last])
        length = rows[min(last, len(rows) - 1)][0] - rows[first][0]
        what = f"{name}: {periods} periods of {length // max(1, periods)} clk"
        yield Act(what, tuple(Step(t, port, mask, level << place) for t, level in rows[first:last]))
