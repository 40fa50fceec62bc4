"""One job of the coverage campaign: it runs a group of tests with counting builds in a separate pytest."""

from __future__ import annotations

import json
import os
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from cocotb_tests.harness.crosses import SUFFIX
from cocotb_tests.harness.project import ProjectError, ran
from cocotb_tests.harness.variants import COVERAGE, COVERAGE_COPIES
from scripts.measure.campaign.jobs import Result
from scripts.measure.coverage import points
from scripts.measure.coverage.collecting import OUT
from scripts.measure.coverage.counted import copies

WALL_S = {"OPENPPMC_WALL_S": "1200"}
"""Wall-clock limit of a test in s.

It is high, because a simulation with coverage counters takes several times as long as one without them.
"""


def pytest(variables: Mapping[str, str], *words: str) -> tuple[int, str]:
    """Run pytest with these environment variables; return its exit code and its output."""
    return ran([sys.executable, "-m", "pytest", "-q", *words], {**os.environ, **variables})


def groups(words: Sequence[str] = ()) -> list[list[str]]:
    """Return the tests of `make test` that simulate and whose names contain a word, one list per process."""
    with TemporaryDirectory(prefix="openppmc-") as folder:
        out = Path(folder) / "groups.json"
        chosen = ["-k", " or ".join(words)] if words else []
        collect = ("--collect-only", "-p", "scripts.measure.coverage.collecting", "cocotb_tests")
        code, text = pytest({OUT: str(out)}, *collect, *chosen)
        if not out.is_file():
            said = text.strip().splitlines()
            raise ProjectError(f"pytest collects nothing: {said[-1] if said else code}")
        found: list[list[str]] = json.loads(out.read_text(encoding="utf-8"))
    if not found:
        raise ProjectError(f"no test matches T={','.join(words)}")
    return found


def run_group(tests: Sequence[str]) -> Result:
    """Run these tests; return the covered points in packed form, and the crosses."""
    with TemporaryDirectory(prefix="openppmc-") as folder:
        variables = {**WALL_S, COVERAGE: folder, COVERAGE_COPIES: str(copies())}
        code, text = pytest(variables, "-p", "no:cacheprovider", *tests)
        reached = points.read(sorted(Path(folder).glob("*.dat")))
        crosses: Counter[str] = Counter()
        for file in Path(folder).glob(f"*{SUFFIX}"):
            for line in file.read_text(encoding="utf-8").splitlines():
                for *key, number in json.loads(line):
                    crosses["\t".join(key)] += number
    data = {"points": reached.pack(), "crosses": dict(crosses), "tests": len(tests)}
    if code:
        tail = "\n".join(text.strip().splitlines()[-15:])
        return Result(False, {**data, "message": f"{tests[0]}, {len(tests)} tests:\n{tail}"})
    return Result(True, data)
