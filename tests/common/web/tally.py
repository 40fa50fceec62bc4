"""Figures of a run, kept for its last lines: build/site/figures.txt, printed by `make test-web`."""

from __future__ import annotations

from collections.abc import Sequence

from cocotb_tests.harness.paths import ROOT
from scripts.site.sessions import sessions

FILE = ROOT / "build/site/figures.txt"


def left_out(part: str, ends: Sequence[int], most: int, why: str) -> str:
    """Which of the sessions of a part, by their ends in clk, are longer than `most`; "" if none is."""
    titles = [session.name for session in sessions(part)]
    every = zip(titles, ends, strict=True)
    long = [f"{name} ({end // 10**6} million clk)" for name, end in every if end >= most]
    return f"; without {', '.join(long)}: {why}" if long else ""


def told(line: str) -> None:
    """Keep a line."""
    FILE.parent.mkdir(parents=True, exist_ok=True)
    with FILE.open("a", encoding="utf-8") as out:
        out.write(f"{line}\n")
