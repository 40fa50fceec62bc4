"""Reader of the pages with sessions that tests play."""

from __future__ import annotations

import re
from pathlib import Path

from cocotb_tests.harness.paths import ROOT

DOCS = ROOT / "docs"


def chapters(page: Path) -> dict[str, list[list[str]]]:
    """Return each chapter with sessions: its title -> its sessions, with one line for each access."""
    parts = re.split(r"^##+ (?=\d)", page.read_text(encoding="utf-8"), flags=re.M)[1:]
    found = {}
    for text in parts:
        blocks = re.findall(r"^```\n(.*?)^```", text, re.S | re.M)
        found[text.splitlines()[0]] = [block.splitlines() for block in blocks]
    return found
