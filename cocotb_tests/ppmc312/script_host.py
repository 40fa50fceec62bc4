"""What all hosts of scripts for the PPMC-312 have in common: the golden model and its pulses."""

from __future__ import annotations

from cocotb_tests.harness import script
from openppmc.model.ppmc312.part import Ppmc312

TICK = 16
"""clk of a tick at F = 1 MHz and a clock of 16 MHz."""


class Script(script.Script):
    """`t` is the next free edge; every method moves it on. Keyword arguments go to the model."""

    model: Ppmc312

    def __init__(self, **parameters: object) -> None:
        super().__init__("ppmc312", Ppmc312(**parameters), parameters)  # type: ignore[arg-type]
        self.t = 8

    @property
    def condition(self) -> int:
        """Condition byte of the status read, without asking for it."""
        self.sync()
        return int(self.model.state)

    def pulse(self, number: int, after: int = 0) -> int:
        """Run to pulse `number` since `mark`; the next access is `after` clk later."""
        while len(self.pulses()) < number:
            self.step()
        edge = self.pulses()[number - 1]
        self.go(max(self.t, edge + 1 + after))
        return edge

    def pulses(self) -> list[int]:
        """Rising edges of pout since `mark`."""
        return self.model.log.rises("pout", self.mark)

    def gaps(self, tick: int = TICK) -> list[int]:
        """Their distances in ticks of so many clk; not whole ones are an error."""
        edges = self.pulses()
        clk = [b - a for a, b in zip(edges, edges[1:], strict=False)]
        assert not any(gap % tick for gap in clk)
        return [gap // tick for gap in clk]
