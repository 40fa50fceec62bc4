"""One mutant on a worker: the proofs of its block, then its groups of tests, then the proofs of the blocks
that hold it, one after the other, until one fails."""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from cocotb_tests.harness.build import locked
from cocotb_tests.harness.project import BUILD, ROOT
from cocotb_tests.harness.simulate import TIMEOUT
from cocotb_tests.harness.variants import MUTANT
from scripts.measure.campaign.jobs import Result
from scripts.measure.mutants.made.faults import Fault, faults
from scripts.measure.mutants.made.proved import failing, proofs_of
from scripts.measure.mutants.made.schema import instrumented
from scripts.measure.mutants.made.suites import Group

WALL_S = "100"
"""Of one test, in s."""
PROOF = "proof "
KILLED, ALIVE, ENDLESS, BROKEN = "killed", "alive", "no end", "no build"


@dataclass(frozen=True)
class Mutant:
    """One, and the tests that it meets; `briefly`: no proof but those of its block."""

    file: str
    fault: Fault
    groups: tuple[Group, ...]
    briefly: bool = False

    @property
    def key(self) -> str:
        """Unique among all mutants of the tree."""
        return f"{self.file} {self.fault.number}"


def digest(file: str) -> str:
    """Of the file that mutants are made of."""
    return hashlib.sha256((ROOT / file).read_bytes()).hexdigest()[:12]


def copy_of(file: str) -> Path:
    """The copy with all mutants of a file; written if need be."""
    text = (ROOT / file).read_text(encoding="utf-8")
    copy = instrumented(text, faults(text))
    path = BUILD / "mutants" / hashlib.sha256(copy.encode()).hexdigest()[:12] / Path(file).name
    with locked(path.parent.with_suffix(".lock")):
        if not path.is_file():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(copy, encoding="utf-8")
    return path


def pytest(mutant: Mutant, tests: Sequence[str]) -> tuple[str, str]:
    """Run some tests; what became of the mutant, and the first test that failed."""
    environment = {
        **os.environ,
        MUTANT: f"{mutant.file} {mutant.fault.number} {copy_of(mutant.file)}",
        "OPENPPMC_WALL_S": WALL_S,
    }
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *tests]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return ALIVE, ""
    failed = re.search(r"^(?:FAILED|ERROR) (\S+)", done.stdout, re.MULTILINE)
    name = failed[1] if failed else ""
    if "build of " in done.stdout and " failed (exit code" in done.stdout:
        return BROKEN, "\n".join(re.findall(r"^.*%(?:Error|Warning).*$", done.stdout, re.MULTILINE)[:3])
    if not failed:
        return BROKEN, (done.stdout + done.stderr)[-300:]
    return (ENDLESS if TIMEOUT in done.stdout else KILLED), name


def met(mutant: Mutant) -> tuple[str, str]:
    """What became of the mutant, and what it was killed by: the name of a test, or `PROOF` and of a proof."""
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
    """Try one mutant. A result without end counts apart from one that a check has found."""
    verdict, test = met(mutant)
    return Result(verdict != BROKEN, {"verdict": verdict, "test": test, "file": digest(mutant.file)})
