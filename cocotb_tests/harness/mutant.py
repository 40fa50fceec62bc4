"""A mutant in place of a file of the RTL, if MUTANT in the environment names one (`scripts.mutants.made`).

"FILE NUMBER COPY": the file as seen from the project's root, which of the mutants in its copy, and the copy.
A failure is then no more than that: it is not run again, shrunk or written down for the traceability pages.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from .paths import ROOT

MUTANT = "OPENPPMC_MUTANT"
WARNINGS = ("-Wno-lint", "-Wno-style", "-Wno-LATCH")
"""What Verilator need not say of a copy: a fault may well look like one."""


def present() -> bool:
    """Whether a mutant is tried."""
    return bool(os.environ.get(MUTANT))


def copied(sources: Sequence[Path]) -> list[Path] | None:
    """Sources of a design with the copy in place of the file; None if they do not have it."""
    if not present():
        return None
    file, _, copy = os.environ[MUTANT].split(" ", 2)
    found = [Path(copy) if ROOT / path == ROOT / file else path for path in sources]
    return None if found == list(sources) else found


def plusargs() -> list[str]:
    """What tells the simulation which mutant it has."""
    return [f"+mutant={os.environ[MUTANT].split(' ', 2)[1]}"] if present() else []
