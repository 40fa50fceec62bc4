"""The master's end of a line with several stations, whatever their frames are: bytes out, one reply in."""

from __future__ import annotations

from typing import Generic, Protocol, TypeVar

from ..basis.arguments import exact
from ..basis.errors import Disconnected, OutOfRange
from ..ports.transport import Port
from .errors import LineEcho
from .faults import Counters, Fault, Miss

PATIENCE = 0.1
"""Seconds beyond line time until a station counts as silent: it takes 4 ms, a USB adapter up to 16 ms."""
BITS = 10
_GAP_BYTES, _GAP = 5, 0.01
_MOST_NOISE = 400

Answer = TypeVar("Answer", covariant=True)


class Listener(Protocol[Answer]):
    """Takes the bytes of one reply."""

    def take(self, byte: int) -> Answer | Fault | None:
        """The next byte; a reply when it is complete, a Fault when it cannot become one any more."""


class Master(Generic[Answer]):
    """Half duplex: a frame, then the reply to it; faults are counted, nothing is repeated.

    port: open already. baud: line rate in bit/s. echo: the master hears its own bytes. patience: s beyond
    line time until a station is silent, at most 60. counters: one for each station, by its number.
    """

    def __init__(self, port: Port, baud: int, echo: bool, patience: float) -> None:
        self.port, self.baud, self.echo = port, baud, echo
        self.patience = max(patience, self.port_patience)
        self.counters: dict[int, Counters] = {}
        self.stray = 0
        self._closed = False
        self._early = b""

    @staticmethod
    def check_patience(patience: float) -> None:
        """OutOfRange for one that makes no sense."""
        if not 0 < exact(patience, "patience") <= 60:
            raise OutOfRange(f"patience {patience:g} s is outside 0 to 60 s")

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

    def wait_event(self, timeout: float) -> int | None:
        """There are none on a line: None after `timeout` seconds, bytes that come are dropped."""
        self.pause(timeout)
        return None

    def forget_events(self) -> None:
        """There are none on a line."""

    def close(self) -> None:
        """Close the port; allowed twice."""
        self._closed = True
        self.port.close()

    def seconds(self, count: int) -> float:
        """Line time of so many bytes."""
        return count * BITS / self.baud

    # ------------------------------------------------------------------ frames

    def ask(self, station: int, sent: bytes, listener: Listener[Answer], extra: float = 0.0) -> Answer | Miss:
        """Send a frame and await the reply. extra: s that the station may take longer. Raises LineEcho,
        Disconnected."""
        self.send(station, sent)
        counters = self.counters[station]
        got = self._await(listener, self.seconds(len(sent)) + extra)
        if isinstance(got, Miss):
            if got.fault is Fault.FOREIGN:
                counters.foreign += 1
            elif got.heard:
                counters.garbled += 1
            else:
                counters.silent += 1
        return got

    def send(self, station: int, sent: bytes) -> None:
        """Send a frame, and drop its echo if there is one. What came before is dropped."""
        if self._closed:
            raise Disconnected(f"{self.name}: the line is closed: open it again")
        self.stray += len(self.port.read(0))
        self.counters.setdefault(station, Counters()).sent += 1
        self.port.write(sent)
        if self.echo:
            self._drop_echo(sent)

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

    def _await(self, listener: Listener[Answer], seconds: float) -> Answer | Miss:
        """The reply, or what came instead."""
        heard = bytearray()
        deadline = self.clock() + seconds + self.patience
        early, self._early = self._early, b""
        while True:
            data = early or self.port.read(max(0.0, deadline - self.clock()))
            early = b""
            if not data:
                return self._missed(listener, bytes(heard))
            deadline = self.clock() + self.patience
            for place, byte in enumerate(data):
                heard.append(byte)
                got = listener.take(byte)
                if got is not None and not isinstance(got, Fault):
                    self.stray += len(data) - place - 1
                    return got
                if got in (Fault.FOREIGN, Fault.BROKEN) or len(heard) > _MOST_NOISE:
                    fault = got if isinstance(got, Fault) else Fault.NOISE
                    return Miss(fault, bytes(heard) + data[place + 1 :] + self._rest())

    def _missed(self, listener: Listener[Answer], heard: bytes) -> Miss:
        """Silence, perhaps after bytes that were no reply."""
        return Miss(Fault.NOISE if heard else None, heard)

    def _rest(self) -> bytes:
        """What still comes until the line is quiet. Bounded."""
        gap = max(_GAP, self.seconds(_GAP_BYTES))
        rest, end = b"", self.clock() + 20 * gap
        while (data := self.port.read(gap)) and self.clock() < end:
            rest += data
        return rest
