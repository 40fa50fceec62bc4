"""Points of the RTL that Verilator counts, from its coverage.dat (lines `C '<fields>' <count>`).

A point has the name "<file> <line> <column> <kind> <what>", with the file relative to the project's root. A
place is one point, even if it occurs in several instances, parameter sets and simulations; it is covered if
one of these occurrences is covered.
"""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

LINE, BRANCH, TOGGLE = "line", "branch", "toggle"
RTL = "rtl/"


@dataclass
class Points:
    """Points of a run.

    Attributes:
        reached: for each point, whether it was covered.
        spans: for each point, its source lines, such as "108-109,155".
    """

    reached: dict[str, bool] = field(default_factory=dict)
    spans: dict[str, str] = field(default_factory=dict)

    def add(self, other: Points) -> None:
        """Add the points of another run."""
        for name, was in other.reached.items():
            self.reached[name] = was or self.reached.get(name, False)
        self.spans.update(other.spans)

    def pack(self) -> str:
        """Return the points as text for the file of results."""
        text = json.dumps([self.reached, self.spans], sort_keys=True)
        return base64.b85encode(zlib.compress(text.encode(), 9)).decode()

    @classmethod
    def unpack(cls, text: str) -> Points:
        """Return the points from a text of `pack`."""
        return cls(*json.loads(zlib.decompress(base64.b85decode(text))))


def _fields(text: str) -> Mapping[str, str]:
    return dict(part.split("\x02", 1) for part in text.split("\x01")[1:])


def read(files: Iterable[Path]) -> Points:
    """Return all points of the RTL in these files, without those of other sources (benches, wrappers)."""
    points = Points()
    for file in files:
        for line in file.read_text(encoding="utf-8", errors="replace").splitlines():
            if not line.startswith("C '"):
                continue
            text, _, number = line[3:].rpartition("' ")
            given = _fields(text)
            at = given["f"].rfind(RTL)
            if at < 0 or given["f"][at - 1 : at] not in ("", "/"):
                continue
            kind = given["page"].partition("/")[0].removeprefix("v_")
            name = " ".join((given["f"][at:], given["l"], given["n"], kind, given["o"]))
            points.reached[name] = points.reached.get(name, False) or number != "0"
            if "S" in given:
                points.spans[name] = given["S"]
    return points


def lines_of(span: str) -> list[int]:
    """Return the numbers of the source lines in "108-109,155"."""
    found: list[int] = []
    for part in span.split(","):
        first, _, last = part.partition("-")
        found += range(int(first), int(last or first) + 1)
    return found
