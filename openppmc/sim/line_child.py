"""A virtual line of PPMC-312 that runs in a process of its own."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from pathlib import Path

from .board import Child
from .build import SimError
from .line_spec import LineSpec, parse_line
from .spec import SpecError


@dataclass(frozen=True)
class StationStatus:
    """A station: its number, where its motor is, its state."""

    number: int
    position: int
    state: str


@dataclass(frozen=True)
class LineStatus:
    """What the line shows. seconds: its time. factor: its time / wall time lately. lost: characters for the
    host that found no room."""

    seconds: float
    factor: float
    lost: int
    stations: tuple[StationStatus, ...]

    @classmethod
    def parse(cls, line: str) -> LineStatus:
        """From the program's own words.

        >>> LineStatus.parse("seconds=1.5 factor=1.0 lost=0 stations=3:-20:NOR").stations[0].position
        -20
        """
        words = dict(word.partition("=")[::2] for word in line.split())
        stations = tuple(
            StationStatus(int(number), int(position), state)
            for number, position, state in (one.split(":") for one in words["stations"].split(","))
        )
        return cls(float(words["seconds"]), float(words["factor"]), int(words["lost"]), stations)

    def text(self) -> str:
        """One line for the user."""
        stations = "  ".join(f"{one.number}: {one.position} {one.state}" for one in self.stations)
        return f"{self.seconds:9.1f} s  {self.factor:.2f} x real time  {stations}"


class SimLine(Child):
    """A virtual line; see `Child`. spec: what was asked for."""

    def __init__(self, text: str) -> None:
        try:
            self.spec: LineSpec = parse_line(text)
        except ValueError as error:
            raise SpecError(str(error)) from None
        if not sys.platform.startswith("linux"):
            raise SimError("the virtual line needs Linux (its pseudo-terminals): use model: instead")
        # The package may not be installed: the child finds it where this one is.
        here = str(Path(__file__).resolve().parents[2])
        paths = [here, *filter(None, [os.environ.get("PYTHONPATH")])]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
        super().__init__([sys.executable, "-m", "openppmc.sim.line_server", text], environment)

    def status(self) -> LineStatus:
        """What the line shows now. Raises SimError when the program has ended."""
        return LineStatus.parse(self._ask_status())


def start_line(text: str = "") -> SimLine:
    """Start a virtual line: `start_line("stations=4,speed=max")`. Raises SpecError (a ValueError) for a bad
    text, SimError (a RuntimeError) if it does not start."""
    return SimLine(text)
