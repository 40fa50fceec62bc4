"""A line with PPMC-312 in serial mode: a frame and its reply at a time, faults counted, nothing repeated."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...basis.errors import OutOfRange, PortError
from ...bridge.answer import Identity
from ...line.errors import LineEcho
from ...line.faults import Counters, Miss
from ...line.master import PATIENCE, Master
from ...line.ports import open_line
from ...ports.transport import Port
from .ascii import (
    INSTRUCTION,
    POLL,
    SPEEDS,
    STATIONS,
    Receiver,
    Reply,
    SumMode,
    frame,
    station_number,
    sum_mode_of,
)

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings

XTAL_HZ = 16_000_000


class Line(Master[Reply]):
    """The master's end of a line.

    spec: any port that pyserial knows (`/dev/ttyUSB0`, `COM3`, `socket://host:port`, `rfc2217://…`), `sim:…`
    or `model:…`. speed: 19200, 38400 or 83333 bit/s as the stations' MOD pins say. sum_mode: as the stations
    are built. echo: the master hears its own bytes (two-wire adapters that never switch their receiver off).
    rs485: settings of pyserial for adapters whose driver is switched by RTS. patience: s beyond line time
    until a station is silent. xtal_hz: crystal of the stations; speeds go with it. Raises PortError.
    """

    def __init__(
        self,
        spec: str | Port,
        speed: int = SPEEDS[0],
        sum_mode: SumMode = SumMode.BINARY,
        echo: bool = False,
        rs485: RS485Settings | None = None,
        patience: float = PATIENCE,
        xtal_hz: int = XTAL_HZ,
    ) -> None:
        if speed not in SPEEDS:
            raise PortError(
                f"{speed} bit/s is no speed of a line: there are {', '.join(map(str, SPEEDS))} (pins MOD)"
            )
        known = sum_mode_of(sum_mode)
        self.check_patience(patience)
        if not 1_000_000 <= xtal_hz <= XTAL_HZ:
            raise OutOfRange(f"crystal {xtal_hz} Hz is outside 1000000 to {XTAL_HZ} Hz")
        baud = round(speed * xtal_hz / XTAL_HZ)
        port = open_line(spec, baud, "ppmc312-serial", rs485) if isinstance(spec, str) else spec
        super().__init__(port, baud, echo, patience)
        self.sum_mode = known
        # Nobody says on the line what timing the stations have: time limits are those of the slower one.
        self.identity = Identity(1, 312, True, True, 0, xtal_hz, xtal_hz, STATIONS)
        self.counters = {number: Counters() for number in range(STATIONS)}

    # ------------------------------------------------------------------ frames

    def exchange(self, station: int, data: bytes | None, gives: int = 1, extra: float = 0.0) -> Reply | Miss:
        """Send a frame and await the reply. data: code and data of an instruction, None: a poll. gives: bytes
        of a data reply. extra: s that the station may take longer. Raises LineEcho, Disconnected."""
        sent = self._frame(station, data)
        got = self.ask(station, sent, Receiver(station, gives, self.sum_mode), extra)
        if isinstance(got, Miss) and got.heard.startswith(sent) and not self.echo:
            raise LineEcho(f"{self.name}: the line hears its own bytes: say so (--line echo, echo=True)")
        return got

    def tell(self, station: int, data: bytes | None) -> bytes:
        """Send a frame, and drop its echo if there is one; returns it. What came before is dropped."""
        sent = self._frame(station, data)
        self.send(station, sent)
        return sent

    def _frame(self, station: int, data: bytes | None) -> bytes:
        control = (POLL if data is None else INSTRUCTION) | station_number(station)
        return frame(control, data or b"", self.sum_mode)
