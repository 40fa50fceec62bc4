"""Progress of a campaign: a bar with the remaining time on a terminal, a line every minute in a log."""

from __future__ import annotations

import time
from types import TracebackType

from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from cocotb_tests.harness.project import console

EVERY = 60.0
"""Seconds between two lines in a log."""


class Show:
    """Progress display for `total` jobs; `bad` counts the failed jobs."""

    def __init__(self, title: str, total: int) -> None:
        self._title, self._total = title, total
        self.bad = self._done = self._old = 0
        self._begin = self._told = time.monotonic()
        columns = (
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TextColumn("[red]{task.fields[bad]}"),
            TimeElapsedColumn(),
            TimeRemainingColumn(elapsed_when_finished=True),
        )
        self._bar = Progress(*columns, console=console, disable=not console.is_terminal)
        self._task = self._bar.add_task(title, total=total, bad="")

    def __enter__(self) -> Show:
        self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.stop()

    def step(self, good: bool, old: bool) -> None:
        """Count one completed job."""
        self._done += 1
        self._old += old
        self.bad += not good
        self._bar.update(self._task, advance=1, bad=f"{self.bad} failed" if self.bad else "")
        now = time.monotonic()
        if not console.is_terminal and now - self._told >= EVERY:
            self._told = now
            console.print(self._line(now), markup=False)

    def _line(self, now: float) -> str:
        pace = (now - self._begin) / max(1, self._done - self._old)
        left = round(pace * (self._total - self._done))
        text = f"{self._title}: {self._done} of {self._total}"
        text += f", {self.bad} failed" if self.bad else ""
        return f"{text}, about {left // 3600}:{left // 60 % 60:02}:{left % 60:02} left"
