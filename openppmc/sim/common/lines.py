"""Virtual lines with stations: the parser of their text, and their process.

The text consists of words such as `start=2000`; a word with a number (`start3=100`) applies to the station
with this number.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from ... import parts
from .board import Child, to_stderr
from .build import SimError, build, line_program
from .char_line import LineOptions
from .spec import SpecError


@dataclass
class Words:
    """Parsed text of a line.

    Attributes:
        shared: values for all stations.
        own: values for one station, by its number.
        options: all other words.
    """

    shared: dict[str, str] = field(default_factory=dict)
    own: dict[int, dict[str, str]] = field(default_factory=dict)
    options: dict[str, str] = field(default_factory=dict)


def split_words(
    text: str, stations: Sequence[str], options: Sequence[str], number: Callable[[str, str], int]
) -> Words:
    """Parse the text of a line. Raise ValueError, which names the word that is wrong.

    Args:
        stations: words that may have the number of a station.
        options: words of the line.
        number: function that returns the number of a station for an item of the text and the digits in its
            word.
    """
    words = Words()
    numbered = re.compile(rf"({'|'.join(stations)})(\d+)$")
    for item in filter(None, (piece.strip() for piece in text.split(","))):
        word, equals, value = (piece.strip() for piece in item.partition("="))
        if not equals or not value:
            raise ValueError(f"{item!r} is not of the form word=value")
        if match := numbered.match(word):
            words.own.setdefault(number(item, match[2]), {})[match[1]] = value
        elif word in stations:
            words.shared[word] = value
        elif word in options:
            words.options[word] = value
        else:
            known = ", ".join((*(f"{name}[N]" for name in stations), *options))
            raise ValueError(f"unknown word {word!r} (there are {known})")
    return words


def one_of(word: str, value: str, known: Sequence[str]) -> str:
    """Return the value of a word. Raise ValueError if it is not one of the known values."""
    if value not in known:
        raise ValueError(f"{word}={value}: there are {', '.join(known)}")
    return value


def whole(word: str, text: str, low: int, high: int) -> int:
    """Return the text as a whole number from low to high. Raise ValueError for any other text."""
    if not text.isdigit() or not low <= int(text) <= high:
        raise ValueError(f"{word}={text}: expected {low} to {high}")
    return int(text)


def positive(word: str, text: str) -> float:
    """Return the text as a number above 0. Raise ValueError for any other text."""
    try:
        value = float(text)
    except ValueError:
        value = 0
    if not value > 0:
        raise ValueError(f"{word}={text}: expected a positive number")
    return value


def parse_speed(text: str) -> float | None:
    """Return the speed as a multiple of real time; None for `max`."""
    return None if text == "max" else positive("speed", text)


@dataclass(frozen=True)
class StationStatus:
    """State of a station: its number, the position of its motor, and its state as text.

    Attributes:
        inputs, outputs: levels of the general inputs and outputs, with number 1 last; empty if the station
            has none.
    """

    number: int
    position: int
    state: str
    inputs: str = ""
    outputs: str = ""

    @property
    def text(self) -> str:
        """State as text for the user.

        >>> StationStatus(5, 120, "idle", "11111", "00001").text
        '5: 120 idle in 11111 out 00001'
        """
        pins = f" in {self.inputs} out {self.outputs}" if self.inputs else ""
        return f"{self.number}: {self.position} {self.state}{pins}"


@dataclass(frozen=True)
class LineStatus:
    """State of the line.

    Attributes:
        seconds: time of the line.
        factor: time of the line divided by wall time, measured recently.
        lost: characters for the host that were discarded because the buffer was full.
    """

    seconds: float
    factor: float
    lost: int
    stations: tuple[StationStatus, ...]

    @classmethod
    def parse(cls, line: str) -> LineStatus:
        """Parse a status line of the program.

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
        """Return the status as one line."""
        stations = "  ".join(one.text for one in self.stations)
        return f"{self.seconds:9.1f} s  {self.factor:.2f} x real time  {stations}"


