"""Points of the RTL that Verilator counts, from its coverage.dat (one `C '<fields>' <count>` a line).

A point is named "<file> <line> <column> <kind> <what>", the file as seen from the project's root. The same
place in several instances, parameter sets and simulations is one point: it is reached if any has reached it.
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
    """`reached`: of each point, whether it was. `spans`: the source lines of a point, "108-109,155"."""

    reached: dict[str, bool] = field(default_factory=dict)
    spans: dict[str, str] = field(default_factory=dict)

    def add(self, other: Points) -> None:
        """Those of `other` as well."""
        for name, was in other.reached.items():
            self.reached[name] = was or self.reached.get(name, False)
        self.spans.update(other.spans)

    def pack(self) -> str:
        """As text for a file of results."""
        text = json.dumps([self.reached, self.spans], sort_keys=True)
        return base64.b85encode(zlib.compress(text.encode(), 9)).decode()

    @classmethod
    def unpack(cls, text: str) -> Points:
        """Inverse of `pack`."""
        return cls(*json.loads(zlib.decompress(base64.b85decode(text))))


def _fields(text: str) -> Mapping[str, str]:
    return dict(part.split("\x02", 1) for part in text.split("\x01")[1:])


def read(files: Iterable[Path]) -> Points:
    """All points of the RTL in these files; what lies elsewhere (benches, wrappers) does not count."""
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
    """Numbers of the source lines in "108-109,155"."""
    found: list[int] = []
    for part in span.split(","):
        first, _, last = part.partition("-")
        found += range(int(first), int(last or first) + 1)
    return found
