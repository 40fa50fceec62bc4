"""Virtual lines: for each part that hangs on one, the words of its text and the line itself."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from ... import parts
from .char_line import LineOptions


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
