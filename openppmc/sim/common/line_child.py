"""A virtual line that runs in a process of its own."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from .board import Child, to_stderr
from .build import build, line_program
from .lines import line_kind, line_parts, part_of
from .spec import SpecError
from .verilator import SimError


@dataclass(frozen=True)
class StationStatus:
    """A station: its number, where its motor is, its state; levels of its inputs and outputs if it has such,
    number 1 last."""

    number: int
    position: int
    state: str
    inputs: str = ""
    outputs: str = ""

    @property
    def text(self) -> str:
        """For the user.

        >>> StationStatus(5, 120, "idle", "11111", "00001").text
        '5: 120 idle in 11111 out 00001'
        """
        pins = f" in {self.inputs} out {self.outputs}" if self.inputs else ""
        return f"{self.number}: {self.position} {self.state}{pins}"


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
            StationStatus(int(number), int(position), *more)
            for number, position, *more in (one.split(":") for one in words["stations"].split(","))
        )
        return cls(float(words["seconds"]), float(words["factor"]), int(words["lost"]), stations)

    def text(self) -> str:
        """One line for the user."""
        stations = "  ".join(one.text for one in self.stations)
        return f"{self.seconds:9.1f} s  {self.factor:.2f} x real time  {stations}"


class SimLine(Child):
    """A virtual line: the RTL of its stations; see `Child`. spec: what was asked for. part: of the stations,
    unless the text says it; else the first one that hangs on a line. say: gets a line when something takes
    long (default: to standard error)."""

    def __init__(self, text: str, part: str = "", say: Callable[[str], None] | None = None) -> None:
        self.part = part_of(text) or part or line_parts()[0]
        kind = line_kind(self.part)
        try:
            self.spec = kind.parse(text)
        except ValueError as error:
            raise SpecError(str(error)) from None
        with tempfile.TemporaryDirectory(prefix="openppmc-") as files:
            try:
                arguments = kind.arguments(self.spec, Path(files))
            except ValueError as error:
                raise SimError(str(error)) from None
            program = build(
                lambda root: line_program(root, self.part, kind.sources),
                kind.parameters(self.spec),
                False,
                say or to_stderr,
            )
            # It has read its files when it tells its port.
            super().__init__([program, *arguments, *self._pace()])

    def _pace(self) -> list[str]:
        """Arguments that any line has."""
        spec = self.spec
        unplug = [f"unplug={spec.unplug}"] if spec.unplug < float("inf") else []
        words = [f"echo={spec.echo:d}", f"noise={spec.noise}", f"seed={spec.seed}"]
        return [f"speed={spec.speed or 0}", *words, *unplug]

    def status(self) -> LineStatus:
        """What the line shows now. Raises SimError when the program has ended."""
        return LineStatus.parse(self._ask_status())

    def set_inputs(self, number: int, levels: str) -> LineStatus:
        """Levels of the general inputs of a station, number 1 last, as "11111"; returns what shows then."""
        return LineStatus.parse(self._ask_status(f"inputs {number} {levels}"))


def start_line(text: str = "", part: str = "") -> SimLine:
    """Start a virtual line: `start_line("stations=4,speed=max")`. part: of the stations, if the text names
    none; else the first one that hangs on a line. Raises SpecError (a ValueError) for a bad text, SimError
    (a RuntimeError) if it does not start."""
    return SimLine(text, part)
