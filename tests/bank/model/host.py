"""A host on the window of the bank's model, for the self-tests of the model."""

from __future__ import annotations

from openppmc.model.bank import PpmcBank
from openppmc.model.bank.window import CONFIG, DATA, GO, MASK, POSITION, STATUS, STOP
from openppmc.model.single.codes import IBF

GAP = 3
INIT_A = "c 0A d 09 d 04 d 04 d 00"
INIT_B = "c 0A d 13 d 09 d 0A d 00"


class Host:
    """Host whose next free edge is `t`.

    Defaults: 8 axes, 100 MHz; then R = 8, W = 500, and a quantum has 25 cycles.
    """

    def __init__(self, axes: int = 8, **parameters: int) -> None:
        self.model = PpmcBank(axes, **parameters)
        self.axes = axes
        self.w = self.model.timebase.w
        self.t = 4 * self.model.round + 8

    # ------------------------------------------------------------------ accesses

    def write(self, axis: int, register: int, byte: int) -> int:
        """Make a write access and return its write event."""
        event = self.model.write(self.t, axis << 4 | register, byte) + 2
        self.t = event - 2 + GAP
        return event

    def write_at(self, event: int, axis: int, register: int, byte: int) -> None:
        """Make a write access whose write event is on this edge."""
        assert event - 4 >= self.t, (event, self.t)
        self.t = event - 4
        assert self.write(axis, register, byte) == event

    def read(self, axis: int, register: int) -> int:
        """Make a read access."""
        value = self.model.read(self.t, axis << 4 | register)
        self.t += 6 + GAP
        return value

    def send(self, axis: int, script: str) -> int:
        """Send bytes "c XX d XX …", each after the previous one was accepted; return the visit that accepted
        the last byte.
        """
        words = script.split()
        for kind, byte in zip(words[::2], words[1::2], strict=True):
            self.write(axis, STATUS if kind == "c" else DATA, int(byte, 16))
            self.sync()
            while self.status(axis) & IBF:
                self.step()
        return self.model.now

    def ready(self, axis: int, script: str = INIT_A) -> None:
        """Initialise the axis and wait until its ramp table is built."""
        self.send(axis, script)
        self.t += 5000

    def answer(self, axis: int, code: int, count: int = 1) -> int:
        """Send a read command and return its bytes as a number, low byte first."""
        self.send(axis, f"c {code:02X}")
        return sum(self.read(axis, DATA) << 8 * place for place in range(count))

    def finish(self, axis: int) -> tuple[int, int]:
        """Wait for the end of the motion; return finish status and remaining pulses."""
        self.idle(axis)
        return self.answer(axis, 0x80), self.answer(axis, 0x83, 3)

    def mask(self, bits: int) -> None:
        """Write all bytes of MASK."""
        for k in range((self.axes + 7) // 8):
            self.write(k, MASK, bits >> 8 * k & 0xFF)
        self.t += self.model.round

    def position(self, axis: int) -> int:
        """Return the signed position of an axis, read byte by byte."""
        value = sum(self.read(axis, POSITION + place) << 8 * place for place in range(4))
        return value - (value >> 31 << 32)

    # ------------------------------------------------------------------ time

    def sync(self) -> None:
        """Run up to the current edge."""
        self.model.run_until(max(self.model.now, self.t - 1))

    def step(self) -> None:
        """Run to the next event."""
        edge = self.model.next_event
        assert edge is not None, "nothing happens any more"
        self.go(edge)

    def go(self, edge: int) -> None:
        """Run up to and including an edge."""
        self.model.run_until(edge)
        self.t = max(self.t, edge + 1)

    def pin(self, edge: int, axis: int, **levels: int) -> None:
        """Set pin levels of one axis, first sampled by this edge."""
        for name, level in levels.items():
            others = self.model.inputs[name] & ~(1 << axis)
            self.model.pins(edge, **{name: others | level << axis})
        self.t = max(self.t, edge + 1)

    def idle(self, axis: int) -> int:
        """Run until BUSY falls; return this edge."""
        self.sync()
        while self.model.busy(axis):
            self.step()
        return self.model.now

    def visit(self, axis: int, later: int = 40) -> int:
        """Return the edge of a visit of an axis, at least `later` cycles after the present edge."""
        return self.model.visit(axis, max(self.t, self.model.now + 1) + later)

    # ------------------------------------------------------------------ results

    def status(self, axis: int) -> int:
        """Return the status register after edge `now`."""
        return self.model.status(axis)

    def out(self, signal: str, axis: int) -> int:
        """Return the current level of the bits of one axis in an output."""
        width = 5 if signal == "s" else 1
        return self.model.outputs[signal] >> width * axis & ((1 << width) - 1)

    def changes(self, signal: str, axis: int, since: int) -> list[tuple[int, int]]:
        """Return the changes of a motor pin that happen on or after an edge."""
        return self.model.bits(signal, axis, since)


__all__ = ["CONFIG", "DATA", "GO", "INIT_A", "INIT_B", "MASK", "POSITION", "STATUS", "STOP", "Host"]
