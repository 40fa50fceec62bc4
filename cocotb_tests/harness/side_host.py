"""What all hosts of directed tests have in common: a side, the pins of a part, its output levels."""

from __future__ import annotations

from .side import Side


class SideHost:
    """Works on `side`, the RTL or the golden model. `mark` is the edge where counting begins."""

    def __init__(self, side: Side) -> None:
        self.side = side
        self.mark = 0

    @property
    def t(self) -> int:
        """The next edge: pins that change now are first seen there."""
        return self.side.now

    async def go(self, t: int) -> None:
        """Wait until just before edge t; ValueError if that has passed."""
        await self.side.until(t)

    async def pause(self, clk: int) -> None:
        """Let time pass."""
        await self.side.clocks(clk)

    async def pins(self, **levels: int) -> None:
        """Pin levels from the next edge on; returns a clk later."""
        self.side.set(**levels)
        await self.side.clocks(1)

    async def blip(self, pin: str, clk: int = 20, gap: int = 2000) -> None:
        """A low pulse on a pin, then time for its processing."""
        await self.pins(**{pin: 0})
        await self.pause(clk)
        await self.pins(**{pin: 1})
        await self.pause(gap)

    async def step(self) -> None:
        """Wait until the next event of the golden model is over: a good moment to look at the part again."""
        edge = self.side.golden.next_event
        assert edge is not None, f"nothing happens any more\n{self.side.context()}"
        await self.side.until(max(self.t, edge + 1))

    def out(self, signal: str) -> int:
        """Present output level."""
        return self.side.level(signal)
