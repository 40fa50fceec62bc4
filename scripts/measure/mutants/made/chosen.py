"""Mutants of a run: all mutants of the selected files, or a sample that grows with COUNT."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

from cocotb_tests.harness.project import ROOT, RTL, ProjectError, relative
from scripts.measure.mutants.made.faults import Fault, faults

LEFT_OUT = ("boards",)
"""Folders of rtl/ that `make test` does not simulate."""


@cache
def of_file(file: str) -> list[Fault]:
    """Return all mutants of a file of rtl/."""
    return faults((ROOT / file).read_text(encoding="utf-8"))


def folder_of(file: str) -> str:
    """Return the folder below rtl/ to which a file belongs."""
    return file.split("/")[1]


def rtl_files(word: str = "") -> list[str]:
    """Return the files of a folder of rtl/, or those with the word in their path, or raise ProjectError."""
    every = [relative(path) for path in sorted(RTL.rglob("*.sv"))]
    every = [file for file in every if folder_of(file) not in LEFT_OUT]
    found = [file for file in every if folder_of(file) == word] or [file for file in every if word in file]
    if not found:
        folders = ", ".join(sorted({folder_of(file) for file in every}))
        raise ProjectError(f"T={word}: no such folder or file of rtl/ (folders: {folders})")
    return found


def _lot(file: str, number: int) -> str:
    return hashlib.sha256(f"{Path(file).name} {number}".encode()).hexdigest()


def sample(files: Sequence[str], count: int | None) -> Iterator[tuple[str, Fault]]:
    """Yield `count` pseudo-random mutants of each folder; a higher count yields the same and further ones."""
    lots = [(_lot(file, fault.number), file, fault) for file in files for fault in of_file(file)]
    drawn: Counter[str] = Counter()
    kept = []
    for lot, file, fault in sorted(lots, key=lambda one: one[0]):
        drawn[folder_of(file)] += 1
        if count is None or drawn[folder_of(file)] <= count:
            kept.append((file, fault.number, lot, fault))
    yield from ((file, fault) for file, _, _, fault in sorted(kept, key=lambda one: one[:2]))
