"""Folders of the project, as paths below its root (no absolute path is ever written to a file)."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build"
SIM_BUILDS = BUILD / "sim"
RUNS = BUILD / "runs"
FAILURES = BUILD / "failures"
WAVES = BUILD / "waves"
TRACE = BUILD / "trace"


def relative(path: Path | str) -> str:
    """Return a path in the form shown to the user: relative to the project root if possible."""
    path = Path(path)
    try:
        return str(path.resolve().relative_to(ROOT))
    except ValueError:
        return str(path)
