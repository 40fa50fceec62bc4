"""Sums of all covered points: figures of each folder, and the holes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import yaml

from cocotb_tests.harness.project import ROOT, ProjectError
from scripts.measure.coverage.elaborated import left_out
from scripts.measure.coverage.points import BRANCH, LINE, TOGGLE, Points, lines_of

HOLES = Path(__file__).with_name("holes.yml")
LEFT_OUT = {"boards": "the tops of FPGA boards are simulated (`cocotb_tests/board`), but not counted here"}
"""Folders of rtl/ that have no figures, with the reason."""


@dataclass(frozen=True)
class Figure:
    """Numbers of points: covered, explained holes (`known`), and all."""

    reached: int
    known: int
    all: int

    @property
    def percent(self) -> float:
        """Percentage of covered points; 100 if there are no points."""
        return 100 * self.reached / self.all if self.all else 100.0

    @property
    def left(self) -> float:
        """Percentage of covered points if explained holes are not counted; 100 if there are no points."""
        others = self.all - self.known
        return 100 * self.reached / others if others else 100.0

    @property
    def good(self) -> bool:
        """True if at least 98 % of the points are covered and each hole is explained."""
        return self.percent >= 98 and self.reached + self.known == self.all


@dataclass(frozen=True)
class Hole:
    """A point that no test covers.

    Attributes:
        why: explanation of the hole, "" if there is no explanation.
    """

    file: str
    line: int
    kind: str
    what: str
    why: str

    @property
    def text(self) -> str:
        """The source line of the point."""
        return source(self.file)[self.line - 1].strip()


@cache
def source(file: str) -> list[str]:
    """Return the lines of a file of the project."""
    return (ROOT / file).read_text(encoding="utf-8").splitlines()


def _of_function(entry: Mapping[str, str]) -> Iterator[Mapping[str, str]]:
    """Yield an explained hole for each line of a function; raise ProjectError without such a function."""
    inside = False
    name = entry["function"]
    for line in source(entry["file"]):
        inside = inside or (line.lstrip().startswith("function ") and f" {name}(" in line)
        if inside:
            yield {"file": entry["file"], "line": line.strip(), "why": entry["why"]}
        if inside and line.strip() == "endfunction":
            return
    raise ProjectError(f"{HOLES.name}: {entry['file']} has no function {name}")


def explained() -> list[Mapping[str, str]]:
    """Return the explained holes of holes.yml; raise ProjectError if one of the lines no longer exists."""
    entries: list[Mapping[str, str]] = []
    for entry in yaml.safe_load(HOLES.read_text(encoding="utf-8")) or []:
        entries += _of_function(entry) if "function" in entry else [entry]
    for entry in entries:
        if not any(entry["line"] == line.strip() for line in source(entry["file"])):
            raise ProjectError(f"{HOLES.name}: {entry['file']} has no line {entry['line']!r}")
    return entries


def folder_of(file: str) -> str:
    """Return the folder below rtl/ that a file belongs to."""
    return file.split("/")[1]


class Sums:
    """Points that all groups together cover, and the holes that are explained."""

    def __init__(self, points: Points) -> None:
        self._why = {(e["file"], e["line"], e.get("what", "")): e["why"] for e in explained()}
        self._units: dict[tuple[str, int, str, str], bool] = {}
        never = {(one.file, line) for one in left_out() for line in range(one.first, one.last + 1)}
        for name, was in points.reached.items():
            file, line, _, kind, what = name.split(" ", 4)
            if folder_of(file) in LEFT_OUT or (file, int(line)) in never:
                continue
            if kind in (BRANCH, TOGGLE):
                self._units[file, int(line), kind, self._named(name, kind, what)] = was
            for number in lines_of(points.spans[name]) if kind != TOGGLE and name in points.spans else ():
                place = (file, number, LINE, "")
                self._units[place] = was or self._units.get(place, False)

    @staticmethod
    def _named(name: str, kind: str, what: str) -> str:
        """Return the name of a point; its column distinguishes the branches of a line."""
        return f"{what}, column {name.split(' ')[2]}" if kind == BRANCH else what

    def folders(self) -> list[str]:
        """Return the folders below rtl/ with points."""
        return sorted({folder_of(file) for file, *_ in self._units})

    def files(self, folder: str) -> list[str]:
        """Return the files of a folder with points."""
        return sorted({file for file, *_ in self._units if folder_of(file) == folder})

    def figure(self, place: str, kind: str) -> Figure:
        """Return the figure of a folder or a file."""
        of = [
            (key, was)
            for key, was in self._units.items()
            if key[2] == kind and place in (key[0], folder_of(key[0]))
        ]
        known = sum(bool(not was and self._explanation(key)) for key, was in of)
        return Figure(sum(was for _, was in of), known, len(of))

    def holes(self, kind: str) -> Iterator[Hole]:
        """Yield the points that are not covered, by file and line."""
        for key in sorted(key for key, was in self._units.items() if not was and key[2] == kind):
            file, line, _, what = key
            yield Hole(file, line, kind, what, self._explanation(key))

    def _explanation(self, key: tuple[str, int, str, str]) -> str:
        file, line, _, what = key
        text = source(file)[line - 1].strip()
        word = what.partition(",")[0]
        return self._why.get((file, text, word), self._why.get((file, text, ""), ""))
