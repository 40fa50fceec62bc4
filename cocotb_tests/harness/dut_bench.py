"""`DutBench`: interface of a test or host to the device under test, which is the RTL or the golden model.

Time is the index of rising edges of `clk`; edge 0 is the first one that samples rst_n = 1 after the first
reset. The stamp of a pin change made now is `now`, the index of the next rising edge. The stamp of an output
edge is the rising edge that caused it. Most methods use a few primitives, which `RtlBench` (RTL) and
`ModelBench` (golden model) define.
"""

from __future__ import annotations

import random
from abc import ABC, abstractmethod
from bisect import bisect_left
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from typing import Any, ClassVar, Protocol

from openppmc.check import replay
from openppmc.check.records import Access, Change, Edge, Recording, bit_changes, level_at
from openppmc.check.replay import ModelRunner

from .config import Config
from .crosses import watch
from .jitter import StageLog
from .part import Part


def new_model(part: str, params: Mapping[str, object]) -> Any:
    """See `openppmc.check.replay.new_model`."""
    watch(part)
    return replay.new_model(part, params)


class StimulusLog:
    """Collector of pin changes: `changes` contains those of each call of `add` in order of time."""

    def __init__(self) -> None:
        self.changes: list[Change] = []
        self._driven = 0
        self._made: dict[str, tuple[int, tuple[int, int]]] = {}
        """Name -> number of its rows that have been appended, and the last row that has been appended."""

    def add(self, driven: Sequence[Change], made: Mapping[str, Sequence[tuple[int, int]]]) -> list[Change]:
        """Append the rows that both arguments have gained since the previous call; return all rows so far.

        Args:
            made: name -> (edge, level) of each change; edge + 1 is the first edge that samples the level. The
                level of the last row may have changed since the previous call.
        """
        new, self._driven = list(driven[self._driven :]), len(driven)
        for name, rows in made.items():
            if not rows:
                continue
            count, last = self._made.get(name, (0, rows[0]))
            if count and rows[count - 1] != last:
                count -= 1
            new += [Change(t + 1, name, level) for t, level in rows[count:]]
            self._made[name] = len(rows), rows[-1]
        self.changes += sorted(new, key=lambda change: change.t)
        return self.changes


TIMEOUT = 1_000_000
"""Default time limit of a wait in cycles."""


PinChange = tuple[int, Mapping[str, int]]
"""One change: the first edge that samples the levels, and the level of each pin."""


class Handle(Protocol):
    """A series of scheduled pin changes; `await` waits until the last of them."""

    def __await__(self) -> Generator[Any, Any, Any]: ...

    def cancel(self) -> Any:
        """Stop the changes."""


