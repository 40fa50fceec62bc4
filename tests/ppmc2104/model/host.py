"""A polling host on the pins of the PPMC-2104 model."""

from __future__ import annotations

from openppmc.model.clock import low_times
from openppmc.model.ppmc2104.codes import BUSY, CMND
from openppmc.model.ppmc2104.part import Ppmc2104
from tests.common.model.host import ModelHost

B1 = "c 02 d 63 d 13 d 0A d 00"
B2 = "c 22 d 63 d 13 d 0A d 00"
LONG = " c 43 d E7 d 03 d 00"
# Rates of the ramp that B1 and B2 set, for the ramp indices 0 to 10.
RAMP = [99, 53, 41, 34, 30, 27, 24, 23, 21, 20, 19]


def clk(rates: list[int], base: int = 32) -> list[int]:
    """Return intervals in cycles at 16 MHz; base 32 is the clock of 500 kHz, base 128 that of 125 kHz."""
    return [base * (rate + 1) for rate in rates]


class Host(ModelHost):
    """`ModelHost` of the PPMC-2104.

    Scripts may also contain e1, e2 (read of an error code), idle (wait until both axes are at standstill) and
    ready (wait until no CMND is set). `axis` (1 or 2) is the axis of pulses(), intervals(), lows() and
    fall().
    """

    MODEL = Ppmc2104

    def __init__(self, script: str = "", **parameters: object) -> None:
        pins = {name: parameters.pop(name) for name in ("busc",) if name in parameters}
        super().__init__(**parameters)
        self.axis = 1
        if pins:
            self.pins(**pins)
        self.run(script)

    def run(self, script: str) -> list[int]:
        """Run a script; return the bytes that r, e1 and e2 read."""
        words, got = script.split(), []
        while words:
            word = words.pop(0)
            if word in ("e1", "e2"):
                mark = self.mark
                got += super().run(f"c {'86' if word == 'e1' else 'A6'} r")
                self.mark = mark
            elif word == "idle":
                self.idle()
            elif word == "ready":
                self.poll(CMND[0] | CMND[1], 0)
            elif word in ("c", "d"):
                got += super().run(f"{word} {words.pop(0)}")
            else:
                got += super().run(word)
        return got

    def idle(self) -> None:
        """Wait until BUSY = 0 for both axes, without accesses to the bus."""
        self.sync()
        while self.model.busy(1) or self.model.busy(2):
            self.step()

    def pin(self, name: str, level: int, axis: int = 1) -> None:
        """Set the bit of one axis in an input port."""
        other = self.model.inputs[name] & ~(1 << (axis - 1))
        self.pins(**{name: other | level << (axis - 1)})

    def bit(self, signal: str, axis: int | None = None) -> int:
        """Return the bit of one axis in an output port."""
        return self.out(signal) >> ((axis or self.axis) - 1) & 1

    def pulses(self) -> list[int]:
        """Return the pulses of `axis` since `mark`."""
        return self.model.pulses(self.axis, self.mark)

    def lows(self) -> list[int]:
        """Return the low times of the pulses since `mark`."""
        return low_times(self.model.bits("pout_n", self.axis, self.mark))

    def phases(self) -> list[str]:
        """Return the phase pins of `axis` at each change since `mark`, as five digits S5..S1."""
        return [f"{value:05b}" for _, value in self.model.log.of(f"s{self.axis}_n", self.mark)]

    def status(self) -> int:
        """Read the status."""
        return self.read(1)

    def end(self) -> tuple[int, int]:
        """Wait for the end of `axis`; return end status and remaining value, read as a host does."""
        base = 0x20 * (self.axis - 1)
        mark = self.mark
        self.poll(BUSY[self.axis - 1], 0)
        (status,) = self.run(f"c {0x80 + base:02X} r")
        low, mid, high = self.run(f"c {0x83 + base:02X} rrr")
        self.mark = mark
        return status, low | mid << 8 | high << 16
