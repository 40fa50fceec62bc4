"""Parallel registers of the PPMC-312: CSR, windows, /IRQ, /WRQ, and their strobes.

Rules: P312-PAR-01..08, -12.

Each host side has the methods `notify_response`, `done`, `levels`, `ready` and `answer`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from ...chip import Context, Phase
from ...clock import EdgeLog, Event, Scheduler
from ..codes import Source
from ..timing import CoreTiming
from .responses import Responses

# Strobes on the parallel bus of the PPMC-312 (P312-PAR-09..11). They are separate from the registers, because
# a software reset replaces the registers, but a strobe in progress continues.

SYNC = 2
"""Number of cycles from the edge that samples a pin to the decision that uses its level."""
IDLE = {"cs_n": 1, "we_n": 1, "oe_n": 1, "rs": 0, "d_i": 0}


class Registers(Protocol):
    """Members of the registers that the strobes use."""

    def store(self, t: int, reg: int, byte: int) -> None:
        """Process the end of a write strobe."""

    def read_value(self, t: int, reg: int) -> int:
        """Return the value that a read strobe outputs from edge t on."""

    def after_read(self, t: int, reg: int) -> None:
        """Process the end of a read strobe."""

    def access(self, t: int, reg: int | None, write: bool) -> None:
        """Process the strobe that edge t samples; `reg` is its register, `None` if there is no strobe."""


class Strobes:
    """Strobes of the bus.

    Args:
        registers: the current registers, which are in reset up to and including edge `_closed`.
    """

    def __init__(self, queue: Scheduler, log: EdgeLog, registers: Registers) -> None:
        self._queue, self._log, self.registers = queue, log, registers
        self._pins: Mapping[str, int] = IDLE
        self._writing = self._reading = False
        self._read_register: int | None = None
        self._closed = -1

    def replace_registers(self, t: int, registers: Registers) -> None:
        """Replace the registers at edge t; the new registers are in reset up to the next edge."""
        self.registers, self._closed = registers, t + 1
        self._queue.at(t + 2, Phase.LEVELS, self._notify_access)

    def sample(self, t: int, pins: Mapping[str, int]) -> None:
        """Sample new levels of the bus pins at edge t (P312-PAR-10, -11)."""
        levels = {pin: pins[pin] for pin in IDLE}
        self._queue.at(t + SYNC, Phase.BUS, lambda at: self._on_levels(at, levels))

    def _notify_access(self, t: int) -> None:
        reg = self._pins["rs"] if self._writing or self._reading else None
        self.registers.access(t, reg, self._writing)

    def _on_levels(self, t: int, pins: Mapping[str, int]) -> None:
        """Process bus levels that decisions use from edge t on."""
        is_selected = not pins["cs_n"] and pins["we_n"] != pins["oe_n"]
        writing, reading = bool(is_selected and not pins["we_n"]), bool(is_selected and not pins["oe_n"])
        is_open, old, wrote, was_reading = t > self._closed, self._pins, self._writing, self._reading
        self._writing, self._reading, self._pins = writing, reading, pins
        if is_open:
            if wrote and not writing:
                self.registers.store(t, old["rs"], old["d_i"])
            self._notify_access(t)
        if reading and not was_reading:
            self._queue.at(t + 1, Phase.CHOPPER, self._load_output)
        elif self._read_register is not None and not reading:
            reg, self._read_register = self._read_register, None
            self._log.set(t, "d_oe", 0)
            if is_open:
                self._queue.at(t, Phase.QUEUE, lambda at: self.registers.after_read(at, reg))

    def _load_output(self, t: int) -> None:
        """Load d_o from the register, once per strobe, at the second edge at which the strobe is active."""
        if self._reading and self._read_register is None:
            self._read_register = self._pins["rs"]
            self._log.set(t, "d_oe", 1)
            self._log.set(t, "d_o", self.registers.read_value(t, self._read_register))


# Registers, written by `make packages` from packages/registers/ppmc312.rdl.
CSR = 0x0  # control and status
CONTROL = 0x2  # write: WCR, 0x20 opens the write window; read: RCR, rewinds the read window, reads as 0x00
ADDRESS = 0x3  # write: WAR, write pointer; read: RAR, read pointer
WRITE = 0x5  # DWR, a byte into the write window; reads as 0x00
READ = 0x7  # DRR, the next byte of the read window
EWRQ = 0x40  # `wrq_n` requests a faster host to wait
EWIRQ = 0x20  # interrupt while MWEF = 0
ERIRQ = 0x10  # interrupt while MREF = 0
MWEF = 0x08  # the write window is closed: an instruction is being processed
MREF = 0x04  # no answer or report is in the read window
# End of the registers.
WINDOW = 0x20


class Mailbox:
    """Parallel registers.

    Args:
        take: take(t, block) is called with a complete instruction block in logical order, at the write event
            of its header.
    """

    def __init__(
        self,
        context: Context,
        core_timing: CoreTiming,
        responses: Responses,
        take: Callable[[int, bytes], None],
    ) -> None:
        self._context, self._core_timing = context, core_timing
        self._responses, self._take = responses, take
        self._enables = 0
        self._armed = False
        self._pointer = WINDOW
        self._bytes: list[int] = []
        self._busy = False
        self._is_ready = False
        self._window = b""
        self._at = 0
        self._free_from = 0
        self._loading: Event | None = None
        self._selected = self._response_was_read = False
        self._accessing = False
        self._access_end = -(1 << 40)
        self._wait_until: int | None = None

    # ------------------------------------------------------------------ methods that the part calls

    def ready(self, t: int) -> None:
        """Enable the interface from edge t on."""
        self._is_ready = True

    def done(self, t: int) -> None:
        """Process the end of an instruction, when its response is stored (P312-PAR-06)."""
        self._context.queue.at(t, Phase.STORE, self._open)

    def _open(self, t: int) -> None:
        self._busy = False

    def notify_response(self, t: int) -> None:
        """If the window is free, schedule the load of a response from edge t on (P312-PAR-08)."""
        if self._window or self._selected or self._loading:
            return
        at = max(t + self._core_timing.load, self._free_from)
        self._loading = self._context.queue.at(at, Phase.PINS, self._load)

    def answer(self, t: int, source: Source, block: bytes) -> None:
        """Do nothing, because on the parallel bus the store of responses holds the response."""

    def levels(self) -> dict[str, int]:
        """Return the internal level of irq_n."""
        interrupt = (self._enables & EWIRQ and not self.mwef) or (self._enables & ERIRQ and self._window)
        return {"irq_n": int(not interrupt)}

    @property
    def csr(self) -> int:
        """Status register."""
        return self._register(CSR)

    @property
    def mwef(self) -> bool:
        """True if no instruction may be written."""
        return self._busy or not self._is_ready

    def _load(self, t: int) -> None:
        """Select the response to load.

        The host can read the response after its bytes have been loaded.
        """
        self._loading = None
        selected = self._responses.select()
        if selected is not None:
            self._selected = True
            self._context.queue.at(
                t + self._core_timing.show, Phase.STORE, lambda at: self._fill_window(selected)
            )

    def _fill_window(self, block: bytes) -> None:
        self._selected = False
        self._window, self._at = block[::-1], 0

    # ------------------------------------------------------------------ strobes

    def read_value(self, t: int, reg: int) -> int:
        """Return the value that a read strobe outputs from edge t on."""
        self._response_was_read = bool(self._window)
        return self._register(reg)

    def access(self, t: int, reg: int | None, write: bool) -> None:
        """Process the start or end of a DWR or DRR strobe (P312-PAR-12)."""
        accessing = reg == (WRITE if write else READ)
        timebase = self._context.timebase
        if self._accessing and not accessing:
            self._access_end = t
        elif accessing and not self._accessing:
            gap = self._core_timing.wrq_fast
            if self._context.datasheet:
                gap = -(-19 * timebase.clk_hz // (2 * timebase.xtal_hz))
            over = self._access_end + gap
            if self._enables & EWRQ and over > t:
                self._context.log.set(t, "wrq_n", 0)
                self._wait_until = over
                self._context.queue.at(over, Phase.QUEUE, self._wait_over)
        self._accessing = accessing

    def _wait_over(self, t: int) -> None:
        if self._wait_until == t:
            self._wait_until = None
            self._context.log.set(t, "wrq_n", 1)

    def _register(self, reg: int) -> int:
        if reg == CSR:
            return self._enables | (MWEF if self.mwef else 0) | (0 if self._window else MREF)
        if reg == ADDRESS:
            return 0x40 - (len(self._window) - self._at)
        if reg == READ and self._window:
            return self._window[self._at]
        return 0

    def after_read(self, t: int, reg: int) -> None:
        """Process the end of a read strobe.

        A strobe that began before the response was loaded has read no byte of the response.
        """
        if not self._response_was_read:
            return
        if reg == CONTROL:
            self._at = 0
        elif reg == READ:
            self._at += 1
            if self._at == len(self._window):
                self._window, self._at, self._free_from = b"", 0, t + self._core_timing.reload
                self._responses.read(t)
                self.notify_response(t)

    # ------------------------------------------------------------------ write window

    def store(self, t: int, reg: int, byte: int) -> None:
        """Process the end of a write strobe."""
        if reg == CSR:
            self._enables = byte & (EWRQ | EWIRQ | ERIRQ)
        elif self.mwef:
            return
        elif reg == CONTROL:
            self._armed = byte == WINDOW
        elif reg == ADDRESS:
            self._pointer, self._bytes = min(byte, WINDOW), []
        elif reg == WRITE and self._armed and self._pointer < WINDOW:
            self._bytes.append(byte)
            self._pointer += 1
            if self._pointer == WINDOW:
                self._busy = True
                self._take(t, bytes(reversed(self._bytes)))
