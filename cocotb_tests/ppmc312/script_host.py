"""What all hosts of scripts for the PPMC-312 have in common: a golden model, its tape, time, pins, pulses."""

from __future__ import annotations

from cocotb_tests.common.tape import Tape
from openppmc.model.ppmc312 import Ppmc312

TICK = 16
"""clk of a tick at F = 1 MHz and a clock of 16 MHz."""


class Script:
    """`t` is the next free edge; every method moves it on. Keyword arguments go to the model."""

    def __init__(self, **parameters: object) -> None:
        self.model = Ppmc312(**parameters)  # type: ignore[arg-type]
        self.tape = Tape("ppmc312", self.model, {name.upper(): value for name, value in parameters.items()})
        self.t = 8
        self.mark = 0

    @property
    def condition(self) -> int:
        """Condition byte of the status read, without asking for it."""
        self.sync()
        return int(self.model.state)

    # ------------------------------------------------------------------ time

    def go(self, t: int) -> None:
        """Run to just before edge t; the next access or pin change is there."""
        self.t = t
        self.sync()

    def pause(self, clk: int) -> None:
        """Let time pass."""
        self.go(self.t + clk)

    def sync(self) -> None:
        """Run the model up to the present."""
        self.model.run_until(max(self.model.now, self.t - 1))

    def pins(self, **levels: int) -> None:
        """Pin levels from edge t on."""
        self.model.pins(self.t, **levels)
        self.t += 1

    def blip(self, pin: str, clk: int = 20, gap: int = 2000) -> None:
        """A low pulse on a pin, then time for its processing."""
        self.pins(**{pin: 0})
        self.pause(clk)
        self.pins(**{pin: 1})
        self.pause(gap)

    def pulse(self, number: int, after: int = 0) -> int:
        """Run to pulse `number` since `mark`; the next access is `after` clk later."""
        while len(self.pulses()) < number:
            self.step()
        edge = self.pulses()[number - 1]
        self.go(max(self.t, edge + 1 + after))
        return edge

    def step(self) -> None:
        """Run to the next event of the model."""
        edge = self.model.next_event
        assert edge is not None, "nothing happens any more"
        self.go(max(self.t, edge + 1))

    # ------------------------------------------------------------------ what was seen

    def pulses(self) -> list[int]:
        """Rising edges of pout since `mark`."""
        return self.model.log.rises("pout", self.mark)

    def gaps(self, tick: int = TICK) -> list[int]:
        """Their distances in ticks of so many clk; not whole ones are an error."""
        edges = self.pulses()
        clk = [b - a for a, b in zip(edges, edges[1:], strict=False)]
        assert not any(gap % tick for gap in clk)
        return [gap // tick for gap in clk]

    def out(self, signal: str) -> int:
        """Present output level."""
        self.sync()
        return self.model.outputs[signal]
