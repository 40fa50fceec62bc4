"""The line of PPMC-312 that a command has opened."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from ....host import Ppmc312Bus, Station312
from ....host.ppmc312.line.bus import ScanResult
from ....host.ppmc312.line.wire import STATIONS, SumMode
from ...common import line_session
from ...common.board import BOARD, LINE_WORDS
from ...common.line_session import guarded, parse_numbers
from ...common.session import Guard


def parse_stations(text: str) -> list[int]:
    """Parse `3`, `0,2,5` or `0-7`; keep the order. Raise BadParameter for any other text."""
    last = STATIONS - 1
    return parse_numbers("--axis", text, range(STATIONS), f"stations have numbers from 0 to {last}", "0-7")


def line_options(text: str) -> dict[str, Any]:
    """Return arguments of `Ppmc312Bus.open` from the text of --line. Raise BadParameter if it is invalid."""
    options = line_session.line_options(text, LINE_WORDS)
    if "sum_mode" in options:
        options["sum_mode"] = SumMode(options["sum_mode"])
    return options


@dataclass
class Session:
    """An open line."""

    bus: Ppmc312Bus
    guard: Guard

    def selected_axes(self, text: str | None) -> list[Station312]:
        """Return the stations of --axis, all of which must reply; without --axis, all that reply."""
        if text is not None:
            numbers = parse_stations(text)
            self.bus.check(numbers)
        else:
            numbers = [one.station for one in self.scan()]
        return [self.bus.axis(number) for number in numbers]

    def scan(self) -> list[ScanResult]:
        """Return all stations that reply; show a progress bar during the search."""
        found = self.bus.scan(progress=self._on_scan_progress)
        self.guard.bar_off()
        return found

    def _on_scan_progress(self, number: int) -> None:
        self.guard.check()
        self.guard.count_bar("looking for stations", number, STATIONS)


def open_bus() -> Ppmc312Bus:
    """Open the line."""
    options = line_options(BOARD.line)
    if BOARD.baud is not None:
        options["speed"] = BOARD.baud
    return Ppmc312Bus.open(BOARD.port, **options)


@contextmanager
def opened() -> Iterator[Session]:
    """Open the line. A signal n stops the motors, and the exit status is then 128 + n."""
    with guarded(open_bus) as (bus, guard):
        yield Session(bus, guard)
