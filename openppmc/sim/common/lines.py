"""Virtual lines: for each part that hangs on one, the words of its text and the line itself."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from ..pmc006 import line_spec as line_spec006
from ..ppmc312 import line_spec


class Moving(Protocol):
    """A station as a server sees it."""

    @property
    def moving(self) -> bool:
        """Something happens by itself soon: time must pass in small steps."""

    def words(self) -> str:
        """Its state in words of `StationStatus`."""


class VirtualLine(Protocol):
    """A line with its stations in virtual time."""

    boards: Sequence[Moving]

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


@dataclass(frozen=True)
class LineKind:
    """parse: the text as a spec, ValueError for a bad one. at_rate: the text for a host that uses this line
    rate. known: the words. make: the line of a spec."""

    parse: Callable[[str], Any]
    at_rate: Callable[[str, int], str]
    known: str
    make: Callable[[Any], VirtualLine]


def _stations312(spec: line_spec.LineSpec) -> VirtualLine:
    from ..ppmc312.line import StationLine

    return StationLine(spec)


def _nodes006(spec: line_spec006.LineSpec) -> VirtualLine:
    from ..pmc006.line import NodeLine

    return NodeLine(spec)


LINES = {
    line_spec.PART: LineKind(line_spec.parse_line, line_spec.at_rate, line_spec.KNOWN, _stations312),
    line_spec006.PART: LineKind(line_spec006.parse_line, line_spec006.at_rate, line_spec006.KNOWN, _nodes006),
}


def part_of(text: str) -> str | None:
    """The part whose line a board's text asks for, None if it asks for no line.

    >>> part_of("start=3, part=ppmc312-serial"), part_of("part=ppmc312")
    ('ppmc312-serial', None)
    """
    words = text.replace(" ", "").lower().split(",")
    return next((part for part in LINES if f"part={part}" in words), None)
