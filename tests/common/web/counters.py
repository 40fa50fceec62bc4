"""Figures of a run, stored in build/site/figures.txt; `make test-web` prints them at its end."""

from __future__ import annotations

from collections.abc import Sequence

from cocotb_tests.harness.paths import ROOT
from scripts.site.sessions import sessions

FILE = ROOT / "build/site/figures.txt"


def left_out(part: str, ends: Sequence[int], most: int, why: str) -> str:
    """Return text about the sessions whose ends in cycles are `most` or more; "" without such sessions."""
    titles = [session.name for session in sessions(part)]
    every = zip(titles, ends, strict=True)
    long = [f"{name} ({end // 10**6} million clk)" for name, end in every if end >= most]
    return f"; without {', '.join(long)}: {why}" if long else ""


def add(line: str) -> None:
    """Store a line."""
    FILE.parent.mkdir(parents=True, exist_ok=True)
    with FILE.open("a", encoding="utf-8") as out:
        out.write(f"{line}\n")
