"""Window of the bank: strobes, registers, snapshots (BANK-WIN-01..08, BANK-GEN-05)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..chip import Phase
from ..clock import EdgeLog, Event, Scheduler
from ..single.hostport import strobes
from .axis import Axis
from .chopper import round_clk
from .group import Group

# Registers, written by `make packages` from packages/registers/ppmc_bank.rdl.
DATA = 0x0  # read: byte of a response; write: data byte
STATUS = 0x1  # result of the last byte, state of part and buffers
COMMAND = 0x1  # command byte
CONFIG = 0x2  # levels of the pins of the old chip
POSITION = 0x4  # position of the axis, low byte first; a read of the first byte latches the other three
MASK = 0x8  # byte k: members of the group
PENDING = 0x9  # byte k: map of the interrupts pending
GO = 0xA  # any byte: the held operations of the group continue; reads as 0x00
STOP = 0xB  # any byte: every motion ends; reads as 0x00
INFO = 0xC  # k = 0: 0x42 ("B"); 1: 0x01 (version); 2: N; else 0x00
ERR = 0x80  # the most recent byte, command or data, was faulty
NUM = 0x70  # ERR = 0: number of parameter bytes still expected, 0 to 4; ERR = 1: error number
BUSY = 0x04  # an operation is running (not during initialisation)
IBF = 0x02  # the input buffer is full: do not write
OBF = 0x01  # the data register holds an unread byte
VSEL = 0x02  # intervals by the rate formula alone, else 7.5 us longer
CSEL = 0x01  # base clock XTAL / 32, else XTAL / 128
INFO_MARK = 0x42  # byte 0
INFO_VERSION = 0x01  # byte 1: version of the window
# End of the registers.
NOTHING = 0xFF

_SYNC = 2
_SHORTEST_READ = 3
_READY = 7


class Window:
    """Window of the bank: converts bus strobes to register accesses.

    Args:
        released: edge 0 of the bank.
    """

    def __init__(
        self, queue: Scheduler, log: EdgeLog, axes: Sequence[Axis], group: Group, released: int
    ) -> None:
        self._queue, self._log, self._axes, self._group = queue, log, axes, group
        self._ready = released + round_clk(len(axes)) + _READY
        self._pins: dict[str, int] = {}
        self._writing = self._reading = False
        self._address = 0
        self._position = 0
        self._snapshot = 0
        self._began = 0
        self._output_events: tuple[Event, ...] = ()

    # ------------------------------------------------------------------ strobes

    def sample(self, t: int, pins: Mapping[str, int]) -> None:
        """Sample new levels of the bus pins at edge t (BANK-WIN-04..06)."""
        writing, reading = strobes(pins)
        if self._writing and not writing:
            address, byte = self._pins["a"], self._pins["d_i"]
            self._queue.at(t + _SYNC, Phase.STORE, lambda now: self._write(now, address, byte))
        self._writing = writing
        self._pins = dict(pins)
        if reading != self._reading:
            self._reading = reading
            self._queue.at(t + _SYNC, Phase.PIN, lambda now: self._log.set(now, "d_oe", int(reading)))
            (self._begin_read if reading else self._end_read)(t, pins["a"])

    def _begin_read(self, t: int, address: int) -> None:
        """Latch the data of a read after its edge 2, and output them at its edge 4 (BANK-WIN-05)."""
        self._address = address

        def take_snapshot(now: int) -> None:
            self._snapshot = self._register(now - 1, address)
            axis = self._axis(address)
            if axis and self._is_ready(now - 1) and address & 0xF == DATA:
                axis.mailbox.snapshot()

        self._output_events = (
            self._queue.at(t + 3, Phase.BUS, take_snapshot),
            self._queue.at(t + 4, Phase.BUS, lambda now: self._log.set(now, "d_o", self._snapshot)),
        )
        self._began = t

    def _end_read(self, t: int, _: int) -> None:
        if t < self._began + _SHORTEST_READ:
            for event in self._output_events:
                event.cancel()
            return
        axis = self._axis(self._address)
        if axis and self._address & 0xF == DATA:
            self._queue.at(t + _SYNC, Phase.QUEUE, lambda now: axis.mailbox.read_ended())

    # ------------------------------------------------------------------ registers

    def _axis(self, address: int) -> Axis | None:
        number = address >> 4
        return self._axes[number] if number < len(self._axes) else None

    def _is_ready(self, after: int) -> bool:
        """Return True if the bank is ready for accesses after an edge (BANK-GEN-05)."""
        return after >= self._ready

    def _write(self, t: int, address: int, byte: int) -> None:
        """Process a write event at edge t."""
        axis, register = self._axis(address), address & 0xF
        if axis is None or not self._is_ready(t - 1):
            return
        if register in (DATA, STATUS):
            axis.mailbox.store(t, byte, register == STATUS)
        elif register == CONFIG:
            axis.write_config(t, byte)
        elif register == MASK:
            self._group.write_mask(t, address >> 4 & 7, byte)
        elif register == GO:
            self._group.go(t)
        elif register == STOP:
            self._group.stop(t)

    def _register(self, after: int, address: int) -> int:
        """Return the content of a register after an edge."""
        axis, register, k = self._axis(address), address & 0xF, address >> 4 & 7
        if axis is None or register not in (*range(3), *range(POSITION, INFO + 1)):
            return NOTHING
        if not self._is_ready(after):
            return IBF if register == STATUS else 0
        if register == DATA:
            return axis.mailbox.data_register
        if register == STATUS:
            return axis.status
        if register == CONFIG:
            return axis.config
        if register == POSITION:
            self._position = axis.motion.position(after)
        if register < MASK:
            return self._position >> 8 * (register - POSITION) & 0xFF
        if register == MASK:
            return self._group.mask >> 8 * k & 0xFF
        if register == PENDING:
            group = self._axes[8 * k : 8 * k + 8]
            return sum(axis.context.interrupt << i for i, axis in enumerate(group))
        if register == INFO:
            return (INFO_MARK, INFO_VERSION, len(self._axes), *[0] * 8)[k]
        return 0
