"""Host of a bank's register window: it runs on the golden model and records pin changes for the RTL."""

from __future__ import annotations

from typing import NamedTuple

from openppmc.check.records import Change
from openppmc.model.bank import PpmcBank
from openppmc.model.bank.window import DATA, MASK, POSITION, STATUS
from openppmc.model.single.codes import BUSY, IBF

WRITE, READ, GAP = 2, 6, 3
"""Length of a strobe, and of the gap after it, in cycles (BANK-WIN-04)."""
READ_FINISH = 0x80


class Access(NamedTuple):
    """One access of the host.

    Attributes:
        t: first edge at which the strobe is active.
    """

    t: int
    write: bool
    axis: int
    register: int
    byte: int


class Recorder(PpmcBank):
    """Golden model that records the changes of its input pins."""

    stimulus: list[Change]

    def pins(self, t: int, **levels: int) -> None:
        """Record the levels, then set them as the base class does."""
        super().pins(t, **levels)
        self.__dict__.setdefault("stimulus", []).extend(
            Change(t, pin, level) for pin, level in levels.items()
        )


class Session:
    """A host session.

    Axes are numbered from 0, as in the window.

    Attributes:
        t: next free edge.
        accesses: all accesses, in order of time.
    """

    def __init__(self, axes: int, clk_hz: int) -> None:
        self.model = Recorder(axes, clk_hz)
        self.t = 2 * self.model.round + 8
        self.accesses: list[Access] = []

    @property
    def axes(self) -> range:
        """Numbers of the axes."""
        return range(self.model.WIDTHS["pout_n"])

    def _address(self, axis: int, register: int) -> None:
        self.model.pins(self.t, a=axis << 4 | register)
        self.t += 1

    def write(self, axis: int, register: int, byte: int) -> int:
        """Write a byte; return the edge of the write event (BANK-WIN-06)."""
        self._address(axis, register)
        self.accesses.append(Access(self.t, True, axis, register, byte))
        end = self.model.write(self.t, axis << 4 | register, byte, WRITE)
        self.t = end + GAP
        return end + 2

    def read(self, axis: int, register: int) -> int:
        """Read a byte of a register."""
        self._address(axis, register)
        byte = self.model.read(self.t, axis << 4 | register, READ)
        self.accesses.append(Access(self.t, False, axis, register, byte))
        self.t += READ + GAP
        return byte

    def poll(self, axis: int, bits: int = IBF) -> int:
        """Poll the status until all bits of the mask `bits` are 0 in it; return this last status."""
        while (status := self.read(axis, STATUS)) & bits:
            pass
        return status

    def send(self, axis: int, code: int, *data: int) -> int:
        """Send a command and its data, each byte when IBF = 0; return the status after the last byte."""
        self.write(axis, STATUS, code)
        for byte in data:
            self.poll(axis)
            self.write(axis, DATA, byte)
        return self.poll(axis)

    def answer(self, axis: int, code: int, count: int = 1) -> int:
        """Send a read command; return the value of its response bytes, low byte first."""
        self.send(axis, code)
        return sum(self.read(axis, DATA) << 8 * place for place in range(count))

    def group(self, members: int) -> None:
        """Write all bytes of MASK; bit i of the argument is axis i."""
        for k in range((len(self.axes) + 7) // 8):
            self.write(k, MASK, members >> 8 * k & 0xFF)

    def position(self, axis: int) -> int:
        """Return the position from four reads that begin with byte 0 (BANK-WIN-07)."""
        raw = bytes(self.read(axis, POSITION + place) for place in range(4))
        return int.from_bytes(raw, "little", signed=True)

    def idle(self, axis: int) -> None:
        """Wait for the end of a motion; the status is polled every 1000 cycles."""
        while self.poll(axis) & BUSY:
            self.t += 1000

    def run(self, edge: int) -> None:
        """Run up to an edge without making an access."""
        self.model.run_until(edge)
        self.t = max(self.t, edge + 1)
