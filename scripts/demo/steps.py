"""Display of the steps of a demo on the terminal: the running step, its progress, completed steps."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from rich.live import Live
from rich.text import Text

from cocotb_tests.harness.project import console

T = TypeVar("T")


def last_line(path: Path) -> str:
    """Return the last line of a file; empty if the file does not exist yet."""
    try:
        lines = path.read_text(errors="replace").strip().splitlines()
    except OSError:
        return ""
    return lines[-1] if lines else ""


class Steps:
    """The list of steps, with a spinner at the running one; without a terminal, plain lines."""

    def __init__(self) -> None:
        self.done: list[str] = []

    def lines(self, running: str, detail: str, seconds: float) -> Text:
        """Return the text of the live display."""
        text = Text("\n".join(self.done) + ("\n" if self.done else ""), style="green")
        mark = "⠋⠙⠹⠸⠼⠴⠦⠧⠇⠏"[int(seconds * 10) % 10]
        return text.append(f"{mark} {running} … {seconds:.0f} s  ", style="bold").append(detail, style="dim")

    def run(self, what: str, work: Callable[[], T], detail: Callable[[], str] = lambda: "") -> T:
        """Run `work` in a thread and display `what` with its detail; return its result or raise its error."""
        outcome: dict[str, Any] = {}

        def inner() -> None:
            try:
                outcome["result"] = work()
            except BaseException as error:  # raised again in the caller; a runner may also raise SystemExit
                outcome["error"] = error

        begin, shown = time.monotonic(), ""
        thread = threading.Thread(target=inner, daemon=True)
        thread.start()
        with self.display() as update:
            while thread.is_alive():
                thread.join(0.1)
                note = detail()
                update(self.lines(what, note, time.monotonic() - begin))
                if not console.is_terminal and note != shown:
                    console.print(f"  {what}: {note}")
                    shown = note
        if "error" in outcome:
            raise outcome["error"]
        line = f"✓ {what} ({time.monotonic() - begin:.1f} s)"
        self.done.append(line)
        if not console.is_terminal:
            console.print(line)
        return outcome["result"]

    @contextmanager
    def display(self) -> Iterator[Callable[[Text], None]]:
        """Provide an area that is updated in place on a terminal; without a terminal, updates are ignored."""
        if not console.is_terminal:
            yield lambda text: None
            return
        with Live(console=console, transient=True, refresh_per_second=10) as live:
            yield live.update
