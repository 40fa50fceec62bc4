"""Strobes on the parallel bus of the PPMC-312 (P312-PAR-09..11).

They belong to the pins, not to the registers behind them: a software reset replaces those, and a strobe that
it meets goes on.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from ...common.blocks import Phase
from ...common.edges import EdgeLog
from ...common.scheduler import Scheduler

SYNC = 2
"""Pin to decision."""
IDLE = {"cs_n": 1, "we_n": 1, "oe_n": 1, "rs": 0, "d_i": 0}


class Registers(Protocol):
    """What is read and written."""

    def store(self, t: int, reg: int, byte: int) -> None:
        """A write strobe has ended."""

    def show(self, t: int, reg: int) -> int:
        """The value that a read strobe shows from edge t on."""

    def after_read(self, t: int, reg: int) -> None:
        """A read strobe has ended."""

    def access(self, t: int, reg: int | None, write: bool) -> None:
        """The strobe that is seen at edge t, of this register; None: no strobe."""


class Strobes:
    """registers: the present ones. They are in reset up to and including edge `closed`."""

    def __init__(self, queue: Scheduler, log: EdgeLog, registers: Registers) -> None:
        self._queue, self._log, self.registers = queue, log, registers
        self._pins: Mapping[str, int] = IDLE
        self._writing = self._reading = False
        self._showing: int | None = None
        self._closed = -1

    def replaced(self, t: int, registers: Registers) -> None:
        """Other registers from edge t on, which are in reset at the next edge."""
        self.registers, self._closed = registers, t + 1
        self._queue.at(t + 2, Phase.LEVELS, self._tell)

    def sample(self, t: int, pins: Mapping[str, int]) -> None:
        """Edge t samples new levels of the bus pins (P312-PAR-10, -11)."""
        levels = {pin: pins[pin] for pin in IDLE}
        self._queue.at(t + SYNC, Phase.BUS, lambda at: self._see(at, levels))

    def _tell(self, t: int) -> None:
        reg = self._pins["rs"] if self._writing or self._reading else None
        self.registers.access(t, reg, self._writing)

    def _see(self, t: int, pins: Mapping[str, int]) -> None:
        """Decisions at edge t use these levels first."""
        chosen = not pins["cs_n"] and pins["we_n"] != pins["oe_n"]
        writing, reading = bool(chosen and not pins["we_n"]), bool(chosen and not pins["oe_n"])
        is_open, old, wrote, was_reading = t > self._closed, self._pins, self._writing, self._reading
        self._writing, self._reading, self._pins = writing, reading, pins
        if is_open:
            if wrote and not writing:
                self.registers.store(t, old["rs"], old["d_i"])
            self._tell(t)
        if reading and not was_reading:
            self._queue.at(t + 1, Phase.CHOPPER, self._show)
        elif self._showing is not None and not reading:
            reg, self._showing = self._showing, None
            self._log.set(t, "d_oe", 0)
            if is_open:
                self._queue.at(t, Phase.QUEUE, lambda at: self.registers.after_read(at, reg))

    def _show(self, t: int) -> None:
        """d_o takes the register once a strobe, on the second edge that has seen it."""
        if self._reading and self._showing is None:
            self._showing = self._pins["rs"]
            self._log.set(t, "d_oe", 1)
            self._log.set(t, "d_o", self.registers.show(t, self._showing))