class DutBench(ABC):
    """A device under test.

    Attributes: `part`, `config` (its build), `seed`, `rng` (random.Random(seed)), `pins` (present level of
    each input and of rst_n), `stimulus` (list[Change]: driven changes), `accesses` (list[Access]: host
    accesses), `stage_log` (with JITTER=1: converts driven changes to those that the synchronisers sampled),
    `initial` (level of each recorded output before its first edge), `follower` (the model that `golden`
    returns; None before its first use).
    """

    simulated: ClassVar[bool] = True
    """True if the bench contains the RTL, whose output edges can be compared with the golden model."""

    def __init__(self, part: Part, config: Config, seed: int) -> None:
        self.part = part.built(part.params(config))
        self.config = config
        self.seed = seed
        self.rng = random.Random(seed)
        self.pins: dict[str, int] = {}
        self.stimulus: list[Change] = []
        self.accesses: list[Access] = []
        self.initial: dict[str, int] = {}
        self.follower: ModelRunner | None = None
        self._stimulus_log = StimulusLog()
        self.stage_log: StageLog | None = None
        self._later: list[Handle] = []

    # ---------------------------------------------------------------- primitives

    @property
    @abstractmethod
    def now(self) -> int:
        """Index of the next rising edge of `clk`: the stamp of a pin change made at this moment."""

    @abstractmethod
    async def until(self, edge: int) -> int:
        """Advance to the falling edge of `clk` before rising edge `edge` (then now == edge).

        Raises ValueError if that moment has passed.
        """

    @abstractmethod
    async def align(self) -> int:
        """Advance to the next falling edge if the last edge was a rising one; return `now`."""

    @abstractmethod
    def set(self, **levels: int) -> int:
        """Drive input pins now (only in the low half of `clk`) and record them; return the stamp.

        A name such as "fl_n[2]" drives one bit of a port. Raises RuntimeError in the high half of `clk`,
        KeyError for an unknown pin. Unchanged levels are neither driven nor recorded.
        """

    @abstractmethod
    async def set_between(self, share: float = 0.5, /, **levels: int) -> int:
        """Drive input pins as `set` does, but between two edges, for a reset; return the stamp of the change.

        The pins change when `share` (0 to 1) of the low half of `clk` has passed; the method returns just
        after the change.
        """

    @abstractmethod
    def drive(self, changes: Iterable[PinChange]) -> Handle:
        """Schedule pin changes in order of time, none in the past; the iterable is read as time advances.

        The test continues during the changes. cancel() of the returned handle stops them; awaiting the handle
        waits for the last change.
        """

    @abstractmethod
    async def edge(self, output: str, level: int | None = None, timeout: int = TIMEOUT) -> int:
        """Wait for the next change of an output (to `level`, if not None); return its edge.

        The bench is then aligned, so that `set` works. Raises TimeoutError after `timeout` cycles.
        """

    @property
    @abstractmethod
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs whose levels are visible."""

    @abstractmethod
    def _port_level(self, port: str) -> int:
        """Return the present level of an output."""

    @abstractmethod
    def _output_changes(self) -> Mapping[str, list[tuple[int, int]]]:
        """Return all changes (edge, level) of the recorded outputs until now.

        Of several changes on one edge, only the last level is included.
        """

    @property
    def golden(self) -> Any:
        """The golden model at edge `now` - 1, with the pin changes so far; it is never ahead of this bench.

        Use it only to choose moments (its position, state). A test checks values of the bench.
        """
        if self.follower is None:
            self.follower = ModelRunner(new_model(self.part.name, self.part.params(self.config)))
        return self.follower.catch_up(self.pin_changes(), self.now - 1)

    @property
    def next_event(self) -> int | None:
        """Next edge on which the device may do something; None if no event is pending.

        With JITTER=1, the golden model receives a pin change only after it was sampled, so that edge is an
        event, too.
        """
        events = (self.golden.next_event, self.stage_log.pending if self.stage_log else None)
        return min((edge for edge in events if edge is not None), default=None)

    def pin_changes(self) -> list[Change]:
        """Return the changes at the inputs of the device: those of the test and those of the bench's top.

        Edge t + 1 is the first to sample a change that the top module of the bench makes at edge t.
        """
        part, changes = self.part, self.stimulus
        if part.fed:
            seen = self._output_changes()
            driven = [change for change in changes if change.pin not in part.aside]
            changes = self._stimulus_log.add(driven, {name: seen[name] for name in part.fed})
        return self._sampled_changes(self.stage_log, changes) if self.stage_log else changes

    def _sampled_changes(self, log: StageLog, changes: list[Change]) -> list[Change]:
        """Return the changes that the synchronisers have sampled."""
        raise NotImplementedError

    @property
    def slack(self) -> int:
        """Number of cycles by which a pin change may be sampled late: 1 with JITTER=1, else 0."""
        return int(self.stage_log is not None)

    def close(self) -> None:
        """Stop all scheduled pin changes."""
        for handle in self._later:
            handle.cancel()

    # ---------------------------------------------------------------- pins that move while the test runs

    def at(self, edge: int, **levels: int) -> Handle:
        """Schedule pin levels so that rising edge `edge` is the first to sample them.

        Raises ValueError if that moment has passed.
        """
        if edge < self.now:
            raise ValueError(f"at({edge}): it is already edge {self.now}")
        return self.drive([(edge, levels)])

    def external_clock(self, intervals: Iterable[int], pin: str = "", high: int = 2) -> Handle:
        """Run the external clock; `intervals` yields the cycles from one rising edge to the next.

        The clock is on `pin` (default: the clock pin of a device with one axis). The first rising edge occurs
        immediately, and the clock stops at the end of the iterable. Each high time is `high` cycles. Return
        the handle of `drive`.
        """
        name, start = pin or self.part.clock, self.now

        def ticks() -> Iterator[PinChange]:
            t = start
            for interval in intervals:
                yield t, {name: 1}
                yield t + high, {name: 0}
                t += interval

        return self.drive(ticks())

    # ---------------------------------------------------------------- time, reset

    async def clocks(self, n: int) -> int:
        """Wait n cycles; return `now`."""
        return await self.until(self.now + n)

    async def reset(self, clocks: int = 4, settle: int = 4) -> int:
        """Drive rst_n low for `clocks` cycles; return the stamp of the release (first edge that samples 1).

        The method then waits `settle` cycles; bytes are accepted from then on (P104-PORT-03).
        """
        await self.align()
        self.set(rst_n=0)
        await self.clocks(clocks)
        self.set(rst_n=1)
        release = self.now
        if settle:
            await self.clocks(settle)
        return release

    # ---------------------------------------------------------------- pins

    def pin(self, name: str) -> int:
        """Return the last driven level of an input: a whole port, or one bit of it."""
        port, place = self.part.locate(name)
        return self.pins[port] if place is None else self.pins[port] >> place & 1

    def pin_edges(self, pin: str, level: int = 1, since: int = 0) -> list[int]:
        """Return the edges of `clk`, from `since` on, that first sample a one-bit input at a new `level`.

        With JITTER=1, these are the edges at which the first stage of the synchroniser samples the change.
        """
        port, place = self.part.locate(pin)
        changes = self.pin_changes()
        first = bisect_left(changes, since, key=lambda change: change.t)
        earlier = (changes[n] for n in range(first - 1, -1, -1))
        before = next((c.value for c in earlier if c.pin == port), self.part.inputs[port])
        rows = [(c.t, c.value) for c in changes[first:] if c.pin == port]
        return [t for t, v in bit_changes(rows, place or 0, before) if v == level]

    def _levelled(self, pin: str, level: int) -> tuple[str, int]:
        """Return the port that contains a pin, and the level of this port if the pin has `level`."""
        port, place = self.part.locate(pin)
        return port, level if place is None else self.pins[port] & ~(1 << place) | level << place

    async def pulse_pin(self, pin: str, level: int, clocks: int) -> int:
        """Hold a pin at `level` for `clocks` cycles, then restore its old level; return the first stamp."""
        await self.align()
        before, stamp = self.pin(pin), self.now
        self.set(**{pin: level})
        await self.clocks(clocks)
        self.set(**{pin: before})
        return stamp

    # ---------------------------------------------------------------- outputs

    def level(self, output: str) -> int:
        """Return the present level of an output, or of one bit of it ("pout_n[2]")."""
        port, place = self.part.locate(output)
        level = self._port_level(port)
        return level if place is None else level >> place & 1

    def edges(self, output: str, since: int = 0) -> list[tuple[int, int]]:
        """Return the changes (edge, level) of an output, or of one bit of it, from edge `since` on."""
        port, place = self.part.locate(output)
        changes = self._output_changes()[port]
        if place is not None:
            changes = bit_changes(changes, place, self.initial[port])
        return changes[bisect_left(changes, (since, 0)) :]

    def falls(self, output: str, since: int = 0) -> list[int]:
        """Return the edges on which an output of one bit fell."""
        return [t for t, value in self.edges(output, since) if value == 0]

    def rises(self, output: str, since: int = 0) -> list[int]:
        """Return the edges on which an output of one bit rose."""
        return [t for t, value in self.edges(output, since) if value == 1]

    def pulses(self, since: int = 0, pin: str = "pout_n") -> list[int]:
        """Return the pulses (P104-GEN-05): falling edges of pout_n."""
        return self.falls(pin, since)

    def intervals(self, since: int = 0, pin: str = "pout_n") -> list[int]:
        """Return the distances of successive pulses in cycles."""
        pulses = self.pulses(since, pin)
        return [b - a for a, b in zip(pulses, pulses[1:], strict=False)]

    def low_times(self, since: int = 0, pin: str = "pout_n") -> list[int]:
        """Return the low time of each complete pulse in cycles."""
        changes = self.edges(pin, since)
        return [
            b - a for (a, low), (b, high) in zip(changes, changes[1:], strict=False) if low == 0 and high == 1
        ]

    def level_at(self, output: str, edge: int) -> int:
        """Return the level of an output just after rising edge `edge`."""
        port, place = self.part.locate(output)
        level = level_at(self._output_changes()[port], edge, self.initial[port])
        return level if place is None else level >> place & 1

    # ---------------------------------------------------------------- waiting for outputs

    async def nth_fall(self, n: int, since: int = 0, pin: str = "pout_n", timeout: int = TIMEOUT) -> int:
        """Wait for the n-th fall of `pin` from edge `since` on; return its edge."""
        end = self.now + timeout
        while len(self.falls(pin, since)) < n:
            await self.edge(pin, 0, max(1, end - self.now))
        await self.align()
        return self.falls(pin, since)[n - 1]

    async def level_is(self, output: str, level: int, timeout: int = TIMEOUT) -> int:
        """Wait until an output has this level, which it may have already; return `now`."""
        if self.level(output) != level:
            await self.edge(output, level, timeout)
        return await self.align()

    # ---------------------------------------------------------------- checking and reporting

    def context(self, last: int = 8) -> str:
        """Return the last output edges, pin changes and host accesses as text for messages."""
        usual = {*self.part.bus_pins, self.part.clock}
        pins = [c for c in self.stimulus if c.pin not in usual]
        shown = [edge for edge in self._all_edges() if edge.signal not in ("d_o", "d_oe")]
        lines = [f"now: edge {self.now}, config {self.config.name}, seed {self.seed}", "last output edges:"]
        lines += [f"  {e.t:>9} {e.signal} = {e.value:#x}" for e in shown[-last:]]
        lines += ["last pin changes:"] + [f"  {c.t:>9} {c.pin} = {c.value:#x}" for c in pins[-last:]]
        lines += ["last host accesses:"] + [f"  {a}" for a in self.accesses[-last:]]
        return "\n".join(lines)

    def check(self, rule: str, what: str, got: Any, expected: Any) -> None:
        """Assert got == expected; the message contains rule, edge and context."""
        assert got == expected, (
            f"{rule}: {what}: expected {_show(expected)}, got {_show(got)}\n{self.context()}"
        )

    def check_window(self, rule: str, what: str, got: int, low: int, high: int) -> None:
        """Assert low <= got <= high; the message contains rule, edge and context."""
        assert low <= got <= high, f"{rule}: {what}: expected {low}..{high}, got {got}\n{self.context()}"

    def recording(self) -> Recording:
        """Return all changes until now, for the comparison; the last complete edge of `clk` is `now` - 1."""
        return Recording(
            part=self.part.name,
            params=self.part.params(self.config),
            seed=self.seed,
            end=self.now - 1,
            stimulus=list(self.pin_changes()),
            edges=self._all_edges(),
            accesses=list(self.accesses),
        )

    def _all_edges(self) -> list[Edge]:
        rows = (
            Edge(t, name, value) for name, changes in self._output_changes().items() for t, value in changes
        )
        return sorted(rows, key=lambda edge: edge.t)


def _show(value: Any) -> str:
    if isinstance(value, int) and not isinstance(value, bool):
        return f"{value} ({value:#x})"
    return str(value)
