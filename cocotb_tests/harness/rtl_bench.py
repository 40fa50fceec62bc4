"""`RtlBench`: the RTL of one device in a simulation, with clock, reset, pin driver and edge monitors.

Pins are driven on falling edges. A change made now has the stamp `bench.now`, the next rising edge. Clock,
pins and the recorder of output edges belong to the main program of the simulation (`SimBackend`).
"""

from __future__ import annotations

import os
from collections.abc import Coroutine, Iterable
from pathlib import Path
from typing import Any

import cocotb
from cocotb.handle import Immediate
from cocotb.triggers import First, Timer

from cocotb_tests.harness import watchdog
from openppmc.check.records import Change

from .config import F16, Config
from .dut_bench import TIMEOUT, DutBench, PinChange
from .jitter import LATE, StageLog, jitters
from .part import Part
from .sim_backend import collect_seldom, sim_backend


class RtlBench(DutBench):
    """The RTL of a device on the test bench; create it with `await RtlBench.start(dut, part)`.

    Members in addition to those of `DutBench`: `out` (Path for the files of this run) and `repro` (the
    command that repeats the run).
    """

    def __init__(self, dut: Any, part: Part, seed: int | None = None) -> None:
        text = os.environ.get("OPENPPMC_CONFIG", "")
        super().__init__(
            part,
            Config.from_json(text) if text else F16,
            int(os.environ.get("OPENPPMC_SEED", "1")) if seed is None else seed,
        )
        self.dut = dut
        self.out = Path(os.environ.get("OPENPPMC_OUT", "."))
        self.repro = os.environ.get("OPENPPMC_REPRO", "")
        self.period = self.config.period_ps
        self.half = self.period // 2
        self._edges: dict[str, list[tuple[int, int]]] = {}
        self._watched: dict[int, list[tuple[int, int]]] = {}
        self._stages: dict[str, list[tuple[int, int]]] = {}
        part = self.part
        self._handles = {name: getattr(dut, name) for name in (*part.inputs, "rst_n", *part.outputs)}
        self._backend = sim_backend()
        self._time = self._backend.now
        self._ports = {name: self._backend.port(name) for name in self._handles}
        self._t0 = 0

    # ---------------------------------------------------------------- start

    @classmethod
    async def start(
        cls,
        dut: Any,
        part: Part,
        reset_clk: int = 4,
        settle: int = 4,
        seed: int | None = None,
        **pins: int,
    ) -> RtlBench:
        """Start clk, drive rst_n high, low and high, and return a bench with `now` = settle.

        The devices accept bytes from edge 4 on (P104-PORT-03). With settle = 0, the method returns before
        edge 0. `pins` replace idle input levels; these levels have the stamp 0. `reset_clk` is the length of
        the reset in cycles (at least 2). `seed` replaces the seed of the run.
        """
        bench = cls(dut, part, seed)
        part = bench.part
        watchdog.arm()
        collect_seldom()
        # All registers start at random levels, so no edge of `clk` may occur before rst_n has fallen, not
        # even at time 0. In Icarus Verilog, signals start without a level, and a value set before the first
        # evaluation has no effect.
        at_once = int if cocotb.SIM_NAME.startswith("Icarus") else Immediate
        dut.clk.set(at_once(0))
        dut.rst_n.set(at_once(1))
        for pin, level in {**part.inputs, **pins}.items():
            bench._handles[pin].value = level
            bench.pins[pin] = level
        await Timer(bench.half, "ps")
        dut.rst_n.value = 0
        # Each falling edge occurs half a period after a rising edge; the first edge is a rising edge.
        bench._backend.clock(bench._backend.port("clk"), bench.half)
        await Timer(bench.period * max(2, reset_clk), "ps")
        bench._t0 = bench._time() + bench.half
        bench._handles["rst_n"].value = 1
        bench.pins["rst_n"] = 1
        for pin, level in pins.items():
            if level != part.inputs[pin]:
                bench.stimulus.append(Change(0, pin, level))
        bench._backend.changes()  # discards changes recorded for an earlier bench
        for name in part.watched:
            bench.watch(name)
        if jitters() and part.stages:
            bench.watch_stages()
        if settle:
            await bench.until(settle)
        return bench

    def watch(self, output: str) -> None:
        """Record the edges of an output from now on; only outputs of `part.unwatched` need this call."""
        self.initial[output] = self.level(output)
        self._edges[output] = []
        port = self._ports[output]
        self._watched[port] = self._edges[output]
        self._backend.watch(port)

    def watch_stages(self) -> None:
        """Record which changes the synchronisers sample late, for the golden model."""
        self.stage_log = StageLog(self.part)
        for path in self.part.stages:
            port = self._backend.port(f"{path}.{LATE}")
            self._stages[path] = []
            self._watched[port] = self._stages[path]
            self._backend.watch(port)

    def _sampled_changes(self, log: StageLog, changes: list[Change]) -> list[Change]:
        """See `DutBench._sampled_changes`."""
        self._output_changes()
        log.add(changes, self._stages, self.now)
        return log.changes

    # ---------------------------------------------------------------- time

    def sim_time(self) -> int:
        """Return the simulation time in ps."""
        return self._time()

    def edge_time(self, edge: int) -> int:
        """Return the simulation time of rising edge `edge` in ps."""
        return self._t0 + edge * self.period

    @property
    def now(self) -> int:
        """See `DutBench.now`."""
        return (self._time() - self._t0) // self.period + 1

    async def until(self, edge: int) -> int:
        """See `DutBench.until`."""
        target = self._t0 + (edge - 1) * self.period + self.half
        delta = target - self._time()
        if delta < 0:
            if self.now == edge:
                return edge
            raise ValueError(f"until({edge}): it is already edge {self.now}")
        if delta:
            await Timer(delta, "ps")
        return edge

    async def align(self) -> int:
        """See `DutBench.align`."""
        target = self._t0 + (self.now - 1) * self.period + self.half
        delta = target - self._time()
        if delta > 0:
            await Timer(delta, "ps")
        return self.now

    # ---------------------------------------------------------------- pins

    def set(self, **levels: int) -> int:
        """See `DutBench.set`."""
        stamp = self.now
        if self._t0 + (stamp - 1) * self.period + self.half > self._time():
            raise RuntimeError("RtlBench.set() in the high half of clk: await bench.align() first")
        for pin, level in levels.items():
            if self.pin(pin) != level:
                self._drive(stamp, pin, level)
        return stamp

    def _drive(self, stamp: int, pin: str, level: int) -> None:
        port, level = self._levelled(pin, level)
        self.pins[port] = level
        self._backend.put(self._ports[port], level)
        self.stimulus.append(Change(stamp, port, level))

    def set_between_edges(self, **levels: int) -> int:
        """Drive input pins as `set` does, but at any moment.

        This is for asynchronous events such as a change of rst_n between two edges.
        """
        stamp = self.now
        for pin, level in levels.items():
            self._drive(stamp, pin, level)
        return stamp

    async def set_between(self, share: float = 0.5, /, **levels: int) -> int:
        """See `DutBench.set_between`."""
        await self.align()
        await Timer(max(2, int(self.half * share) // 2 * 2), "ps")
        stamp = self.set_between_edges(**levels)
        await Timer(2, "ps")
        return stamp

    def drive(self, changes: Iterable[PinChange]) -> Any:
        """See `DutBench.drive`. Return the task."""

        async def run() -> None:
            fall = self._t0 - self.half
            for edge, levels in changes:
                delta = fall + edge * self.period - self._time()
                if delta > 0:
                    await Timer(delta, "step")
                else:
                    await self.until(edge)
                for pin, level in levels.items():
                    if self.pin(pin) != level:
                        self._drive(edge, pin, level)

        return self._start(run())

    def _start(self, what: Coroutine[Any, Any, None]) -> Any:
        task = cocotb.start_soon(what)
        self._later.append(task)
        return task

    # ---------------------------------------------------------------- outputs

    def forget(self) -> None:
        """Discard all recorded output edges and pin changes, so that a test can run devices one by one."""
        self.stimulus.clear()
        for changes in self._output_changes().values():
            changes.clear()

    def _index(self, time: int) -> int:
        """Return the edge that causes a change at a time; for an asynchronous change, the next edge."""
        return -((self._t0 - time) // self.period)

    def _output_changes(self) -> dict[str, list[tuple[int, int]]]:
        """See `DutBench._output_changes`."""
        t0, period, watched = self._t0, self.period, self._watched
        for time, port, value in self._backend.changes():
            changes, t = watched[port], -((t0 - time) // period)
            if changes and changes[-1][0] == t:
                changes[-1] = (t, value)
            else:
                changes.append((t, value))
        return self._edges

    @property
    def outputs(self) -> tuple[str, ...]:
        """All outputs of the device."""
        return tuple(self.part.outputs)

    def _port_level(self, port: str) -> int:
        return self._backend.read(self._ports[port])

    # ---------------------------------------------------------------- waiting for outputs

    async def edge(self, output: str, level: int | None = None, timeout: int = TIMEOUT) -> int:
        """See `DutBench.edge`."""
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
            # If only other bits of the same port have changed, the wait continues.
            was, before = before, self.level(output)
            if before != was and level in (None, before):
                t = self._index(self._time())
                await self.align()
                return t
        want = "a change" if level is None else f"level {level}"
        raise TimeoutError(f"no {want} of {output} within {timeout} cycles\n{self.context()}")
