"""`Bench`: clock, reset, pin driver, edge monitors and time arithmetic around one part.

Time is the index of rising clk edges; edge 0 is the first one that sees rst_n = 1 after the first reset.
Pins are driven on falling edges: a change made now is stamped `bench.now`, the next rising edge. Clock, pins
and the recorder of output edges are those of the simulation's main program (`native`), which needs no Python.
"""

from __future__ import annotations

import os
import random
import signal as unix_signal
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import cocotb
from cocotb.handle import Immediate
from cocotb.triggers import First, Timer

from . import native
from .config import F16, Config
from .part import Part
from .stimulus import Access, Change, Edge, Recording, level_at

TIMEOUT = 1_000_000


class Bench:
    """A part on the bench. Make one with `await Bench.start(dut, part)`.

    Attributes: `config` (Config), `part` (Part), `seed` (int), `rng` (random.Random(seed)), `out`
    (Path for files of this run), `host` (set by the caller's bus; see `bus.HostBus`), `stimulus`
    (list[Change]), `accesses` (list[Access]).
    """

    def __init__(self, dut: Any, part: Part, seed: int | None = None) -> None:
        self.dut = dut
        self.part = part
        text = os.environ.get("OPENPPMC_CONFIG", "")
        self.config = Config.from_json(text) if text else F16
        self.seed = int(os.environ.get("OPENPPMC_SEED", "1")) if seed is None else seed
        self.rng = random.Random(self.seed)
        self.out = Path(os.environ.get("OPENPPMC_OUT", "."))
        self.repro = os.environ.get("OPENPPMC_REPRO", "")
        self.period = self.config.period_ps
        self.half = self.period // 2
        self.pins: dict[str, int] = {}
        self.stimulus: list[Change] = []
        self.accesses: list[Access] = []
        self.initial: dict[str, int] = {}
        self._edges: dict[str, list[tuple[int, int]]] = {}
        self._watched: dict[int, list[tuple[int, int]]] = {}
        self._handles = {name: getattr(dut, name) for name in (*part.inputs, "rst_n", *part.outputs)}
        self._ports = {name: native.port(name) for name in self._handles}
        self._t0 = 0

    # ---------------------------------------------------------------- start, reset

    @classmethod
    async def start(
        cls,
        dut: Any,
        part: Part,
        reset_clk: int = 4,
        settle: int = 4,
        seed: int | None = None,
        **pins: int,
    ) -> Bench:
        """Start clk, pulse rst_n 1-0-1 and return with `now` = settle.

        The parts take bytes from edge 4 on (P104-PORT-03); settle = 0 returns before edge 0.

        `pins` override idle input levels; they are stamped with edge 0. `reset_clk` is the length of
        the reset in clk (>= 2). `seed` replaces the run's.
        """
        bench = cls(dut, part, seed)
        bench._arm_wall_clock()
        native.collect_seldom()
        # All state starts at random: no clk edge may come before rst_n has fallen, not even at time 0.
        dut.clk.set(Immediate(0))
        dut.rst_n.set(Immediate(1))
        for pin, level in {**part.inputs, **pins}.items():
            bench._handles[pin].value = level
            bench.pins[pin] = level
        await Timer(bench.half, "ps")
        dut.rst_n.value = 0
        # Falling edges lie half a period behind rising edges; the first edge is a rising one.
        native.clock(native.port("clk"), bench.half)
        await Timer(bench.period * max(2, reset_clk), "ps")
        bench._t0 = native.now() + bench.half
        bench._handles["rst_n"].value = 1
        bench.pins["rst_n"] = 1
        for pin, level in pins.items():
            if level != part.inputs[pin]:
                bench.stimulus.append(Change(0, pin, level))
        native.seen()  # what an earlier bench of this simulation has left
        for name in part.watched:
            bench.watch(name)
        if settle:
            await bench.until(settle)
        return bench

    def watch(self, output: str) -> None:
        """Record the edges of an output from now on; all but `part.unwatched` are recorded anyway."""
        self.initial[output] = self.level(output)
        self._edges[output] = []
        port = self._ports[output]
        if port < 0:
            cocotb.start_soon(self._monitor(output))
        else:
            self._watched[port] = self._edges[output]
            native.watch(port)

    def _arm_wall_clock(self) -> None:
        """End this simulator process if it runs away (a test of seconds that takes minutes)."""
        unix_signal.alarm(int(os.environ.get("OPENPPMC_WALL_S", "300")))

    async def reset(self, clocks: int = 4, settle: int = 4) -> int:
        """Pulse rst_n low for some clk; returns the stamp of the release (first edge that sees 1).

        Time goes on for `settle` clk after it (P104-PORT-03: bytes are taken from then on).
        """
        await self.align()
        self.set(rst_n=0)
        await self.clocks(clocks)
        self.set(rst_n=1)
        release = self.now
        if settle:
            await self.clocks(settle)
        return release

    # ---------------------------------------------------------------- time

    def sim_time(self) -> int:
        """Simulation time in ps."""
        return native.now()

    def edge_time(self, edge: int) -> int:
        """Simulation time of rising edge `edge` in ps."""
        return self._t0 + edge * self.period

    @property
    def now(self) -> int:
        """Index of the next rising clk edge: the stamp of a pin change made at this moment."""
        return (native.now() - self._t0) // self.period + 1

    async def until(self, edge: int) -> int:
        """Go to the falling clk edge before rising edge `edge` (then now == edge).

        Raises ValueError if that moment has passed.
        """
        target = self._t0 + (edge - 1) * self.period + self.half
        delta = target - native.now()
        if delta < 0:
            if self.now == edge:
                return edge
            raise ValueError(f"until({edge}): it is already edge {self.now}")
        if delta:
            await Timer(delta, "ps")
        return edge

    async def clocks(self, n: int) -> int:
        """Wait n clk; returns `now`."""
        return await self.until(self.now + n)

    async def align(self) -> int:
        """Go to the next falling edge if just after a rising one; returns `now`."""
        target = self._t0 + (self.now - 1) * self.period + self.half
        delta = target - native.now()
        if delta > 0:
            await Timer(delta, "ps")
        return self.now

    # ---------------------------------------------------------------- pins

    def set(self, **levels: int) -> int:
        """Drive input pins now (falling-edge half only) and log them; returns the stamp.

        A name such as "fl_n[2]" drives one bit of a port. Raises RuntimeError in the high half of clk,
        KeyError for an unknown pin. Unchanged levels are neither driven nor logged.
        """
        stamp = self.now
        if self._t0 + (stamp - 1) * self.period + self.half > native.now():
            raise RuntimeError("Bench.set() in the high half of clk: await bench.align() first")
        for pin, level in levels.items():
            if self.pin(pin) != level:
                self._drive(stamp, pin, level)
        return stamp

    def pin(self, name: str) -> int:
        """Level of an input as driven last, of a whole port or of one bit."""
        port, place = self.part.locate(name)
        return self.pins[port] if place is None else self.pins[port] >> place & 1

    def pin_rises(self, pin: str, since: int = 0) -> list[int]:
        """Stamps of the rising edges driven on an input of one bit from edge `since` on."""
        port, place = self.part.locate(pin)
        changes = [(c.t, c.value) for c in self.stimulus if c.pin == port]
        return [t for t, v in _bit_changes(changes, place or 0, self.part.inputs[port]) if v and t >= since]

    def _drive(self, stamp: int, pin: str, level: int) -> None:
        port, level = self._levelled(pin, level)
        self.pins[port] = level
        number = self._ports[port]
        if number < 0:
            self._handles[port].value = level
        else:
            native.put(number, level)
        self.stimulus.append(Change(stamp, port, level))

    def _levelled(self, pin: str, level: int) -> tuple[str, int]:
        """Port of a pin and the port's level with the pin at `level`."""
        port, place = self.part.locate(pin)
        return port, level if place is None else self.pins[port] & ~(1 << place) | level << place

    def set_between_edges(self, **levels: int) -> int:
        """As `set`, but at any moment (asynchronous events such as rst_n between two edges)."""
        stamp = self.now
        for pin, level in levels.items():
            self._drive(stamp, pin, level)
        return stamp

    def play(self, changes: Iterable[Change]) -> None:
        """Have pin changes made at their stamps, in order of time and none in the past, without Python.

        Those of `now` are made at once; the caller waits until the others have been. Until then `pins` is
        ahead of the pins, and nobody else may drive any.
        """
        rows, now = [], self.now
        for t, pin, value in changes:
            if t <= now:
                self.set(**{pin: value})
                continue
            port, level = self._levelled(pin, value)
            if self.pins[port] != level:
                if self._ports[port] < 0:
                    raise ValueError(f"{port} is too wide for a tape")
                self.pins[port] = level
                self.stimulus.append(Change(t, port, level))
                rows.append((self._t0 + (t - 1) * self.period + self.half, self._ports[port], level))
        native.tape(rows)

    def at(self, edge: int, **levels: int) -> Any:
        """Schedule pin levels so that rising edge `edge` is the first to sample them; returns the task."""

        async def later() -> None:
            await self.until(edge)
            self.set(**levels)

        return cocotb.start_soon(later())

    async def pulse_pin(self, pin: str, level: int, clocks: int) -> int:
        """Hold a pin at `level` for some clk, then put the old level back; returns the first stamp."""
        await self.align()
        before, stamp = self.pin(pin), self.now
        self.set(**{pin: level})
        await self.clocks(clocks)
        self.set(**{pin: before})
        return stamp

    def external_clock(self, intervals: Iterable[int], pin: str = "", high: int = 2) -> Any:
        """Run the external clock: each item is the clk count from one rising edge to the next.

        `pin` (default: the clock pin of a part with one axis). The first rising edge comes at once; it ends
        with the iterable. Each high time is `high` clk. Returns the task (cancel() stops it).
        """
        name = pin or self.part.clock

        async def run() -> None:
            await self.align()
            for interval in intervals:
                self.set(**{name: 1})
                await self.clocks(high)
                self.set(**{name: 0})
                await self.clocks(interval - high)

        return cocotb.start_soon(run())

    # ---------------------------------------------------------------- outputs

    def forget(self) -> None:
        """Drop all output edges and pin changes seen so far, for runs of many parts."""
        self.stimulus.clear()
        for changes in self._seen().values():
            changes.clear()

    def _index(self, time: int) -> int:
        """Index of the edge that made a change at a time visible (asynchronous changes: the next edge)."""
        return -((self._t0 - time) // self.period)

    def _seen(self) -> dict[str, list[tuple[int, int]]]:
        """Changes (edge, level) of all watched outputs up to now, the last one of each edge."""
        t0, period, watched = self._t0, self.period, self._watched
        for time, port, value in native.seen():
            changes, t = watched[port], -((t0 - time) // period)
            if changes and changes[-1][0] == t:
                changes[-1] = (t, value)
            else:
                changes.append((t, value))
        return self._edges

    async def _monitor(self, name: str) -> None:
        """Record a port that is too wide for the recorder."""
        handle, changes = self._handles[name], self._edges[name]
        trigger = handle.value_change
        while True:
            await trigger
            t, value = self._index(native.now()), int(handle.value)
            if changes and changes[-1][0] == t:
                changes[-1] = (t, value)
            else:
                changes.append((t, value))

    def _port_level(self, port: str) -> int:
        number = self._ports[port]
        return int(self._handles[port].value) if number < 0 else native.read(number)

    def level(self, output: str) -> int:
        """Present level of an output, or of one bit of it ("pout_n[2]")."""
        port, place = self.part.locate(output)
        level = self._port_level(port)
        return level if place is None else level >> place & 1

    def edges(self, output: str, since: int = 0) -> list[tuple[int, int]]:
        """Changes (edge, level) of an output, or of one bit of it, from edge `since` on."""
        port, place = self.part.locate(output)
        changes = self._seen()[port]
        if place is not None:
            changes = _bit_changes(changes, place, self.initial[port])
        return [(t, value) for t, value in changes if t >= since]

    def falls(self, output: str, since: int = 0) -> list[int]:
        """Edges on which an output of one bit fell."""
        return [t for t, value in self.edges(output, since) if value == 0]

    def rises(self, output: str, since: int = 0) -> list[int]:
        """Edges on which an output of one bit rose."""
        return [t for t, value in self.edges(output, since) if value == 1]

    def pulses(self, since: int = 0, pin: str = "pout_n") -> list[int]:
        """Pulses (P104-GEN-05): falling edges of pout_n."""
        return self.falls(pin, since)

    def intervals(self, since: int = 0, pin: str = "pout_n") -> list[int]:
        """Distances of successive pulses in clk."""
        pulses = self.pulses(since, pin)
        return [b - a for a, b in zip(pulses, pulses[1:], strict=False)]

    def low_times(self, since: int = 0, pin: str = "pout_n") -> list[int]:
        """Low time of each complete pulse in clk."""
        changes = self.edges(pin, since)
        return [
            b - a for (a, low), (b, high) in zip(changes, changes[1:], strict=False) if low == 0 and high == 1
        ]

    def level_at(self, output: str, edge: int) -> int:
        """Level of an output just after rising edge `edge`."""
        port, place = self.part.locate(output)
        level = level_at(self._seen()[port], edge, self.initial[port])
        return level if place is None else level >> place & 1

    # ---------------------------------------------------------------- waiting for outputs

    async def edge(self, output: str, level: int | None = None, timeout: int = TIMEOUT) -> int:
        """Wait for the next change (to `level` if given); returns its edge, aligned so that set() works.

        Raises TimeoutError after `timeout` clk.
        """
        end = self.now + timeout
        handle = self._handles[self.part.locate(output)[0]]
        before = self.level(output)
        while True:
            left = (end - self.now) * self.period
            if left <= 0:
                break
            limit = Timer(left, "ps")
            fired = await First(handle.value_change, limit)
            if fired is limit:
                break
            # A change of the port may be one of its other bits.
            was, before = before, self.level(output)
            if before != was and level in (None, before):
                t = self._index(native.now())
                await self.align()
                return t
        want = "a change" if level is None else f"level {level}"
        raise TimeoutError(f"no {want} of {output} within {timeout} clk\n{self.context()}")

    async def nth_fall(self, n: int, since: int = 0, pin: str = "pout_n", timeout: int = TIMEOUT) -> int:
        """Wait until `pin` has fallen n times from edge `since` on; returns the edge of the n-th fall."""
        end = self.now + timeout
        while len(self.falls(pin, since)) < n:
            await self.edge(pin, 0, max(1, end - self.now))
        await self.align()
        return self.falls(pin, since)[n - 1]

    async def level_is(self, output: str, level: int, timeout: int = TIMEOUT) -> int:
        """Wait until an output has this level (returns at once if it has); returns `now`."""
        if self.level(output) != level:
            await self.edge(output, level, timeout)
        return await self.align()

    # ---------------------------------------------------------------- checking and reporting

    def context(self, last: int = 8) -> str:
        """The last output edges, pin changes and host accesses, for messages."""
        usual = {*self.part.bus_pins, self.part.clock}
        pins = [c for c in self.stimulus if c.pin not in usual]
        shown = [edge for edge in self._all_edges() if edge.signal not in ("d_o", "d_oe")]
        lines = [f"now: edge {self.now}, config {self.config.name}, seed {self.seed}", "last output edges:"]
        lines += [f"  {e.t:>9} {e.signal} = {e.value:#x}" for e in shown[-last:]]
        lines += ["last pin changes:"] + [f"  {c.t:>9} {c.pin} = {c.value:#x}" for c in pins[-last:]]
        lines += ["last host accesses:"] + [f"  {a}" for a in self.accesses[-last:]]
        return "\n".join(lines)

    def check(self, rule: str, what: str, got: Any, expected: Any) -> None:
        """Assert got == expected; the message carries rule, edge and context."""
        assert got == expected, (
            f"{rule}: {what}: expected {_show(expected)}, got {_show(got)}\n{self.context()}"
        )

    def check_window(self, rule: str, what: str, got: int, low: int, high: int) -> None:
        """Assert low <= got <= high; the message carries rule, edge and context."""
        assert low <= got <= high, f"{rule}: {what}: expected {low}..{high}, got {got}\n{self.context()}"

    def recording(self) -> Recording:
        """Everything up to now, for `compare`; the last complete clk edge is `now` - 1."""
        return Recording(
            part=self.part.name,
            params=self.part.params(self.config),
            seed=self.seed,
            end=self.now - 1,
            stimulus=list(self.stimulus),
            edges=self._all_edges(),
            accesses=list(self.accesses),
        )

    def _all_edges(self) -> list[Edge]:
        rows = (Edge(t, name, value) for name, changes in self._seen().items() for t, value in changes)
        return sorted(rows, key=lambda edge: edge.t)


def _bit_changes(changes: list[tuple[int, int]], place: int, initial: int) -> list[tuple[int, int]]:
    """Changes (edge, level) of one bit of a port."""
    level, rows = initial >> place & 1, []
    for t, value in changes:
        if value >> place & 1 != level:
            level ^= 1
            rows.append((t, level))
    return rows


def _show(value: Any) -> str:
    if isinstance(value, int) and not isinstance(value, bool):
        return f"{value} ({value:#x})"
    return str(value)
