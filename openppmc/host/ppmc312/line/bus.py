"""Driver of PPMC-312 in serial mode: up to sixteen stations on one line.

with Ppmc312Bus.open("/dev/ttyUSB0", speed=38400) as bus:
    x, y = bus.axis(0), bus.axis(5)
    for axis in (x, y):
        axis.initialise(start_pps=1000, high_pps=8000, ramp_pulses=4000)
    bus.wait([x.start_move(2500), y.start_move(-1200)])
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ...errors import CommandRefused
from ...line import PATIENCE, DuplicateAddress, GarbledReply, LineBus, StationSilent
from ...line_port import Counters
from ...port import Port
from ..answers import Report, Status
from .line import KIND, XTAL_HZ, Line
from .station import ErrorCounts, Station312
from .wire import SPEEDS, STATIONS, VERSION, SumMode

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings

SCAN_ATTEMPTS = 2


@dataclass(frozen=True)
class Found:
    """A station that `scan` has found.

    version, status, position: None if its replies are garbled. errors: its own error counters, which this
    has cleared; None if it could not be asked (motion, alarm). counters: of the master. trouble: what is
    wrong, empty if nothing is.
    """

    station: int
    version: int | None
    status: Status | None
    position: int | None
    errors: ErrorCounts | None
    counters: Counters = field(repr=False)
    trouble: str = ""


class Ppmc312Bus(LineBus[Line, Station312]):
    """A line (`line.Line`) with stations 0 to 15; see `host.line.bus.LineBus`."""

    kind = KIND

    @classmethod
    def open(
        cls,
        spec: str | Port,
        speed: int = SPEEDS[0],
        sum_mode: SumMode = SumMode.BINARY,
        echo: bool = False,
        rs485: RS485Settings | None = None,
        patience: float = PATIENCE,
        xtal_hz: int = XTAL_HZ,
    ) -> Ppmc312Bus:
        """Open a port; arguments as those of `line.Line`. Says nothing on the line."""
        return cls(Line(spec, speed, sum_mode, echo, rs485, patience, xtal_hz))

    def make(self, station: int) -> Station312:
        return Station312(self.line, station)

    def look_at(self, axis: Station312) -> None:
        axis.window.collect()

    # ------------------------------------------------------------------ who is there

    def scan(
        self, stations: Iterable[int] = range(STATIONS), progress: Callable[[int], None] | None = None
    ) -> list[Found]:
        """Ask who is there; progress: called with each number before it is asked. Reads and clears the error
        counters of stations at rest. Takes twice the patience for each address without a station."""
        found = []
        for number in stations:
            if progress is not None:
                progress(number)
            axis = self._stations.get(number) or Station312(self.line, number)
            if (one := self.look(axis)) is not None:
                self._stations.setdefault(number, axis)
                found.append(one)
        return found

    def look(self, axis: Station312) -> Found | None:
        """One station, None if there is none."""
        counters, heard = axis.counters, axis.counters.garbled
        try:
            version = axis.window.request(bytes([VERSION]), attempts=SCAN_ATTEMPTS).data[0]
        except StationSilent:
            return None
        except GarbledReply:
            return Found(axis.number, None, None, None, None, counters, _GARBLED)
        try:
            status, position = axis.status(), axis.position
            axis.inputs()
            try:
                errors = axis.error_counts()
            except CommandRefused:
                errors = None
        except GarbledReply:
            return Found(axis.number, version, None, None, None, counters, _GARBLED)
        trouble = _NOISE if counters.garbled > heard else ""
        return Found(axis.number, version, status, position, errors, counters, trouble)

    def check(self, stations: Iterable[int]) -> None:
        """All of these answer. Raises StationSilent, or DuplicateAddress where only garbled replies come."""
        for number in stations:
            one = self.look(self.axis(number))
            if one is None:
                raise StationSilent(
                    f"{self.line.name}: no station {number}: is it powered, are address and speed right?"
                )
            if one.trouble == _GARBLED:
                raise DuplicateAddress(f"{self.line.name}: station {number}: {_GARBLED}")

    # ------------------------------------------------------------------ several at once

    def poll(self, stations: Iterable[int] | None = None) -> dict[int, list[Report]]:
        """Poll stations (default: those in use) once; what they report, for those that report something."""
        polled = {axis.number: axis.poll() for axis in self._chosen(stations)}
        return {number: reports for number, reports in polled.items() if reports}


_GARBLED = "only garbled replies: noise, another speed or checksum rule, or two stations with this address"
_NOISE = "some replies were garbled: noise, missing termination, or two stations with this address"
