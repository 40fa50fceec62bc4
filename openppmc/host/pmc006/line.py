"""A line with PMC006B4: any number of controllers, a frame and its reply at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..basis.errors import PortError
from ..line.faults import Miss
from ..line.master import PATIENCE, Listener, Master
from ..line.ports import open_line
from ..ports.transport import Port
from .wire import Receiver, Reply, address_number, command

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings

PART = "pmc006"
BAUD, SLOWEST, FASTEST = 9600, 1200, 115_200
DROPPED_AFTER = 200
"""Bit times of silence after which a controller has forgotten half a frame (192, and some for safety)."""


class Line(Master[Reply]):
    """The master's end of a line, RS-232 or RS-485. An adapter that hears itself needs no option.

    spec: a port that pyserial knows (`/dev/ttyUSB0`, `COM3`, `socket://host:port`, …), `sim:…` or `model:…`.
    baud: 9600 unless the controllers were built with another rate, 1200 to 115200. rs485: settings of
    pyserial for adapters whose driver is switched by RTS. patience: s beyond line time until a controller is
    silent. Raises PortError.

    doubtful: addresses that have left a question unanswered, so that a late reply may still come.
    """

    def __init__(
        self,
        spec: str | Port,
        baud: int = BAUD,
        rs485: RS485Settings | None = None,
        patience: float = PATIENCE,
    ) -> None:
        if not SLOWEST <= baud <= FASTEST:
            raise PortError(f"{baud} bit/s is outside {SLOWEST} to {FASTEST}: it is {BAUD} as delivered")
        self.check_patience(patience)
        port = open_line(spec, baud, PART, rs485) if isinstance(spec, str) else spec
        super().__init__(port, baud, False, patience)
        self.doubtful: set[int] = set()

    def exchange(self, address: int, code: int, data: int = 0, answers: int | None = None) -> Reply | Miss:
        """A frame and its reply. answers: the address that replies, if it is another one. Raises
        Disconnected."""
        sent = command(address_number(address), code, data)
        got = self.ask(address, sent, Receiver(address if answers is None else answers, sent))
        if isinstance(got, Miss) and not got.heard:
            self.doubtful.add(address)
        return got

    def settle(self) -> None:
        """Wait until no controller holds half a frame and nothing more comes."""
        self.pause(DROPPED_AFTER / self.baud)

    def _missed(self, listener: Listener[Reply], heard: bytes) -> Miss:
        assert isinstance(listener, Receiver)
        return Miss(listener.fault, heard if listener.fault else b"")
