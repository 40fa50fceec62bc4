"""Base class of all hosts of directed tests for the PPMC-312: pulses and state."""

from __future__ import annotations

from cocotb_tests.harness.bus import DutHost

TICK = 16
"""Cycles of a tick at F = 1 MHz and a clock of 16 MHz."""


class DirectedHost(DutHost):
    """Host of one PPMC-312; pulses are counted from `mark`."""

    @property
    def condition(self) -> int:
        """Condition byte of the status read, obtained from the golden model without a bus access."""
        return int(self.bench.golden.state)

    async def pulse(self, number: int, after: int = 0) -> int:
        """Wait for pulse `number` since `mark`, then for `after` cycles; return the edge of the pulse."""
        for _ in range(number - len(self.pulses())):
            await self.bench.edge("pout", 1)
        edge = self.pulses()[number - 1]
        await self.bench.until(max(self.t, edge + 1 + after))
        return edge

    def pulses(self) -> list[int]:
        """Return the rising edges of pout since `mark`."""
        return self.bench.rises("pout", self.mark)

    def gaps(self, tick: int = TICK) -> list[int]:
        """Return the intervals of the pulses in ticks of `tick` cycles; each must be a whole number of
        ticks.
        """
        edges = self.pulses()
        clk = [b - a for a, b in zip(edges, edges[1:], strict=False)]
        assert not any(gap % tick for gap in clk)
        return [gap // tick for gap in clk]
