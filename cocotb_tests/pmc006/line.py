"""Two PMC006 on one pair of wires. rxd of each part is the AND of the host's level and the txd of all parts.

One of them is the part under test; the other is a golden model.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import DutBench, ModelBench, OnModel, start_bench
from cocotb_tests.harness.line import Changes

from .bench import PMC006
from .stepping import Stepping


class Line:
    """Common time and wires of the parts. A level that a part drives at edge t is on the wires at edge t +
    1.
    """

    def __init__(self, *benches: DutBench) -> None:
        self.benches = benches
        self.t = 1
        self._host = 1

    @classmethod
    async def start(cls, dut: Any, first: bool) -> tuple[Node, Node]:
        """Return two nodes just out of reset.

        Args:
            first: True if the first node is the part under test, False if it is the second.
        """
        part = await start_bench(dut, PMC006, settle=0, sda_i=0)
        other = ModelBench(PMC006, OnModel(part.config), 0, sda_i=0)
        line = cls(*((part, other) if first else (other, part)))
        return Node(line, 0), Node(line, 1)

    @property
    def now(self) -> int:
        """Next edge, which is the same for all parts."""
        return self.benches[0].now

    async def drive(self, t: int, level: int) -> None:
        """Set the level that the host drives from edge t on."""
        await self.until(max(t, self.now))
        self._host = level
        self._settle()

    async def until(self, t: int) -> None:
        """Run all parts to edge t, from event to event, because each transmission of a part begins with an
        event of its golden model.
        """
        while self.now < t:
            events = [bench.next_event for bench in self.benches]
            edge = min([t, *(event + 1 for event in events if event is not None)])
            for bench in self.benches:
                await bench.until(edge)
            self._settle()

    def _settle(self) -> None:
        level = int(self._host and all(bench.level("txd") for bench in self.benches))
        for bench in self.benches:
            bench.set(rxd=level)


class Node(Stepping):
    """Host that is connected to one of the parts on the line."""

    def __init__(self, line: Line, number: int) -> None:
        self.line = line
        super().__init__(line.benches[number])
        self.t = 1

    @property
    def t(self) -> int:  # type: ignore[override]
        """Next free edge, which is the same for all nodes."""
        return self.line.t

    @t.setter
    def t(self, t: int) -> None:
        self.line.t = t

    async def _to(self, edge: int) -> None:
        await self.line.until(edge)

    async def _drive(self, changes: Changes) -> None:
        for edge, level in changes:
            await self.line.drive(edge, level)

    async def ask_other(self, other: Node, code: str, data: int = 0) -> int:
        """Send a frame to another node on the same line, after the last frame; return its reply data."""
        other.middle, other._free = self.middle, self._free
        return await other.ask(code, data)
