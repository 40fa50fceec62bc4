"""Result page of a self-test, which users attach to an issue: as text, and as values for JSON."""

from __future__ import annotations

import json
import platform
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

from ... import __version__
from ...parts import by_number
from ..capabilities import name_of
from ..link import Link
from ..script import Build
from .run import SectionResult, SelfTestResult

BOARDS = {
    "ICEB": "iCEBreaker",
    "ULX3": "ULX3S",
    "UX31": "ULX3S v3.1",
    "TN20": "Tang Nano 20K",
    "TN09": "Tang Nano 9K",
    "TN04": "Tang Nano 4K",
    "CL70": "Colorlight 5A-75B V7.0",
    "VIRT": "virtual board",
    "MODL": "golden model",
}
"""Names of boards.

A key is the code with which a bitstream identifies its board (`code` in constraints/*/board.yml).
"""


def board_name(build: Build | None) -> str:
    """Return the name of the board, or "board" if the bitstream does not report the board."""
    letters = build.board if build is not None else ""
    return BOARDS.get(letters, letters or "board")


def verdict(found: SelfTestResult) -> str:
    """Return the last line of the page, which states whether the self-test has passed."""
    count = found.differences
    board = board_name(found.build)
    return f"{found.edges} edges compared on your {board}, {count} difference{'' if count == 1 else 's'}"


def built(build: Build | None) -> str:
    """Return the build of a bitstream as text."""
    if build is None:
        return "does not report its version"
    commit = f", commit {build.commit}{' with changes' if build.changed else ''}" if build.commit else ""
    return f"version {build.version}, sources {build.source or 'none'}{commit}"


def _section(outcome: SectionResult) -> dict[str, Any]:
    return {
        "section": outcome.section.title,
        "kind": outcome.section.what,
        "folder": outcome.section.folder,
        "records": outcome.records,
        "clk": outcome.clk,
        "edges": outcome.edges,
        "pulses": outcome.pulses,
        "result": outcome.difference or outcome.skipped or "no difference",
        "good": not outcome.difference,
        **({"report": outcome.report.splitlines()} if outcome.report else {}),
    }


def values(link: Link, found: SelfTestResult, notes: list[str]) -> dict[str, Any]:
    """Return all results as values for JSON.

    Args:
        notes: further messages, one per line.
    """
    identity, build, info = link.identity, found.build, found.recorder
    row = by_number(identity.part)
    return {
        "board": board_name(build),
        "bitstream": None if build is None else vars(build),
        "package": __version__,
        "python": platform.python_version(),
        "system": platform.platform(terse=True),
        "time": datetime.now(timezone.utc).isoformat(timespec="seconds"),
        "port": link.name,
        "part": row.title if row else name_of(identity.part),
        "timing": "DATASHEET" if identity.datasheet else "FAST",
        "crystal_hz": identity.xtal_hz,
        "clock_hz": identity.clk_hz,
        "parameters": found.params,
        "recorder": None
        if info is None
        else {"records": info.most, "bytes": info.record_bytes, "levels": info.width},
        "rates": {str(rate): repeats for rate, repeats in found.rates.items()},
        "notes": notes,
        "sections": [_section(outcome) for outcome in found.outcomes],
        "edges": found.edges,
        "differences": found.differences,
        "verdict": verdict(found),
    }


def text(page: dict[str, Any], build: Build | None) -> str:
    """Return all results as text."""

    def line_rate(rate: str, repeats: int | None) -> str:
        if repeats is None:
            return f"{rate} not with this adapter"
        return f"{rate} ({repeats} repeated)" if repeats else rate

    recorder = page["recorder"]
    rows = {
        "board": page["board"],
        "bitstream": built(build),
        "part": f"{page['part']}, {page['timing']} timing, crystal {page['crystal_hz'] / 1e6:g} MHz, "
        f"clk {page['clock_hz'] / 1e6:g} MHz",
        "package": f"openppmc {page['package']}, Python {page['python']}, {page['system']}",
        "time": page["time"],
        "port": page["port"],
        "line rates": ", ".join(line_rate(*pair) for pair in page["rates"].items()),
        "recorder": f"{recorder['records']} records of {recorder['levels']} levels" if recorder else "none",
        "model": ", ".join(f"{name}={value}" for name, value in page["parameters"].items()),
    }
    lines = ["OpenPPMC self-test", "", *(f"{name:<11} {value}" for name, value in rows.items())]
    lines += [f"{'note':<11} {note}" for note in page["notes"]]
    lines += ["", f"{'records':>8} {'edges':>6} {'pulses':>6}  section"]
    for one in page["sections"]:
        result_text = "" if one["result"] == "no difference" else f": {one['result']}"
        lines.append(
            f"{one['records']:>8} {one['edges']:>6} {one['pulses']:>6}  {one['kind']}: "
            f"{one['section']}{result_text}"
        )
    for one in page["sections"]:
        lines += ["", *one["report"]] if "report" in one else []
    return "\n".join([*lines, "", page["verdict"], ""])


def write(folder: Path, page: dict[str, Any], build: Build | None) -> tuple[Path, Path]:
    """Write selftest.txt and selftest.json. Raises OSError."""
    folder.mkdir(parents=True, exist_ok=True)
    pages = folder / "selftest.txt", folder / "selftest.json"
    pages[0].write_text(text(page, build), encoding="utf-8")
    pages[1].write_text(json.dumps(page, indent=1) + "\n", encoding="utf-8")
    return pages
