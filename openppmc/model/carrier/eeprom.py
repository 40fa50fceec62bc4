"""Serial EEPROM of the 24C32 class at pin level.

The EEPROM has 4096 bytes, pages of 32 bytes, a write time and acknowledge polling.

The device samples both lines at edges of `clk`. If it pulls a line low or releases it, the line changes at
the same edge. The user calls `on_lines` at every edge at which a level differs from the previous edge, and at
edge `due`. At other edges, the state does not change.
"""

from __future__ import annotations

from typing import NamedTuple

SIZE, PAGE = 4096, 32
BLANK = 0xFF


class Written(NamedTuple):
    """A page write: edge of its STOP, address of its first byte, and its bytes in order of reception."""

    t: int
    address: int
    data: bytes


class Eeprom24C32:
    """EEPROM. Its initial state is the state after power-up.

    Args:
        clk_hz: cycles per second.
        content: at most 4096 bytes from address 0 on; all other bytes of the memory are FF.
        device: 7-bit address.
        write_us: duration of a write cycle, 0 or more.
        stretch_us: time for which the device holds SCL low after each acknowledge.
        missing: True if no device is connected.

    Raises:
        ValueError: the content is too long.

    Attributes:
        sda, scl: 1 while the device pulls the line low.
        memory: content.
        writes: all page writes.
        stuck_sda, stuck_scl: True while the device holds the line low as a fault. A change is effective from
            the next call of `on_lines` on.
    """

    def __init__(
        self,
        clk_hz: int,
        content: bytes = b"",
        device: int = 0x50,
        write_us: int = 5_000,
        stretch_us: int = 0,
        missing: bool = False,
    ) -> None:
        if len(content) > SIZE:
            raise ValueError(f"{len(content)} bytes do not fit into {SIZE}")
        self.memory = bytearray(content).ljust(SIZE, bytes([BLANK]))
        self.device, self.missing = device, missing
        self.write_clk = -(-write_us * clk_hz // 1_000_000)
        self.stretch_clk = -(-stretch_us * clk_hz // 1_000_000)
        self.stuck_sda = self.stuck_scl = False
        self.writes: list[Written] = []
        self.sda = self.scl = 0
        self.due: int | None = None
        self._lines = (1, 1)
        self._busy_until = -1
        self._address = 0
        self._pull = 0
        self._holds_scl = 0
        self._idle()

    def _idle(self) -> None:
        """Change to the state in which the device waits for a START."""
        self._phase = ""
        self._bits = self._shift = 0
        self._pull = 0
        self._page: list[int] = []

    def occupy(self, until: int) -> None:
        """Continue, until the edge `until`, a write cycle that began before this model was created."""
        self._busy_until = until

    def busy(self, t: int) -> bool:
        """Return True if a write cycle is in progress at edge t."""
        return t < self._busy_until

    def on_lines(self, t: int, scl: int, sda: int) -> None:
        """Process the levels of both lines at edge t; a level is 0 if any device pulls the line low."""
        if self.due is not None and t >= self.due:
            self.due, self._holds_scl = None, 0
        before, self._lines = self._lines, (scl, sda)
        if not self.missing:
            if before[0] and scl and before[1] != sda:
                if sda:
                    self._stop(t)
                else:
                    self._start()
            elif scl and not before[0]:
                self._rise(sda)
            elif before[0] and not scl:
                self._fall(t)
        self.sda = int(self._pull or self.stuck_sda)
        self.scl = int(self._holds_scl or self.stuck_scl)

    # ------------------------------------------------------------------ conditions

    def _start(self) -> None:
        self._idle()
        self._phase = "device"

    def _stop(self, t: int) -> None:
        """End the transfer; a write cycle begins if only whole bytes were received.

        The count of bits includes one bit for the rising edge of SCL before the STOP.
        """
        if self._phase == "data" and self._page and self._bits <= 1:
            first = self._address
            for place, byte in enumerate(self._page):
                self.memory[first & -PAGE | first + place & PAGE - 1] = byte
            self._address = first & -PAGE | first + len(self._page) & PAGE - 1
            self._busy_until = t + self.write_clk
            self.writes.append(Written(t, first, bytes(self._page)))
        self._idle()

    # ------------------------------------------------------------------ bits

    def _rise(self, sda: int) -> None:
        """Process a bit at a rising edge of SCL: a bit of a byte, or the acknowledge of the receiver."""
        if self._phase == "":
            return
        self._bits += 1
        if self._bits <= 8:
            self._shift = (self._shift << 1 | sda) & 0xFF
        elif self._phase == "read" and sda:
            self._idle()

    def _fall(self, t: int) -> None:
        if self._phase == "":
            return
        if self._bits == 8:
            self._byte(t)
        elif self._bits == 9:
            self._bits = 0
            self._pull = 0
            if self._phase == "send":
                self._phase = "read"
            if self.stretch_clk:
                self._holds_scl, self.due = 1, t + self.stretch_clk
        if self._phase == "read" and self._bits < 8:
            if not self._bits:
                self._sent = self.memory[self._address]
                self._address = (self._address + 1) % SIZE
            self._pull = ~self._sent >> 7 - self._bits & 1

    def _byte(self, t: int) -> None:
        """Process the end of the eighth bit; the acknowledge lasts until the next falling edge of SCL."""
        byte = self._shift
        if self._phase == "read":
            self._pull = 0
            return
        if self._phase == "device":
            if byte >> 1 != self.device or self.busy(t):
                self._idle()
                return
            self._phase = "send" if byte & 1 else "high"
        elif self._phase == "high":
            self._address, self._phase = (byte << 8) % SIZE, "low"
        elif self._phase == "low":
            self._address, self._phase = self._address | byte, "data"
        else:
            self._page = [*self._page, byte]
        self._pull = 1
