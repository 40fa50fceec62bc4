"""What all hosts of scripts have in common: a golden model, its tape, time, pins, output levels."""

from __future__ import annotations

from typing import Any

from .tape import Tape


class Script:
    """`t` is the next free edge; every method moves it on.

    `parameters` are those of the top module, in lower case. `mark` is where counting begins.
    """

    model: Any

    def __init__(self, part: str, model: Any, parameters: dict[str, object]) -> None:
        self.model = model
        self.tape = Tape(part, model, {name.upper(): value for name, value in parameters.items()})
        self.t = 0
        self.mark = 0

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

    def step(self) -> None:
        """Run to the next event of the model."""
        edge = self.model.next_event
        assert edge is not None, "nothing happens any more"
        self.go(max(self.t, edge + 1))

    def out(self, signal: str) -> int:
        """Present output level."""
        self.sync()
        level: int = self.model.outputs[signal]
        return level
