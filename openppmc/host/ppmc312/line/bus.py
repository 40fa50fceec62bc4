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

from ....lazy import Renamed
from ...errors import CommandRefused
from ...line import PATIENCE, CorruptReply, DuplicateAddress, LineBus, StationNotResponding
from ...line_port import Counters
from ...port import Port
from ..answers import Report, Status
from .line import CAPABILITIES, XTAL_HZ, Line
from .station import ErrorCounts, Station312
from .wire import SPEEDS, STATIONS, VERSION, SumMode

if TYPE_CHECKING:
    from serial.rs485 import RS485Settings

SCAN_ATTEMPTS = 2


@dataclass(frozen=True)
class ScanResult:
    """Station found by `scan`.

    Attributes:
        version, status, position: values read from the station; `None` if the replies are corrupt.
        errors: error counters of the station, which the scan has cleared; `None` if they could not be read
            because of a motion or an alarm.
        counters: counters of the master.
        problem: description of a problem; empty if there is none.
    """

    station: int
    version: int | None
    status: Status | None
    position: int | None
    errors: ErrorCounts | None
    counters: Counters = field(repr=False)
    problem: str = ""
    trouble = Renamed("problem")


class Ppmc312Bus(LineBus[Line, Station312]):
    """Line with the stations 0 to 15; see `host.line.LineBus`."""

    kind = CAPABILITIES

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
        """Open a port without sending anything; the arguments are those of `line.Line`."""
        return cls(Line(spec, speed, sum_mode, echo, rs485, patience, xtal_hz))

    def _make_station(self, station: int) -> Station312:
        return Station312(self.line, station)

    def _collect_reports(self, axis: Station312) -> None:
        axis.window.collect()

    # ------------------------------------------------------------------ search for stations

    def scan(
        self, stations: Iterable[int] = range(STATIONS), progress: Callable[[int], None] | None = None
    ) -> list[ScanResult]:
        """Return the stations of the line.

        For each address without a station, the scan waits for twice the time `patience`. The scan reads and
        clears the error counters of stations whose motor is stopped.

        Args:
            progress: called with the number of each station before the station is polled.
        """
        found = []
        for number in stations:
            if progress is not None:
                progress(number)
            axis = self._stations.get(number) or Station312(self.line, number)
            if (one := self._probe(axis)) is not None:
                self._stations.setdefault(number, axis)
                found.append(one)
        return found

    def _probe(self, axis: Station312) -> ScanResult | None:
        """Return the state of one station, `None` if there is no station."""
        counters, garbled_before = axis.counters, axis.counters.garbled
        try:
            version = axis.window.request(bytes([VERSION]), attempts=SCAN_ATTEMPTS).data[0]
        except StationNotResponding:
            return None
        except CorruptReply:
            return ScanResult(axis.number, None, None, None, None, counters, _GARBLED)
        try:
            status, position = axis.status(), axis.position
            axis.inputs()
            try:
                errors = axis.error_counts()
            except CommandRefused:
                errors = None
        except CorruptReply:
            return ScanResult(axis.number, version, None, None, None, counters, _GARBLED)
        problem = _NOISE if counters.garbled > garbled_before else ""
        return ScanResult(axis.number, version, status, position, errors, counters, problem)

    def check(self, stations: Iterable[int]) -> None:
        """Check that all these stations reply to a poll.

        Raises StationNotResponding if a station does not reply, and DuplicateAddress if all its replies are
        corrupt.
        """
        for number in stations:
            one = self._probe(self.axis(number))
            if one is None:
                raise StationNotResponding(
                    f"{self.line.name}: no station {number}: is it powered, are address and speed right?"
                )
            if one.problem == _GARBLED:
                raise DuplicateAddress(f"{self.line.name}: station {number}: {_GARBLED}")

    # ------------------------------------------------------------------ several stations

    def poll(self, stations: Iterable[int] | None = None) -> dict[int, list[Report]]:
        """Poll stations (default: those in use) once; return their reports by station."""
        polled = {axis.number: axis.poll() for axis in self._chosen(stations)}
        return {number: reports for number, reports in polled.items() if reports}


_GARBLED = "only garbled replies: noise, another speed or checksum rule, or two stations with this address"
_NOISE = "some replies were garbled: noise, missing termination, or two stations with this address"
