"""Hosts with models that run together with the part: other parts on the line, or a motor."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping

from cocotb_tests.harness import DutBench
from cocotb_tests.harness.line import Changes
from openppmc.model.pmc006.bench.motor import Motor, Plant

from .host import Host


class Stepping(Host):
    """Host that advances from event to event of the golden model and updates the other models at each
    event.
    """

    @abstractmethod
    async def _to(self, edge: int) -> None:
        """Run to just before an edge."""

    async def _drive(self, changes: Changes) -> None:
        for edge, level in changes:
            if self.bench.pin("rxd") != level:
                await self._to(max(edge, self.bench.now))
                self.bench.set(rxd=level)

    async def until(self, signal: str, level: int, limit_us: float = 1_000_000) -> int:
        """Run until a signal has this level; return the edge of its last change."""
        end = self.t + self.us(limit_us)
        await self.sync()
        while self.bench.level(signal) != level:
            event = self.bench.next_event
            assert event is not None and event <= end, f"{signal} does not become {level}"
            await self.go(max(self.t, event + 1))
        return max((t for t, _ in self.edges(signal)[-1:]), default=0)


class _PartView:
    """The part as the motor model sees it: its outputs, and the times at which they may change."""

    def __init__(self, bench: DutBench) -> None:
        self._bench = bench
        self.outputs: Mapping[str, int] = _Levels(bench)

    @property
    def now(self) -> int:
        """Last edge that was run."""
        return self._bench.now - 1

    @property
    def next_event(self) -> int | None:
        """Next edge at which the part has an event."""
        return self._bench.next_event

    def run_until(self, t: int) -> None:
        """Not implemented: the host runs the part."""
        raise NotImplementedError

    def pins(self, t: int, **levels: int) -> None:
        """Not implemented: the host sets the pins."""
        raise NotImplementedError


class _Levels(dict[str, int]):
    """Current levels of the outputs."""

    def __init__(self, bench: DutBench) -> None:
        super().__init__()
        self._bench = bench

    def __missing__(self, name: str) -> int:
        return self._bench.level(name)


class MotorHost(Stepping):
    """Host of a part whose bridges drive a motor after a call of `attach`."""

    plant: Plant | None = None

    def attach(self, motor: Motor | None = None) -> Plant:
        """Connect a motor from now on."""
        self.plant = Plant(_PartView(self.bench), self.clk_hz, motor)
        return self.plant

    def detach(self) -> None:
        """Disconnect the motor; the comparators keep their levels."""
        self.plant = None

    async def _to(self, edge: int) -> None:
        if self.plant:
            for t, levels in self.plant.pieces(edge - 1):
                await self.bench.until(t + 1)
                self.bench.set(**levels)
        else:
            await self.bench.until(edge)
