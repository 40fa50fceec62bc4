"""What all hosts of directed tests for the PPMC-312 have in common: its pulses and its state."""

from __future__ import annotations

from cocotb_tests.harness.bus import SideHost

TICK = 16
"""clk of a tick at F = 1 MHz and a clock of 16 MHz."""


class SideHost(SideHost):
    """Host of one PPMC-312; `mark` is where pulses are counted from."""

    @property
    def condition(self) -> int:
        """Condition byte of the status read, without asking for it: that of the golden model."""
        return int(self.side.golden.state)

    async def pulse(self, number: int, after: int = 0) -> int:
        """Wait for pulse `number` since `mark`, and `after` clk more; returns the pulse's edge."""
        for _ in range(number - len(self.pulses())):
            await self.side.edge("pout", 1)
        edge = self.pulses()[number - 1]
        await self.side.until(max(self.t, edge + 1 + after))
        return edge

    def pulses(self) -> list[int]:
        """Rising edges of pout since `mark`."""
        return self.side.rises("pout", self.mark)

    def gaps(self, tick: int = TICK) -> list[int]:
        """Their distances in ticks of so many clk; not whole ones are an error."""
        edges = self.pulses()
        clk = [b - a for a, b in zip(edges, edges[1:], strict=False)]
        assert not any(gap % tick for gap in clk)
        return [gap // tick for gap in clk]
