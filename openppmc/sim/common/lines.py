"""Virtual lines with stations: text (`word=value`, a station's number after the word) and process."""

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
    """A text taken apart. shared: values for all stations; own: by number of a station; options: the rest."""

    shared: dict[str, str] = field(default_factory=dict)
    own: dict[int, dict[str, str]] = field(default_factory=dict)
    options: dict[str, str] = field(default_factory=dict)


def split_words(
    text: str, stations: Sequence[str], options: Sequence[str], number: Callable[[str, str], int]
) -> Words:
    """Take a text apart. stations: words that a station may have of its own; options: words of the line.
    number: the station's number from word and text. Raises ValueError with the offending word."""
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
    """The value if it is known."""
    if value not in known:
        raise ValueError(f"{word}={value}: there are {', '.join(known)}")
    return value


def whole(word: str, text: str, low: int, high: int) -> int:
    """A whole number, not negative."""
    if not text.isdigit() or not low <= int(text) <= high:
        raise ValueError(f"{word}={text}: expected {low} to {high}")
    return int(text)


def positive(word: str, text: str) -> float:
    """A number above 0."""
    try:
        value = float(text)
    except ValueError:
        value = 0
    if not value > 0:
        raise ValueError(f"{word}={text}: expected a positive number")
    return value


def pace(text: str) -> float | None:
    """Times real time, None for `max`."""
    return None if text == "max" else positive("speed", text)


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


class OnLine(Protocol):
    """A station as a server sees it. number: its address at first."""

    number: int

    @property
    def moving(self) -> bool:
        """Something happens by itself soon: time must pass in small steps."""

    def words(self) -> str:
        """Its state in words of `StationStatus`."""

    def set_inputs(self, levels: str) -> None:
        """Levels of its general inputs, number 1 last, as "11111"."""


class VirtualLine(Protocol):
    """A line with its stations in virtual time."""

    @property
    def stations(self) -> Sequence[OnLine]:
        """Everything on it."""

    @property
    def seconds(self) -> float:
        """Virtual time in s."""

    def run_seconds(self, seconds: float) -> None:
        """Let time pass; ends early when a character comes."""

    def settle(self) -> None:
        """Let all stations come up to the time of the line."""

    def write(self, data: bytes) -> None:
        """Characters of the master."""

    def read(self) -> bytes:
        """What has come from the stations so far."""


class LineSpec(LineOptions, Protocol):
    """What a line was asked for, as far as whoever runs it must know."""

    @property
    def rate(self) -> float:
        """Line rate in bit/s."""

    @property
    def speed(self) -> float | None:
        """Times real time, None: as fast as it goes."""

    @property
    def unplug(self) -> float:
        """Seconds after which the port goes away."""


S = TypeVar("S", bound=LineSpec)


@dataclass(frozen=True)
class LineKind(Generic[S]):
    """parse: the text as a spec, ValueError for a bad one. at_rate: the text for a host that uses this line
    rate. known: the words. make: the modelled line of such a spec.

    For the RTL: parameters of its `line_node`, CLK_HZ among them; arguments of the program in tb/line, for
    which a folder for files is there, ValueError for a file that is no good; sources: what the node needs
    beside the carrier, from tb/ on.
    """

    parse: Callable[[str], S]
    at_rate: Callable[[str, int], str]
    known: str
    make: Callable[[S], VirtualLine]
    parameters: Callable[[S], dict[str, int | str]]
    arguments: Callable[[S, Path], list[str]]
    sources: tuple[str, ...] = ()


def line_parts() -> tuple[str, ...]:
    """The parts that hang on a line."""
    return tuple(row.name for row in parts.having("line", "machine"))


def line_kind(part: str) -> LineKind[LineSpec]:
    """What the part's own `line.py` says."""
    kind: LineKind[LineSpec] = parts.part(part).load("machine")
    return kind


def part_of(text: str) -> str | None:
    """The part whose line a board's text asks for, None if it asks for no line.

    >>> part_of("start=3, part=ppmc312-serial"), part_of("part=ppmc312")
    ('ppmc312-serial', None)
    """
    words = text.replace(" ", "").lower().split(",")
    return next((part for part in line_parts() if f"part={part}" in words), None)
