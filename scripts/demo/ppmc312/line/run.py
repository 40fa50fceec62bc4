"""The files in which a run of the line demo stores its result."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from openppmc.check.records import Recording
from scripts.demo.ppmc312.line.talk import Exchange, exchanges


@dataclass(frozen=True)
class LineRun:
    """Result of a run: the recording of the line, chapters, exchanges, and the positions that were read."""

    recording: Recording
    chapters: list[dict[str, Any]]
    talk: list[Exchange]
    positions: list[int]


def load(folder: Path) -> LineRun:
    """Read the result of a run from its folder."""
    data = json.loads((folder / "talk.json").read_text())
    return LineRun(
        Recording.from_json((folder / "recording.json").read_text()),
        json.loads((folder / "chapters.json").read_text()),
        exchanges(data["talk"]),
        data["positions"],
    )
