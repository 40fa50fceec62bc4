"""Ports of a line with several stations.

A port is a device or URL that pyserial opens, a modelled line (`model:`), or a virtual line in a separate
process (`sim:`).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any

from ..sim.common.lines import line_kind
from .errors import Disconnected, PortError
from .model_port import Pacer, whole
from .port import MODEL, SIM, Port, SerialPort, SimPort, describe_ports

if TYPE_CHECKING:
    import serial
    from serial.rs485 import RS485Settings

# Port `model:` of a line: golden models of the stations with their motors, in virtual time.


class ModelLine:
    """Line that needs no hardware.

    Args:
        text: options of the virtual line (the text after `model:`).
        baud: line rate in bit/s.
        part: name of the device in each station.

    Raises:
        PortError: `text` is invalid.
    """

    def __init__(self, text: str, baud: int, part: str) -> None:
        self.name = "model:" + text
        kind = line_kind(part)
        try:
            self.spec = kind.parse(kind.at_rate(text, baud))
            self.line = kind.make(self.spec)
        except ValueError as error:
            raise PortError(f"{self.name}: {error}") from error
        self.set_baud(baud)
        self._closed = False
        self._pacer = Pacer(self.spec.speed)

    def read(self, timeout: float) -> bytes:
        self._check()
        self._synchronise()
        end = self.line.seconds + timeout
        data = self.line.read()
        while not data and (left := end - self.line.seconds) > 0:
            self._run(self._pacer.step(left))
            self._pacer.wait(self.line.seconds)
            self._check()
            data = self.line.read()
        return data

    def write(self, data: bytes) -> None:
        self._check()
        self._synchronise()
        whole(lambda: self.line.write(data if self._rate_matches else bytes(len(data))))

    def set_baud(self, baud: int) -> None:
        self._rate_matches = abs(baud / self.spec.rate - 1) < 0.03

    def clock(self) -> float:
        return self.line.seconds

    def close(self) -> None:
        self._closed = True

    def _check(self) -> None:
        if self._closed or self.line.seconds >= self.spec.unplug:
            raise Disconnected(f"{self.name}: the port went away: plug it in and run the command again")

    def _synchronise(self) -> None:
        """Advance the line by the time that has passed since its last access."""
        if behind := self._pacer.behind(self.line.seconds):
            self._run(behind)

    def _run(self, seconds: float) -> None:
        whole(lambda: self.line.run_seconds(seconds))


# Faults between the master of a line and a station, and their counters.


class Fault(Enum):
    """Reason why the received bytes are not a valid reply.

    Attributes:
        FOREIGN: another station replied.
        BROKEN: a wrong character or checksum.
        NOISE: bytes that belong to no reply.
    """

    FOREIGN = "another station replied"
    BROKEN = "a broken reply"
    NOISE = "stray bytes"


@dataclass
class Counters:
    """Counters of the transfers between the master and a station.

    Attributes:
        sent: frames sent.
        repeated: repeated frames.
        silent: frames after which no byte of a reply was received.
        garbled: invalid replies.
        foreign: replies of another station.
        refused: frames that the station received corrupt (error code 41 in its reply).
        lost_reports: polls without a complete reply; a report in the reply may be lost.
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
        """Number of all faults of the line."""
        return self.silent + self.garbled + self.foreign + self.refused


@dataclass(frozen=True)
class MissingReply:
    """Missing reply.

    Attributes:
        fault: reason why there is no reply, `None` if no byte was received.
        received: bytes received instead of the reply.
    """

    fault: Fault | None
    received: bytes


SIM_PATIENCE = 0.25
"""Time in s that the master waits for a reply of a virtual line.

The time is long, because the reply passes through two processes.
"""
_SHORT, _LONGEST = 0.05, 30.0


class UrlPort(SerialPort):
    """Device or URL that pyserial opens.

    Args:
        rs485: how RTS switches the line driver; `None` if RTS does not switch it.
    """

    def __init__(self, spec: str, baud: int, rs485: RS485Settings | None = None) -> None:
        self._rs485 = rs485
        super().__init__(spec, baud)

    def _open(self, path: str, baud: int) -> serial.SerialBase:
        import serial

        own = {} if "://" in path else {"exclusive": True}
        port = serial.serial_for_url(path, baud, timeout=self.SLICE, write_timeout=2, **own)
        if self._rs485 is not None:
            try:
                port.rs485_mode = self._rs485
            except (OSError, ValueError, NotImplementedError, AttributeError) as error:
                port.close()
                raise PortError(
                    f"{path}: this port cannot switch a driver by RTS ({error}): leave rs485 out"
                ) from error
        return port


class SimLinePort(SimPort):
    """Virtual line; opening the port starts its process, closing the port stops it.

    A read with a timeout uses the time of the line, which may be slower than real time.
    """

    patience = SIM_PATIENCE

    def __init__(self, text: str, baud: int, part: str) -> None:
        self._rate, self._part = baud, part
        super().__init__(text, baud)

    def read(self, timeout: float) -> bytes:
        data = super().read(timeout)
        if data or timeout < _SHORT:
            return data
        factor = self._pace()
        return super().read(min(timeout / factor - timeout, _LONGEST)) if 0 < factor < 1 else data

    def _pace(self) -> float:
        """Return the speed of the line's time relative to wall time; 1 if the line does not run."""
        from ..sim import SimError

        try:
            return float(self._board.status().factor)
        except SimError:
            return 1.0

    def _start(self, text: str) -> Any:
        from ..sim import start_line
        from ..sim.common.lines import line_kind

        return start_line(line_kind(self._part).at_rate(text, self._rate), self._part)


def open_line(spec: str, baud: int, part: str, rs485: RS485Settings | None = None) -> Port:
    """Open a port of a line. Raises PortError if the port cannot be opened.

    Args:
        part: part of the stations, for virtual lines.
    """
    if not spec:
        raise PortError(f"no port given: name one with --port or OPENPPMC_PORT; {describe_ports()}")
    name = spec if ":" in spec else spec + ":"
    if name.startswith(MODEL):
        return ModelLine(name.removeprefix(MODEL), baud, part)
    if name.startswith(SIM):
        return SimLinePort(name.removeprefix(SIM), baud, part)
    return UrlPort(spec, baud, rs485)
