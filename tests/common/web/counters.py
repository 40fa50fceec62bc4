"""Figures of a run, stored in build/site/figures.txt; `make test-web` prints them at its end."""

from __future__ import annotations

from collections.abc import Sequence

from cocotb_tests.harness.paths import ROOT
from scripts.site.sessions import sessions

FILE = ROOT / "build/site/figures.txt"


def left_out(part: str, ends: Sequence[int], most: int, why: str) -> str:
    """Return a note on the sessions that last `most` cycles or longer; "" if there is none."""
    titles = [session.name for session in sessions(part)]
    every = zip(titles, ends, strict=True)
    long = [f"{name} ({end // 10**6} million cycles)" for name, end in every if end >= most]
    return f"; without {', '.join(long)}: {why}" if long else ""


def add(line: str) -> None:
    """Store a line with figures."""
    FILE.parent.mkdir(parents=True, exist_ok=True)
    with FILE.open("a", encoding="utf-8") as out:
        out.write(f"{line}\n")
