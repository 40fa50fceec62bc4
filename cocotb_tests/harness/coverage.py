"""Coverage of the RTL, if COVERAGE in the environment names a folder for it: builds count, runs leave counts.

A file a simulation, Verilator's coverage.dat; `scripts.coverage` reads them.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from uuid import uuid4

from .paths import ROOT

COVERAGE = "OPENPPMC_COVERAGE"
COPIES = "OPENPPMC_COUNTED"
"""Names a folder with copies of rtl/ that Verilator counts right (`scripts.coverage.counted`)."""
FILE = "coverage.dat"
"""In the folder of a run."""


def present() -> bool:
    """Whether simulations count."""
    return bool(os.environ.get(COVERAGE))


def build_args() -> list[str]:
    """What Verilator is told beside all else."""
    return ["--coverage-line", "--coverage-toggle"] if present() else []


def copied(sources: Sequence[Path]) -> list[Path]:
    """Sources of a design, the copies in place of what has one."""
    folder = os.environ.get(COPIES)
    if not folder:
        return list(sources)
    pairs = [(path, Path(folder) / os.path.relpath(ROOT / path, ROOT)) for path in sources]
    return [copy if copy.is_file() else path for path, copy in pairs]


def keep(folder: Path) -> None:
    """Put away what the simulation in this folder has counted."""
    if (where := os.environ.get(COVERAGE)) and (folder / FILE).is_file():
        Path(where).mkdir(parents=True, exist_ok=True)
        (folder / FILE).replace(Path(where) / f"{uuid4().hex}.dat")
