"""Digest of the sources that the results of simulations depend on."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

from cocotb_tests.harness.project import ROOT

FOLDERS = ("rtl", "openppmc", "cocotb_tests", "tb", "scripts")
SIMULATED = ("rtl", "openppmc", "cocotb_tests", "tb")
"""Folders that a simulation of the RTL depends on."""
SUFFIXES = {".sv", ".svh", ".py", ".cpp", ".h", ".c", ".yml", ".vlt", ".asm", ".hex", ".mem", ".json"}


def files(folders: Iterable[str] = FOLDERS) -> list[Path]:
    """Return all sources below these folders of the project, in order of their names."""
    found = (path for folder in folders for path in (ROOT / folder).rglob("*") if path.suffix in SUFFIXES)
    return sorted(path for path in found if path.is_file())


def tree(folders: Iterable[str] = FOLDERS) -> str:
    """Return 12 hex digits: digest of names and contents of `files(folders)` and of all package versions."""
    sha = hashlib.sha256()
    for path in [*files(folders), ROOT / "requirements.lock"]:
        content = hashlib.sha256(path.read_bytes()).digest()
        sha.update(path.relative_to(ROOT).as_posix().encode() + b"\0" + content)
    return sha.hexdigest()[:12]
