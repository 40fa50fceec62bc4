"""Tests for the mutants of a file: groups of tests, each in one simulator process, the fastest first.

If results of a coverage campaign are stored (`make coverage`), only groups that may cover the line of the
mutant run. Their order is: groups of the block, groups that are newer than the campaign, all other groups by
their time for each covered point of the file.

Without such results, the groups of the folder run: tests of blocks before tests of parts that contain the
file, directed tests before random tests.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from cocotb_tests.harness.project import ROOT, files
from openppmc import parts
from scripts.measure.campaign.jobs import Done
from scripts.measure.campaign.store import Store
from scripts.measure.coverage.points import Points, lines_of
from scripts.measure.coverage.work import groups

BLOCKS = {
    "common": ("cocotb_tests/common/test_blocks.py",),
    "motion": ("cocotb_tests/motion/test_blocks.py",),
    "host": ("cocotb_tests/host/",),
    "single": ("cocotb_tests/single/test_blocks.py",),
    "ppmc312": ("cocotb_tests/ppmc312/stages/test_blocks.py",),
}
"""Tests of single blocks, by folder of rtl/."""
AT_LAST = ("cocotb_tests/common/test_benches.py", "cocotb_tests/board/")

Group = tuple[str, ...]
GUIDED, FEW = 6, 2
"""Numbers of groups in one pytest run: for groups that cover the line, and for groups that may cover it."""


@cache
def every() -> list[Group]:
    """Return all groups of `make test`."""
    return [tuple(tests) for tests in groups()]


def _part(group: Group) -> parts.Row | None:
    """Return the part that the tests of a group belong to."""
    rows = (row for row in parts.folders() if group[0].startswith(f"cocotb_tests/{row.name}/"))
    return next(rows, None)


def _may_reach(group: Group, file: str) -> bool:
    """Return whether a group may simulate the file; it is used for groups without stored coverage."""
    return _part(group) is None or _rank(group, file) >= 0


def _rank(group: Group, file: str) -> int:
    """Return the rank of a group, the lowest runs first; -1 for tests that do not simulate the file."""
    folder, first = file.split("/")[1], group[0]
    if first.startswith(BLOCKS.get(folder, ())):
        return 0
    part = _part(group)
    if part is None or first.startswith(AT_LAST):
        return 9 if first.startswith(AT_LAST) else -1
    carrier = f"{part.rtl}_carrier"
    if ROOT / file not in files(*([part.rtl, carrier] if part.carrier else [part.rtl])):
        return -1
    return 3 if "random" in first else 1 if "test_part" in first else 2


@dataclass(frozen=True)
class _Reach:
    """Coverage of a group: covered lines of each file, and the number of covered points of each file."""

    group: Group
    seconds: float
    lines: dict[str, set[int]]
    weights: Counter[str]


class Suites:
    """Groups of tests; `of` returns the groups for a line of a file."""

    def __init__(self) -> None:
        self._reached: list[_Reach] = []
        known = {f"{group[0]} {len(group)}": group for group in every()}
        latest: dict[str, Done] = {}
        with Store() as store:
            for _, done in store.all("coverage"):
                if done.key in known and done.good:
                    latest[done.key] = done
        for key, done in latest.items():
            points = Points.unpack(done.data["points"])
            self._reached.append(_Reach(known[key], done.seconds, _lines(points), _weights(points)))
        self._new = [group for key, group in known.items() if key not in latest]
        # The stored coverage may lack a few groups that are newer than the campaign. The coverage of a sample
        # lacks too many groups, so it is not used.
        self.guided = len(self._new) <= len(known) // 4

    def of(self, file: str, line: int) -> list[Group]:
        """Return the groups in the order of their runs; some are joined, because each start takes seconds."""
        own = Path(file).stem.partition("_")[2]
        if self.guided:
            found = [
                (own not in reach.group[0], reach.seconds / reach.weights[file], reach.group)
                for reach in self._reached
                if reach.weights[file] and line in reach.lines.get(file, ())
            ]
            found += [(True, 0.0, group) for group in self._new if _may_reach(group, file)]
            return list(_together([group for *_, group in sorted(found)], GUIDED))
        ranked: dict[int, list[Group]] = {}
        for group in every():
            if (rank := _rank(group, file)) >= 0:
                ranked.setdefault(-1 if rank == 0 and own in group[0] else rank, []).append(group)
        return [
            tests for rank in sorted(ranked) for tests in _together(ranked[rank], 1000 if rank <= 0 else FEW)
        ]


def _together(all_groups: Sequence[Group], size: int) -> Iterator[Group]:
    """Join every `size` successive groups into one; the order of the tests does not change."""
    for at in range(0, len(all_groups), size):
        yield tuple(test for group in all_groups[at : at + size] for test in group)


def _weights(points: Points) -> Counter[str]:
    """Return the number of covered points of each file."""
    return Counter(name.split(" ", 1)[0] for name, was in points.reached.items() if was)


def _lines(points: Points) -> dict[str, set[int]]:
    """Return the covered lines of each file; lines without a point, such as assignments, are included."""
    found: dict[str, set[int]] = {}
    for name, was in points.reached.items():
        file = name.split(" ", 1)[0]
        lines = found.setdefault(file, set())
        if was and name in points.spans:
            lines.update(lines_of(points.spans[name]))
    counted: dict[str, set[int]] = {}
    for name, span in points.spans.items():
        counted.setdefault(name.split(" ", 1)[0], set()).update(lines_of(span))
    for file, lines in found.items():
        total = len((ROOT / file).read_text(encoding="utf-8").splitlines())
        lines.update(set(range(1, total + 1)) - counted.get(file, set()))
    return found
