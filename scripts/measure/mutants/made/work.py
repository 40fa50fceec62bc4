"""Run proofs and tests on one mutant until one fails.

The order is: proofs of the mutant's block, groups of tests, proofs of the blocks that contain this block.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Container, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from cocotb_tests.harness.build import locked
from cocotb_tests.harness.project import BUILD, ROOT
from cocotb_tests.harness.simulate import TIMEOUT
from cocotb_tests.harness.variants import MUTANT
from scripts.measure.campaign.jobs import Result
from scripts.measure.coverage.work import pytest as run_pytest
from scripts.measure.mutants.made.faults import Fault, faults
from scripts.measure.mutants.made.proved import failing, proofs_of
from scripts.measure.mutants.made.schema import instrumented
from scripts.measure.mutants.made.suites import Group

WALL_S = "100"
"""Time limit of one test in s."""
PROOF = "proof "
KILLED, EQUAL, ALIVE, ENDLESS, BROKEN = "killed", "equal", "alive", "no end", "no build"


@dataclass(frozen=True)
class Bulk:
    """Mutants of the same file or folder that are tried together, as pairs of file and number."""

    mutants: tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Mutant:
    """A mutant and its tests.

    Attributes:
        briefly: True if only the proofs of the mutant's own block are run.
    """

    file: str
    fault: Fault
    groups: tuple[Group, ...]
    briefly: bool = False

    @property
    def key(self) -> str:
        """Key of the mutant, which is unique among all mutants of the project."""
        return f"{self.file} {self.fault.number}"


@cache
def digest(file: str) -> str:
    """Return the digest of a source file when it was first used, because it may change during a long run."""
    return hashlib.sha256((ROOT / file).read_bytes()).hexdigest()[:12]


def copy_of(file: str) -> Path:
    """Return the path of the copy with all mutants of a file; write the copy if needed."""
    text = (ROOT / file).read_text(encoding="utf-8")
    return _stored(file, instrumented(text, faults(text)))


def noting_copy_of(file: str, numbers: Container[int], first: int) -> Path:
    """Return the path of a copy with these mutants and notes; `first` is added to their numbers."""
    text = (ROOT / file).read_text(encoding="utf-8")
    found = [replace(fault, number=first + fault.number) for fault in faults(text) if fault.number in numbers]
    return _stored(file, instrumented(text, found, notes=True))


def _stored(file: str, copy: str) -> Path:
    path = BUILD / "mutants" / hashlib.sha256(copy.encode()).hexdigest()[:12] / Path(file).name
    with locked(path.parent.with_suffix(".lock")):
        if not path.is_file():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(copy, encoding="utf-8")
    return path


def pytest(mutant: Mutant, tests: Sequence[str]) -> tuple[str, str]:
    """Run the tests; return the result for the mutant, and the name of the first test that failed."""
    chosen = f"{mutant.file} {mutant.fault.number} {copy_of(mutant.file)}"
    variables = {MUTANT: chosen, "OPENPPMC_WALL_S": WALL_S}
    code, text = run_pytest(variables, "-x", "-p", "no:cacheprovider", *tests)
    if code == 0:
        return ALIVE, ""
    failed = re.search(r"^(?:FAILED|ERROR) (\S+)", text, re.MULTILINE)
    name = failed[1] if failed else ""
    if "build of " in text and " failed (exit code" in text:
        return BROKEN, "\n".join(re.findall(r"^.*%(?:Error|Warning).*$", text, re.MULTILINE)[:3])
    if not failed:
        return BROKEN, text[-300:]
    return (ENDLESS if TIMEOUT in text else KILLED), name


def met(mutant: Mutant) -> tuple[str, str]:
    """Return the result for the mutant, and the test (or `PROOF` and the proof) that killed it."""
    own, others = proofs_of(mutant.file)
    if name := failing(mutant.file, mutant.fault, own):
        return KILLED, PROOF + name
    for group in mutant.groups:
        verdict, test = pytest(mutant, group)
        if verdict != ALIVE:
            return verdict, test
    if not mutant.briefly and (name := failing(mutant.file, mutant.fault, others)):
        return KILLED, PROOF + name
    return ALIVE, ""


def run_one(mutant: Mutant) -> Result:
    """Try one mutant. A test that does not terminate has a different result than a failing check."""
    verdict, test = met(mutant)
    return Result(verdict != BROKEN, {"verdict": verdict, "test": test, "file": digest(mutant.file)})