class SimLine(Child):
    """Virtual line with the RTL of its stations; see `Child`.

    Args:
        part: part of the stations if the text names no part; by default, the first part with a line.
        say: function that prints a line if a step takes long; by default, it prints on standard error.

    Attributes:
        spec: settings of the line, as parsed from the text of the port.
    """

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
            # When the program reports its port, it has already read its files, so that they can be removed.
            super().__init__([program, *arguments, *self._common_arguments()])

    def _common_arguments(self) -> list[str]:
        """Return the arguments that all lines have."""
        spec = self.spec
        unplug = [f"unplug={spec.unplug}"] if spec.unplug < float("inf") else []
        words = [f"echo={spec.echo:d}", f"noise={spec.noise}", f"seed={spec.seed}"]
        return [f"speed={spec.speed or 0}", *words, *unplug]

    def status(self) -> LineStatus:
        """Return the current state. Raise SimError if the program has ended."""
        return LineStatus.parse(self._ask_status())

    def set_inputs(self, number: int, levels: str) -> LineStatus:
        """Set a station's general inputs from text such as "11110" (input 1 last); return the new state."""
        return LineStatus.parse(self._ask_status(f"inputs {number} {levels}"))


def start_line(text: str = "", part: str = "") -> SimLine:
    """Start a virtual line: `start_line("stations=4,speed=max")`.

    Raises SpecError (a ValueError) for an invalid text, SimError (a RuntimeError) if the line does not start.

    Args:
        part: part of the stations if the text names no part; by default, the first part with a line.
    """
    return SimLine(text, part)


class StationState(Protocol):
    """Members of a station that a server of a virtual line needs.

    Attributes:
        number: initial address of the station.
    """

    number: int

    @property
    def moving(self) -> bool:
        """True if the state will change soon without input, so that time must advance in small steps."""

    def status_text(self) -> str:
        """Return the state in the format of `StationStatus`."""

    def set_inputs(self, levels: str) -> None:
        """Set the levels of the general inputs from text such as "11110"; the last character is input 1."""


class VirtualLine(Protocol):
    """Line with its stations in virtual time."""

    @property
    def stations(self) -> Sequence[StationState]:
        """All stations on the line."""

    @property
    def seconds(self) -> float:
        """Virtual time in s."""

    def run_seconds(self, seconds: float) -> None:
        """Advance by a time in s; stop earlier if a character arrives at the master."""

    def settle(self) -> None:
        """Simulate all stations up to the time of the line."""

    def write(self, data: bytes) -> None:
        """Send characters of the master."""

    def read(self) -> bytes:
        """Return the characters that the master has received since the last call."""


class LineSpec(LineOptions, Protocol):
    """Fields of a requested line that a server uses."""

    @property
    def rate(self) -> float:
        """Line rate in bit/s."""

    @property
    def speed(self) -> float | None:
        """Speed as a multiple of real time; None for as fast as possible."""

    @property
    def unplug(self) -> float:
        """Time in s after which the port disappears."""


S = TypeVar("S", bound=LineSpec)


@dataclass(frozen=True)
class LineCapabilities(Generic[S]):
    """Functions and texts for the lines of a part.

    For a line whose stations are RTL, `parameters` returns the parameters of the `line_node` of the part,
    including CLK_HZ. `arguments` returns the arguments of the program in tb/line. It may write files into the
    folder, and raises ValueError if a file is unusable.

    Attributes:
        parse: returns the spec of a text; raises ValueError if the text is invalid.
        at_rate: returns the text for a host with this line rate.
        known: text that lists the accepted words.
        make: returns the modelled line of a spec.
        sources: sources of the `line_node` in addition to the carrier, relative to tb/.
    """

    parse: Callable[[str], S]
    at_rate: Callable[[str, int], str]
    known: str
    make: Callable[[S], VirtualLine]
    parameters: Callable[[S], dict[str, int | str]]
    arguments: Callable[[S, Path], list[str]]
    sources: tuple[str, ...] = ()


def line_parts() -> tuple[str, ...]:
    """Return the parts that are connected to a line."""
    return tuple(row.name for row in parts.having("line", "machine"))


def line_kind(part: str) -> LineCapabilities[LineSpec]:
    """Return the object that the `line.py` of the part defines."""
    kind: LineCapabilities[LineSpec] = parts.part(part).load("machine")
    return kind


def part_of(text: str) -> str | None:
    """Return the part if the text of a board requests a line with stations, else None.

    >>> part_of("start=3, part=ppmc312-serial"), part_of("part=ppmc312")
    ('ppmc312-serial', None)
    """
    words = text.replace(" ", "").lower().split(",")
    return next((part for part in line_parts() if f"part={part}" in words), None)
