"""`Story`: the chapters of a demo, and what a run of it leaves behind."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from cocotb_tests.harness.bench import Bench


class Story:
    """Chapters of the run: what happened between which clk edges.

    The running one is the last line of the file `progress`; `save` leaves story.json (the chapters) and
    recording.json (all pin changes and output edges) in the run's folder.
    """

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.chapters: list[dict[str, Any]] = []

    @contextmanager
    def chapter(self, key: str, title: str) -> Iterator[None]:
        """Everything that the block does belongs to this chapter."""
        with (self.bench.out / "progress").open("a") as file:
            file.write(title + "\n")
        begin = self.bench.now
        yield
        self.chapters.append({"key": key, "title": title, "begin": begin, "end": self.bench.now})

    def save(self) -> None:
        """Write story.json and recording.json."""
        (self.bench.out / "story.json").write_text(json.dumps(self.chapters, indent=1))
        (self.bench.out / "recording.json").write_text(self.bench.recording().to_json())
