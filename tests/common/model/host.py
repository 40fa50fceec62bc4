"""A polling host on the pins of a model with a byte bus, for the self-tests of the models."""

from __future__ import annotations

from typing import ClassVar

from openppmc.model.clock import low_times
from openppmc.model.single.codes import IBF, OBF


class ModelHost:
    """A host on the byte bus of a model; `t` is the edge of its next access.

    Each access, pin change or pause advances `t`. Keyword arguments are passed to the device's MODEL.
    """

    MODEL: ClassVar[type]

    def __init__(self, **parameters: object) -> None:
        self.model = self.MODEL(**parameters)
        self.t = 8
        self.mark = 0
        self.written = 0

    # ------------------------------------------------------------------ bus

    def write(self, reg: int, byte: int, gap: int = 2) -> int:
        """Perform one write access; return its write event."""
        edge0 = self.model.write(self.t, reg, byte)
        self.t = edge0 + gap
        self.written = edge0 + 2
        return edge0 + 2

    def read(self, reg: int) -> int:
        """Perform one read access."""
        value = self.model.read(self.t, reg)
        self.t += 6
        return value

    def poll(self, mask: int, value: int, limit: int = 20_000_000) -> int:
        """Read the status until its masked bits equal `value`."""
        end, pause = self.t + limit, 0
        while (status := self.read(1)) & mask != value:
            assert self.t < end, f"status {status:#04x} never showed {mask:#04x} = {value:#04x}"
            pause = min(2000, pause + 2)
            self.t += pause
        return status

    def command(self, code: int) -> int:
        """Write a command byte, wait for IBF = 0, and return the status that was read last."""
        self.write(1, code)
        return self.poll(IBF, 0)

    def data(self, byte: int) -> int:
        """Write a data byte, wait for IBF = 0, and return the status that was read last."""
        self.write(0, byte)
        return self.poll(IBF, 0)

    def fetch(self) -> int:
        """Read the data register after OBF = 1."""
        self.poll(OBF, OBF)
        return self.read(0)

    def run(self, script: str) -> list[int]:
        """Run a script of the acceptance table: c XX, d XX, r, rrr; return the bytes that r has read.

        Each command sets `self.mark`, so that later calls return only the pulses and edges after the last
        command.
        """
        words, got = script.split(), []
        while words:
            word = words.pop(0)
            if word == "c":
                self.mark = self.t
                self.command(int(words.pop(0), 16))
            elif word == "d":
                self.data(int(words.pop(0), 16))
            else:
                got += [self.fetch() for _ in word]
        return got

    def statuses(self, script: str) -> list[int]:
        """Run a script without the statement r; return the status after each byte."""
        words = script.split()
        pairs = zip(words[::2], words[1::2], strict=True)
        return [self.command(int(b, 16)) if kind == "c" else self.data(int(b, 16)) for kind, b in pairs]

    # ------------------------------------------------------------------ time

    def go(self, t: int) -> None:
        """Set the edge of the next access or pin change to t."""
        assert t > self.model.now, (t, self.model.now)
        self.t = t

    def pause(self, clk: int) -> None:
        """Advance the time by `clk` cycles."""
        self.t += clk

    def pins(self, **levels: int) -> None:
        """Set pin levels from edge t on."""
        self.model.pins(self.t, **levels)
        self.t += 1

    def idle(self) -> None:
        """Wait until BUSY = 0 without accesses to the bus."""
        self.sync()
        while self.model.busy:
            self.step()

    def sync(self) -> None:
        """Run the model up to the current edge."""
        self.model.run_until(max(self.model.now, self.t - 1))

    def step(self) -> None:
        """Run to the next event of the model."""
        edge = self.model.next_event
        assert edge is not None, "the model has no further event"
        self.model.run_until(edge)
        self.t = max(self.t, edge + 1)

    def fall(self, n: int, after: int = 0) -> int:
        """Run to the n-th pulse since `mark` and return its edge; the next access is `after` cycles after the
        pulse.
        """
        while len(self.pulses()) < n:
            self.step()
        edge = self.pulses()[n - 1]
        if after:
            self.go(edge + after)
        return edge

    # ------------------------------------------------------------------ outputs

    def pulses(self) -> list[int]:
        """Return the pulses since `mark`."""
        return self.model.log.falls("pout_n", self.mark)

    def intervals(self) -> list[int]:
        """Return the distances between the pulses since `mark` in cycles."""
        pulses = self.pulses()
        return [b - a for a, b in zip(pulses, pulses[1:], strict=False)]

    def lows(self) -> list[int]:
        """Return the low times of the pulses since `mark`."""
        return low_times(self.model.log.of("pout_n", self.mark))

    def out(self, signal: str) -> int:
        """Return the current level of an output."""
        self.sync()
        return self.model.outputs[signal]

    def finish(self) -> tuple[int, int]:
        """Wait for the end of the motion; return finish status and remaining value, read as a host does."""
        self.idle()
        mark = self.mark
        (status,) = self.run("c 80 r")
        low, mid, high = self.run("c 83 rrr")
        self.mark = mark
        return status, low | mid << 8 | high << 16
