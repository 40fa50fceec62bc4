"""A line with PPMC-312 in serial mode: a frame and its reply at a time, faults counted, nothing repeated."""

from __future__ import annotations

from dataclasses import dataclass

from serial.rs485 import RS485Settings

from .ascii312 import (
    INSTRUCTION,
    POLL,
    SPEEDS,
    STATIONS,
    Fault,
    Receiver,
    Reply,
    SumMode,
    frame,
    station_number,
)
from .errors import Disconnected, OutOfRange, PortError
from .errors_serial312 import LineEcho
from .line_ports312 import open_line
from .script import Identity
from .transport import Port

XTAL_HZ = 16_000_000
PATIENCE = 0.1
"""Seconds beyond line time until a station counts as silent: it takes 4 ms, a USB adapter up to 16 ms."""
_BITS = 10
_GAP_BYTES, _GAP = 5, 0.01
_MOST_NOISE = 400


@dataclass
class Counters:
    """What has happened between the master and a station.

    sent: frames. repeated: of these, once more. silent: no reply; garbled: a broken one; foreign: another
    station replied; refused: the station says that a frame arrived broken (41). lost_reports: polls without a
    whole reply, with which a report may be gone.
    """

    sent: int = 0
    repeated: int = 0
    silent: int = 0
    garbled: int = 0
    foreign: int = 0
    refused: int = 0
    lost_reports: int = 0

    @property
    def faults(self) -> int:
        """All that went wrong on the line."""
        return self.silent + self.garbled + self.foreign + self.refused


@dataclass(frozen=True)
class Miss:
    """No reply. fault: why, None after silence. heard: bytes that came."""

    fault: Fault | None
    heard: bytes


class Line:
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
        if not 0 < patience <= 60:
            raise OutOfRange(f"patience {patience:g} s is outside 0 to 60 s")
        if not 1_000_000 <= xtal_hz <= XTAL_HZ:
            raise OutOfRange(f"crystal {xtal_hz} Hz is outside 1000000 to {XTAL_HZ} Hz")
        self.baud = round(speed * xtal_hz / XTAL_HZ)
        self.port = open_line(spec, self.baud, rs485) if isinstance(spec, str) else spec
        self.sum_mode, self.echo, self.patience = sum_mode, echo, max(patience, self.port_patience)
        # Nobody says on the line what timing the stations have: time limits are those of the slower one.
        self.identity = Identity(1, 312, True, True, 0, xtal_hz, xtal_hz, STATIONS)
        self.counters = [Counters() for _ in range(STATIONS)]
        self.stray = 0
        self._closed = False

    @property
    def port_patience(self) -> float:
        """What the port needs at least; virtual boards may be slower than real time."""
        return getattr(self.port, "patience", 0.0)

    @property
    def name(self) -> str:
        """The port as the user named it."""
        return self.port.name

    def clock(self) -> float:
        """Time of the port in s; that of `model:` is virtual."""
        return self.port.clock()

    def pause(self, seconds: float) -> None:
        """Let time of the port pass; bytes that come are dropped."""
        end = self.clock() + seconds
        while (left := end - self.clock()) > 0:
            self.stray += len(self.port.read(left))

    def forget_events(self) -> None:
        """There are none on a line."""

    def close(self) -> None:
        """Close the port; allowed twice."""
        self._closed = True
        self.port.close()

    # ------------------------------------------------------------------ frames

    def exchange(self, station: int, data: bytes | None, gives: int = 1, extra: float = 0.0) -> Reply | Miss:
        """Send a frame and await the reply. data: code and data of an instruction, None: a poll. gives: bytes
        of a data reply. extra: s that the station may take longer. Raises LineEcho, Disconnected."""
        sent = self.tell(station, data)
        counters = self.counters[station]
        got = self._await(Receiver(station, gives, self.sum_mode), self.seconds(len(sent)) + extra)
        if isinstance(got, Miss):
            if got.heard.startswith(sent) and not self.echo:
                raise LineEcho(f"{self.name}: the line hears its own bytes: say so (--line echo, echo=True)")
            if got.fault is Fault.FOREIGN:
                counters.foreign += 1
            elif got.heard:
                counters.garbled += 1
            else:
                counters.silent += 1
        return got

    def tell(self, station: int, data: bytes | None) -> bytes:
        """Send a frame, and drop its echo if there is one; returns it. What came before is dropped."""
        control = (POLL if data is None else INSTRUCTION) | station_number(station)
        sent = frame(control, data or b"", self.sum_mode)
        if self._closed:
            raise Disconnected(f"{self.name}: the line is closed: open it again")
        self.stray += len(self.port.read(0))
        self.counters[station].sent += 1
        self.port.write(sent)
        if self.echo:
            self._drop_echo(sent)
        return sent

    def seconds(self, count: int) -> float:
        """Line time of so many bytes."""
        return count * _BITS / self.baud

    def _drop_echo(self, sent: bytes) -> None:
        heard = b""
        end = self.clock() + self.seconds(len(sent)) + self.patience
        while len(heard) < len(sent) and (left := end - self.clock()) > 0:
            heard += self.port.read(left)
        if not heard:
            raise LineEcho(f"{self.name}: the line does not hear its own bytes: leave the option echo out")
        self._early = heard[len(sent) :]
        if heard[: len(sent)] != sent:
            self.stray += 1  # somebody else talks; the reply will show what it has done

    _early = b""

    def _await(self, receiver: Receiver, seconds: float) -> Reply | Miss:
        """The reply, or what came instead."""
        heard = bytearray()
        deadline = self.clock() + seconds + self.patience
        early, self._early = self._early, b""
        while True:
            data = early or self.port.read(max(0.0, deadline - self.clock()))
            early = b""
            if not data:
                return Miss(Fault.NOISE if heard else None, bytes(heard))
            deadline = self.clock() + self.patience
            for place, byte in enumerate(data):
                heard.append(byte)
                got = receiver.take(byte)
                if isinstance(got, Reply):
                    self.stray += len(data) - place - 1
                    return got
                if got in (Fault.FOREIGN, Fault.BROKEN) or len(heard) > _MOST_NOISE:
                    return Miss(got, bytes(heard) + data[place + 1 :] + self._rest())

    def _rest(self) -> bytes:
        """What still comes until the line is quiet. Bounded."""
        gap = max(_GAP, self.seconds(_GAP_BYTES))
        rest, end = b"", self.clock() + 20 * gap
        while (data := self.port.read(gap)) and self.clock() < end:
            rest += data
        return rest
