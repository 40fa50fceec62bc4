"""Display of the steps of a demo: the running step with its progress, and completed steps."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path
from typing import Any, TypeVar

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


def step(what: str, work: Callable[[], T], detail: Callable[[], str] = lambda: "") -> T:
    """Run `work` in a thread and display `what` with its detail; return its result or raise its error.

    A terminal shows a spinner at the running step; elsewhere, each new detail is a line.
    """
    outcome: dict[str, Any] = {}

    def inner() -> None:
        try:
            outcome["result"] = work()
        except BaseException as error:  # raised again in the caller; a runner may also raise SystemExit
            outcome["error"] = error

    begin, shown = time.monotonic(), ""
    thread = threading.Thread(target=inner, daemon=True)
    thread.start()
    with console.status("") if console.is_terminal else nullcontext() as status:
        while thread.is_alive():
            thread.join(0.1)
            note = detail()
            if status is not None:
                head = f"{what} … {time.monotonic() - begin:.0f} s  "
                status.update(Text.assemble((head, "bold"), (note, "dim")))
            elif note != shown:
                console.print(f"  {what}: {note}")
                shown = note
    if "error" in outcome:
        raise outcome["error"]
    console.print(f"✓ {what} ({time.monotonic() - begin:.1f} s)", style="green")
    result: T = outcome["result"]
    return result
