"""A host on the pins of the STMC's golden model, for the tables and pictures of its manual."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from openppmc.model.stmc.part import Stmc

CLK_HZ = 16_000_000
TICK = 1280  # cycles of a tick of the internal clock, 12.5 kHz
IBF, OBF = 2, 1
FINISH, REMAINING = 0x80, 0x83


@dataclass(frozen=True)
class Outcome:
    """Result of a motion: edges of its steps, gaps in ticks, finish status, remaining steps."""

    steps: list[int]
    gaps: list[int]
    finish: int
    remaining: int


class Bench:
    """The model at 16 MHz with a polling host.

    Keywords are passed to the model.

    Attributes:
        t: next free edge.
    """

    def __init__(self, timing: str = "FAST", **parameters: object) -> None:
        self.chip = Stmc(timing=timing, **parameters)  # type: ignore[arg-type]
        self.t = 8
        self.mark = 0

    def write(self, reg: int, byte: int) -> int:
        """Write a byte without polling; return the first edge without the strobe."""
        edge = self.chip.write(self.t, reg, byte)
        self.t = edge + 3
        return edge

    def taken(self) -> int:
        """Wait until the last written byte is accepted; return the edge."""
        self.chip.run_until(self.t)
        if self.chip.status & IBF:
            self.until(lambda: not self.chip.status & IBF)
        self.t = self.chip.now + 1
        return self.chip.now

    def send(self, code: int, *data: int) -> int:
        """Send a command and its data with polling; return the first edge without the last strobe."""
        edge = self.write(1, code)
        for byte in data:
            self.taken()
            edge = self.write(0, byte)
        return edge

    def init(self, code: int, slow: int, fast: int, ramp: int) -> int:
        """Initialise and wait for the table; return the edge at which the next byte was accepted."""
        self.send(code, slow, fast, ramp & 0xFF, ramp >> 8)
        self.taken()
        self.write(1, FINISH)
        return self.taken()

    def until(self, seen: Callable[[], bool], limit: int = 1 << 34) -> int:
        """Run from event to event until `seen`; return the edge."""
        chip = self.chip
        chip.run_until(max(chip.now, self.t - 1))
        while not seen():
            event = chip.next_event
            if event is None or event > limit:
                raise RuntimeError("the model has no further event before the expected one")
            chip.run_until(event)
        self.t = max(self.t, chip.now + 1)
        return chip.now

    def steps(self) -> list[int]:
        """Return the edges of the steps since `mark`, without a chopper."""
        return [t for t, _ in self.chip.log.of("s", self.mark)]

    def in_gap(self, gap: int) -> None:
        """Run into gap i of the last motion."""
        self.until(lambda: len(self.steps()) > gap)
        self.t = self.chip.now + 300

    def start(self, code: int, *data: int) -> int:
        """Send a motion command; its steps count from here. Return value as for `send`."""
        self.mark = self.t
        return self.send(code, *data)

    def end(self, tick: int = TICK) -> Outcome:
        """Wait for the end of the motion; return its result."""
        self.taken()
        self.until(lambda: not self.chip.busy)
        edges = self.steps()
        gaps = [round((b - a) / tick) for a, b in pairwise(edges)]
        return Outcome(edges, gaps, self.chip.finish, self.chip.remaining)


def little(value: int, count: int = 3) -> list[int]:
    """Return the data bytes of a number, low byte first."""
    return list(value.to_bytes(count, "little"))
