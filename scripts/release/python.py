"""Wheel and sdist of the Python package. They are built from the files in git, and checked by twine."""

from __future__ import annotations

import sys
from pathlib import Path

from cocotb_tests.harness.project import ROOT, ProjectError, ran
from openppmc import __version__
from scripts.release.archive import again
from scripts.release.state import Release, tracked

SOURCES = ("openppmc", "pyproject.toml", "LICENSE")


def _run(*words: str, folder: Path) -> None:
    code, text = ran([sys.executable, "-m", *words], cwd=folder)
    if code:
        lines = [line for line in text.splitlines() if line.strip()]
        raise ProjectError("\n".join([f"{words[0]} failed:", *lines[-5:]]))


def set_version(tree: Path, version: str) -> None:
    """Write a version into a copy of the package, because the version of a trial is different."""
    path = tree / "openppmc" / "__init__.py"
    line = f'__version__ = "{__version__}"'
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(line, f'__version__ = "{version}"'), encoding="utf-8")


def make(release: Release, out: Path, scratch: Path) -> None:
    """Write wheel and sdist to `out`."""
    tree = scratch / "python"
    for path in tracked(*SOURCES):
        copy = tree / path
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes((ROOT / path).read_bytes())
        copy.chmod(0o644)
    set_version(tree, release.version)
    made = scratch / "made"
    _run("build", "--no-isolation", "--outdir", str(made), str(tree), folder=scratch)
    _run("twine", "check", "--strict", *sorted(str(path) for path in made.iterdir()), folder=scratch)
    again(made / f"openppmc-{release.version}.tar.gz", release.epoch)
    for path in made.iterdir():
        path.rename(out / path.name)
