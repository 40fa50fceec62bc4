"""Shortens a failing stimulus to a few transactions, which are output as text and as pin changes."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Awaitable, Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby, pairwise
from typing import NamedTuple

from openppmc.check.records import Access, Change, Recording, bit_changes

from .part import Part, recorded

LINE = "rxd"
BUSY = 64
"""A pin with more than this number of changes is a clock. Its periods are combined to about this number of
transactions.
"""


class Step(NamedTuple):
    """A change at edge `t`: the bits `mask` of a port change to the levels `value`."""

    t: int
    port: str
    mask: int
    value: int


@dataclass(frozen=True)
class Transaction:
    """One transaction: a complete bus access, a frame, a reset, or a change of one pin.

    Attributes:
        what: description of the transaction without its time.
        access: entry of the transaction in the list of the host's accesses, if it has one.
    """

    what: str
    steps: tuple[Step, ...]
    access: Access | None = None

    @property
    def kind(self) -> str:
        """Direction and register of an access, name of a pin, "frame" or "reset"."""
        return f"{self.access.kind} {self.access.reg}" if self.access else self.what.split()[0]

    @property
    def reads(self) -> bool:
        """Whether the transaction is a read access."""
        return self.access is not None and self.access.kind.endswith("read")

    @property
    def begin(self) -> int:
        """Edge of the first pin change of the transaction."""
        return self.steps[0].t

    @property
    def end(self) -> int:
        """Edge of the last pin change of the transaction."""
        return self.steps[-1].t

    def moved(self, clk: int) -> Transaction:
        """Return the same transaction `clk` cycles later."""
        access = self.access and self.access._replace(t=self.access.t + clk)
        return Transaction(self.what, tuple(step._replace(t=step.t + clk) for step in self.steps), access)

    def __str__(self) -> str:
        return f"{self.what} at {self.begin}"


def transactions_of(recording: Recording) -> list[Transaction]:
    """Return all transactions of a recording, in order of time."""
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
    return sorted(found, key=lambda txn: (txn.begin, txn.end))


def changes_of(part: Part, transactions: Iterable[Transaction]) -> list[Change]:
    """Return the pin changes of some transactions; changes to the present level are omitted."""
    levels, changes = {**part.inputs, "rst_n": 1}, []
    for t, port, mask, value in sorted(
        (step for txn in transactions for step in txn.steps), key=lambda step: step.t
    ):
        level = levels[port] & ~mask | value
        if level != levels[port]:
            levels[port] = level
            changes.append(Change(t, port, level))
    return changes


# ---------------------------------------------------------------------- the host's bus


def _on_the_bus(
    part: Part, bus: Iterable[str], changes: Sequence[Change], accesses: Iterable[Access]
) -> Iterator[Transaction]:
    """Yield valid and invalid accesses; an access ends when all strobes are deasserted."""
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


def _access(steps: list[Step], done: dict[int, Access]) -> Transaction:
    access = next((done[step.t] for step in steps if step.t in done), None)
    if access is None:
        moved = {step.port: None for step in steps if not step.port.startswith("d")}
        return Transaction(f"{', '.join(moved)} without an access", tuple(steps))
    if access.kind == "write":
        what = f"write {'C' if access.reg else 'D'} {access.byte:02X}"
    elif access.kind == "read":
        what = f"read {'status' if access.reg else 'data'}"
    elif access.kind.endswith("read"):
        what = access.kind
    else:
        what = f"{access.kind} {access.byte:02X}"
    return Transaction(what, tuple(steps), access)


# ---------------------------------------------------------------------- a serial line


def _on_the_line(rows: Sequence[tuple[int, int]]) -> Iterator[Transaction]:
    """Yield frames: after a frame, the line is idle for longer than a character whose bits are all 1."""
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
    """Return the cycles per bit, estimated from the times between changes.

    The result is the time whose multiples are near the largest number of these times. If several times are
    equally good, it is the longest of them.
    """
    lengths = Counter(b - a for (a, _), (b, _) in pairwise(rows))

    def fitting(bit: int) -> int:
        whole = {length: round(length / bit) for length in lengths}
        near = (d for d, bits in whole.items() if 0 < bits < 11 and abs(d - bit * bits) * 10 <= bit)
        return sum(lengths[length] for length in near)

    often = sorted((length for length, _ in lengths.most_common(40)), reverse=True)
    return max(often, key=fitting, default=1)


def _frame(run: Sequence[tuple[int, int]], bit: int) -> Transaction:
    return Transaction(f"frame {_characters(run, bit)}", tuple(Step(t, LINE, 1, level) for t, level in run))


def _characters(run: Sequence[tuple[int, int]], bit: int) -> str:
    """Return the bytes that a receiver samples in the middle of the bits."""
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


def _resets(rows: Sequence[tuple[int, int]]) -> Iterator[Transaction]:
    """Yield the resets: each from the fall of rst_n to its rise."""
    for (t, level), (end, _) in pairwise([*rows, (rows[-1][0], 1)]):
        if not level:
            yield Transaction(f"reset for {end - t} clk", (Step(t, "rst_n", 1, 0), Step(end, "rst_n", 1, 1)))


def _on_a_port(part: Part, port: str, rows: Sequence[tuple[int, int]]) -> Iterator[Transaction]:
    """Yield the changes of the pins of a port; a wide port changes as a whole."""
    width, idle = part.width(port), part.inputs[port]
    if width > 2:
        yield from _on_a_pin(port, (1 << width) - 1, 0, rows)
        return
    for place in range(width):
        name = port if width == 1 else f"{port}[{place + part.lowest.get(port, 0)}]"
        yield from _on_a_pin(name, 1 << place, place, bit_changes(list(rows), place, idle))


def _on_a_pin(name: str, mask: int, place: int, rows: Sequence[tuple[int, int]]) -> Iterator[Transaction]:
    port = name.partition("[")[0]
    if len(rows) <= BUSY or mask != 1 << place:
        for t, level in rows:
            shown = level if mask == 1 << place else f"{level:#x}"
            yield Transaction(f"{name} = {shown}", (Step(t, port, mask, level << place),))
        return
    # A group begins with a rising edge, so that without it the clock has longer periods, not shorter ones.
    size = -(-len(rows) // 2 // BUSY)
    rises = [number for number, (_, level) in enumerate(rows) if level]
    starts = [0, *rises[:: max(1, size)][1:], len(rows)]
    for first, last in pairwise(starts):
        periods = sum(level for _, level in rows[first:last])
        length = rows[min(last, len(rows) - 1)][0] - rows[first][0]
        what = f"{name}: {periods} periods of {length // max(1, periods)} clk"
        yield Transaction(what, tuple(Step(t, port, mask, level << place) for t, level in rows[first:last]))


PAUSE = 20
"""Number of cycles that remain between two transactions if their pause is removed; enough for every bus."""


def messages(transactions: Iterable[Transaction]) -> list[list[Transaction]]:
    """Return the transactions in groups: runs of writes, runs of reads, and bursts of changes of other pins.

    A run ends when the direction changes, or when its first register occurs again after other registers.
    Examples of a run are a command with its data, all registers of a block, a response, or several polls.
    """
    found: list[list[Transaction]] = []
    run: list[Transaction] = []
    burst: list[Transaction] = []
    for txn in transactions:
        if txn.access and _continues(run, txn):
            run.append(txn)
        elif txn.access:
            found.append(run := [txn])
        elif burst and txn.begin - burst[-1].end < PAUSE:
            burst.append(txn)
        else:
            found.append(burst := [txn])
    return found


def exchanges(transactions: Iterable[Transaction]) -> list[list[Transaction]]:
    """Return exchanges (each message with the reads that follow it) and bursts of changes of other pins."""
    found: list[list[Transaction]] = []
    exchange: list[Transaction] = []
    for message in messages(transactions):
        if message[0].reads and exchange:
            exchange += message
            continue
        found.append(message)
        if message[0].access:
            exchange = message
    return found


def in_time_order(runs: Iterable[Sequence[Transaction]]) -> list[Transaction]:
    """Return the transactions of some runs in order of time."""
    return sorted((txn for run in runs for txn in run), key=lambda txn: (txn.begin, txn.end))


def report_lines(transactions: Iterable[Transaction]) -> list[str]:
    """Return one line for each run of transactions that follow each other without a pause."""
    lines: list[list[Transaction]] = []
    for txn in transactions:
        last = lines[-1] if lines else []
        if txn.access and last and _continues(last, txn) and txn.begin - last[-1].end <= PAUSE:
            last.append(txn)
        else:
            lines.append([txn])
    return [f"{', '.join(_words(line))} at {line[0].begin}" for line in lines]


def _continues(run: Sequence[Transaction], txn: Transaction) -> bool:
    """Return whether the access `txn` continues a run of accesses (see `messages`)."""
    if not run or not run[-1].access or run[-1].reads != txn.reads:
        return False
    return txn.kind != run[0].kind or txn.kind == run[-1].kind


def _words(line: Sequence[Transaction]) -> Iterator[str]:
    for _, same in groupby(line, key=lambda txn: txn.kind):
        first, *more = same
        if first.reads and more:
            yield f"{first.what} {1 + len(more)} times"
        else:
            yield " ".join([first.what, *(txn.what.rpartition(" ")[2] for txn in more)])


Fails = Callable[[Sequence[Transaction]], Awaitable[int | None]]
"""Function that returns the edge of the first difference, or None if there is no difference."""

CAPS = (PAUSE, 10 * PAUSE, 100 * PAUSE, 1000 * PAUSE)
"""Maximum lengths of a pause in cycles, which are tried in turn."""


class _LimitError(Exception):
    """The search has reached a limit: number of trials or CPU time."""


@dataclass
class Shrinker:
    """Shrinks a list of transactions.

    `transactions` is the shortest list so far, `trials` the number of lists tried.

    Attributes:
        trials_at_most: maximum number of trials.
        seconds: limit of the CPU time of this process in s.
        kept: function that is called after each trial in which a shorter list still causes the difference.
    """

    transactions: list[Transaction]
    fails: Fails
    trials_at_most: int = 500
    seconds: float = 60
    kept: Callable[[], None] = lambda: None
    trials: int = 0
    stopped: str = ""
    _tried: set[tuple[Transaction, ...]] = field(default_factory=set)

    async def run(self) -> None:
        """Shrink; if a limit ends the search early, `stopped` names the limit."""
        self._end = time.process_time() + self.seconds
        try:
            await self._keep_the_end()
            await self._leave_out_kinds()
            await self._leave_out(exchanges(self.transactions))
            await self._cap_pauses()
            await self._leave_out(messages(self.transactions))
            before: list[Transaction] = []
            while before != self.transactions:
                before = self.transactions
                await self._leave_out([[txn] for txn in self.transactions])
                await self._close_pauses()
        except _LimitError as limit:
            self.stopped = str(limit)

    async def _try(self, transactions: Sequence[Transaction]) -> bool:
        """Return whether this list also causes the difference; if so, keep it up to the difference."""
        if tuple(transactions) in self._tried:
            return False
        if self.trials >= self.trials_at_most:
            raise _LimitError(f"after {self.trials} trials")
        if time.process_time() >= self._end:
            raise _LimitError(f"after {self.seconds:g} s")
        self._tried.add(tuple(transactions))
        self.trials += 1
        edge = await self.fails(transactions)
        if edge is None:
            return False
        self.transactions = [txn for txn in transactions if txn.begin <= edge]
        self.kept()
        return True

    async def _keep_the_end(self) -> None:
        """Try only the last exchanges, moved to just after the reset; add earlier ones until these fail.

        Omitting exchanges from the middle would change later reads. Short lists from the end are quick to
        try.
        """
        runs, count = exchanges(self.transactions), 1
        head = [txn for txn in self.transactions if txn.begin < PAUSE]
        start = max((txn.end for txn in head), default=0) + PAUSE
        while count <= len(runs) // 2:
            end = in_time_order(runs[-count:])
            if end[0].begin <= start:
                return
            if await self._try([*head, *(txn.moved(start - end[0].begin) for txn in end)]):
                return
            count += 1 + count // 4

    async def _leave_out_kinds(self) -> None:
        """Omit all transactions of a kind, the most frequent kind first.

        Frequent kinds are polls, clocks, and changes of other pins. Kinds with less than 5 % of the
        transactions are left to the later searches. The last message is kept, because it may be the poll that
        shows the difference.
        """
        for kind, count in Counter(txn.kind for txn in self.transactions).most_common():
            if count < len(self.transactions) // 20:
                return
            last = max(messages(self.transactions), key=lambda run: run[-1].end)
            await self._try([txn for txn in self.transactions if txn.kind != kind or txn in last])

    async def _leave_out(self, runs: list[list[Transaction]]) -> None:
        """Try to omit each half of the runs, then each quarter, and so on down to single runs."""
        size = max(1, len(runs) // 2)
        while size:
            first = 0
            while first < len(runs):
                rest = runs[:first] + runs[first + size :]
                if await self._try(in_time_order(rest)):
                    runs = [run for run in rest if run[0].begin <= self.transactions[-1].begin]
                else:
                    first += size
            size //= 2

    async def _cap_pauses(self) -> None:
        """Limit all pauses to the smallest value of CAPS with which the difference still occurs."""
        for longest in CAPS:
            transactions: list[Transaction] = []
            saved = last = 0
            for txn in self.transactions:
                saved += max(0, txn.begin - saved - last - longest)
                transactions.append(txn.moved(-saved))
                last = max(last, transactions[-1].end)
            if not saved or await self._try(transactions):
                return

    async def _close_pauses(self) -> None:
        """Shorten each pause: remove it, or reduce it by half or by a quarter."""
        place = 0
        while place < len(self.transactions):
            last = max((txn.end for txn in self.transactions[:place]), default=0)
            spare = self.transactions[place].begin - last - PAUSE
            for saved in (spare, spare // 2, spare // 4):
                if saved <= 0:
                    break
                later = [txn.moved(-saved) for txn in self.transactions[place:]]
                if await self._try(self.transactions[:place] + later):
                    break
            place += 1
