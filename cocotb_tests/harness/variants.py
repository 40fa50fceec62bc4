"""Replacements of the RTL in a simulation: a mutant (`make mutate`), or copies that count coverage.

The environment variable OPENPPMC_MUTANT contains "FILE NUMBER COPY": the path of the original file, relative
to the root; the number of the active mutant; the path of the copy that contains all mutants. Failures of a
mutant are not repeated, shrunk or recorded for traceability.

OPENPPMC_COVERAGE names a folder to which each simulation writes a file with Verilator's counts.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from uuid import uuid4

from .paths import ROOT

MUTANT = "OPENPPMC_MUTANT"
MUTANT_WARNINGS = ("-Wno-lint", "-Wno-style", "-Wno-LATCH")
"""Warnings of Verilator that are disabled for the copy, because a mutant may look like a mistake."""


def mutant_present() -> bool:
    """Return whether a mutant is being tested."""
    return bool(os.environ.get(MUTANT))


def with_mutant(sources: Sequence[Path]) -> list[Path] | None:
    """Return the sources of a design with the mutated copy in place of the file.

    Return None if the design does not contain the file.
    """
    if not mutant_present():
        return None
    file, _, copy = os.environ[MUTANT].split(" ", 2)
    found = [Path(copy) if ROOT / path == ROOT / file else path for path in sources]
    return None if found == list(sources) else found


def mutant_plusargs() -> list[str]:
    """Return the arguments that select the mutant in the simulation."""
    return [f"+mutant={os.environ[MUTANT].split(' ', 2)[1]}"] if mutant_present() else []


COVERAGE = "OPENPPMC_COVERAGE"
COVERAGE_COPIES = "OPENPPMC_COUNTED"
"""Environment variable that names the folder with the rewritten copy of rtl/, in which Verilator counts line
coverage correctly (`scripts.measure.coverage.counted`).
"""
COVERAGE_FILE = "coverage.dat"
"""Name of the file with the counts in the folder of a run."""


def counts_coverage() -> bool:
    """Return whether simulations count coverage."""
    return bool(os.environ.get(COVERAGE))


def coverage_args() -> list[str]:
    """Return the additional arguments of Verilator for coverage."""
    return ["--coverage-line", "--coverage-toggle"] if counts_coverage() else []


def with_counters(sources: Sequence[Path]) -> list[Path]:
    """Return the sources of a design, with the copy in place of each file that has a copy."""
    folder = os.environ.get(COVERAGE_COPIES)
    if not folder:
        return list(sources)
    pairs = [(path, Path(folder) / os.path.relpath(ROOT / path, ROOT)) for path in sources]
    return [copy if copy.is_file() else path for path, copy in pairs]


def keep_counts(folder: Path) -> None:
    """Move the counts of the simulation in this folder to the coverage folder."""
    if (where := os.environ.get(COVERAGE)) and (folder / COVERAGE_FILE).is_file():
        Path(where).mkdir(parents=True, exist_ok=True)
        (folder / COVERAGE_FILE).replace(Path(where) / f"{uuid4().hex}.dat")
