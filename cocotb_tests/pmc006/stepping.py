"""Hosts with something beside the part that has to move with it: other parts on the line, a motor."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping

from cocotb_tests.harness import Side
from cocotb_tests.harness.line import Changes
from openppmc.model.pmc006.bench.motor import Motor, Plant

from .host import Host


class Stepping(Host):
    """Its time passes from event to event of the golden model; what is beside the part is looked at there."""

    @abstractmethod
    async def _to(self, edge: int) -> None:
        """As `Side.until`."""

    async def _drive(self, changes: Changes) -> None:
        for edge, level in changes:
            if self.side.pin("rxd") != level:
                await self._to(max(edge, self.side.now))
                self.side.set(rxd=level)

    async def until(self, signal: str, level: int, limit_us: float = 1_000_000) -> int:
        """As `View.until`."""
        end = self.t + self.us(limit_us)
        await self.sync()
        while self.side.level(signal) != level:
            event = self.side.golden.next_event
            assert event is not None and event <= end, f"{signal} does not become {level}"
            await self.go(max(self.t, event + 1))
        return max((t for t, _ in self.edges(signal)[-1:]), default=0)


class _Seen:
    """The part as the motor sees it: its outputs on the side, and when they may change."""

    def __init__(self, side: Side) -> None:
        self._side = side
        self.outputs: Mapping[str, int] = _Levels(side)

    @property
    def now(self) -> int:
        """The last edge that was run."""
        return self._side.now - 1

    @property
    def next_event(self) -> int | None:
        """The next edge on which anything happens by itself."""
        event: int | None = self._side.golden.next_event
        return event

    def run_until(self, t: int) -> None:
        """The host does that."""
        raise NotImplementedError

    def pins(self, t: int, **levels: int) -> None:
        """The host does that."""
        raise NotImplementedError


class _Levels(dict[str, int]):
    """Present levels of the outputs."""

    def __init__(self, side: Side) -> None:
        super().__init__()
        self._side = side

    def __missing__(self, name: str) -> int:
        return self._side.level(name)


class MotorHost(Stepping):
    """A host of a part whose bridges drive a motor, once `attach` has been called."""

    plant: Plant | None = None

    def attach(self, motor: Motor | None = None) -> Plant:
        """A motor from now on."""
        self.plant = Plant(_Seen(self.side), self.clk_hz, motor)
        return self.plant

    def detach(self) -> None:
        """No motor any more; the comparators stay as they are."""
        self.plant = None

    async def _to(self, edge: int) -> None:
        if self.plant:
            for t, levels in self.plant.legs(edge - 1):
                await self.side.until(t + 1)
                self.side.set(**levels)
        else:
            await self.side.until(edge)
