"""`make demo`: build the RTL, drive it as a host would, compare it with the golden model, show all of it."""

from __future__ import annotations

import json
import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from rich import box
from rich.live import Live
from rich.table import Table
from rich.text import Text

from cocotb_tests.common.collect import Item
from cocotb_tests.common.compare import Comparison, compare_recording, write_report
from cocotb_tests.common.config import F16
from cocotb_tests.common.runner import SimError, build, part_design, run_sim
from cocotb_tests.common.stimulus import Recording
from scripts.demo import waves, words
from scripts.demo.picture import draw_demo
from scripts.project import BUILD, console, fail, relative, run

PART = "ppmc104"
FOLDER = BUILD / "demo"
RUN = FOLDER / "run"

T = TypeVar("T")


class Steps:
    """The list of steps with a spinner at the running one; plain lines where there is no terminal."""

    def __init__(self) -> None:
        self.done: list[str] = []

    def lines(self, running: str, detail: str, seconds: float) -> Text:
        """What the live display shows."""
        text = Text("\n".join(self.done) + ("\n" if self.done else ""), style="green")
        mark = "⠋⠙⠹⠸⠼⠴⠦⠧⠇⠏"[int(seconds * 10) % 10]
        return text.append(f"{mark} {running} … {seconds:.0f} s  ", style="bold").append(detail, style="dim")

    def run(self, what: str, work: Callable[[], T], detail: Callable[[], str] = lambda: "") -> T:
        """Do `work` in a thread, show `what` with its detail; returns its result, raises what it raised."""
        outcome: dict[str, Any] = {}

        def inner() -> None:
            try:
                outcome["result"] = work()
            except BaseException as error:  # handed to the caller, SystemExit of a runner among them
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
        """A live area on a terminal, nothing elsewhere."""
        if not console.is_terminal:
            yield lambda text: None
            return
        with Live(console=console, transient=True, refresh_per_second=10) as live:
            yield live.update


def last_line(path: Path) -> str:
    """Last line of a file that may not be there yet."""
    try:
        lines = path.read_text(errors="replace").strip().splitlines()
    except OSError:
        return ""
    return lines[-1] if lines else ""


def newest_build() -> str:
    """How far the Verilator build is: the object files made so far."""
    folders = sorted((BUILD / "sim").glob(f"{PART}-*/"), key=lambda path: path.stat().st_mtime)
    count = len(list(folders[-1].glob("*.o"))) if folders else 0
    return f"{count} object files" if count else "reading SystemVerilog"


def simulate(steps: Steps) -> tuple[Recording, list[dict[str, Any]]]:
    """Build and run; the recording and the chapters."""
    design = part_design(PART, F16)
    steps.run("build the RTL with Verilator", lambda: build(design), newest_build)
    item = Item("cocotb_tests.demo.tb_demo", "demo_move", F16, PART, ())
    steps.run(
        "drive it over its bus",
        lambda: run_sim(design, item, seed=1, folder=RUN, repro="make demo"),
        lambda: last_line(RUN / "progress"),
    )
    return Recording.from_json((RUN / "recording.json").read_text()), json.loads(
        (RUN / "story.json").read_text()
    )


def hexes(data: list[int]) -> str:
    """Bytes as hex pairs."""
    return " ".join(f"{byte:02X}" for byte in data)


def show_talk(recording: Recording, chapters: list[dict[str, Any]]) -> None:
    """The table of what the host sent and what came back."""
    clk_hz = int(str(recording.params["CLK_HZ"]))
    table = Table(title="Host and chip", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("ms", justify="right")
    table.add_column("sent", no_wrap=True)
    table.add_column("in words", overflow="fold")
    table.add_column("polls", justify="right")
    table.add_column("status seen")
    table.add_column("answer", no_wrap=True)
    table.add_column("in words", overflow="fold")
    for chapter in chapters:
        inside = [a for a in recording.accesses if chapter["begin"] <= a.t < chapter["end"]]
        rows = words.exchanges(inside)
        if rows:
            table.add_row("", "", f"[bold]{chapter['title']}[/]")
        for row in rows:
            table.add_row(
                f"{row.t * 1e3 / clk_hz:.3f}",
                hexes(row.sent),
                row.meaning,
                str(len(row.polls)),
                hexes(row.statuses),
                hexes(row.answer),
                row.reply,
            )
    console.print(table)


def show_comparison(comparison: Comparison) -> None:
    """The table RTL against golden model, output by output."""
    table = Table(
        title="RTL against golden model, to the clk",
        title_justify="left",
        box=box.SIMPLE_HEAD,
        pad_edge=False,
    )
    table.add_column("output")
    for head in ("edges of the RTL", "edges of the model", "without a twin"):
        table.add_column(head, justify="right")
    total = 0
    for name, actual in comparison.actual.items():
        expected = comparison.expected[name]
        differing = len(set(actual) ^ set(expected))
        total += differing
        style = "bold red" if differing else None
        table.add_row(name, str(len(actual)), str(len(expected)), str(differing), style=style)
    table.add_section()
    model_edges = sum(len(changes) for changes in comparison.expected.values())
    table.add_row("all", str(comparison.edges_compared), str(model_edges), str(total), style="bold")
    console.print(table)


def spread(first: float, second: float) -> str:
    """Two figures as a range, one if they are the same."""
    return f"{first:g}" if first == second else f"{first:g} … {second:g}"


def show_moves(comparison: Comparison, chapters: list[dict[str, Any]]) -> None:
    """What the motor was made to do, from the pins."""
    recording = comparison.recording
    clk_hz = int(str(recording.params["CLK_HZ"]))
    for chapter in chapters:
        falls = [
            t
            for t, level in comparison.actual["pout_n"]
            if level == 0 and chapter["begin"] <= t < chapter["end"]
        ]
        if len(falls) < 2:
            continue
        gaps = [b - a for a, b in zip(falls, falls[1:], strict=False)]
        console.print(
            f"{chapter['title']}: [bold]{len(falls)} pulses[/] "
            f"in {(falls[-1] - falls[0]) * 1e3 / clk_hz:.3f} ms, "
            f"intervals {spread(max(gaps), min(gaps))} clk, "
            f"{spread(clk_hz / max(gaps) / 1e3, clk_hz / min(gaps) / 1e3)} kpps"
        )


def write_waves(comparison: Comparison, chapters: list[dict[str, Any]]) -> list[Path]:
    """Write the VCD and its saved views; their paths."""
    vcd, gtkw, sucl = (FOLDER / f"{PART}.{suffix}" for suffix in ("vcd", "gtkw", "sucl"))
    waves.write_vcd(comparison, vcd)
    period = 1_000_000_000_000 // int(str(comparison.recording.params["CLK_HZ"]))
    marks = [chapter["begin"] * period for chapter in chapters if chapter["key"] in ("move", "limit", "rest")]
    waves.gtkwave(vcd, gtkw, PART, comparison.recording.end * period, marks)
    waves.surfer(sucl)
    return [vcd, gtkw, sucl]


def main() -> int:
    """Run the demo; 0 when RTL and golden model agree in every edge."""
    steps = Steps()
    begin = time.monotonic()
    try:
        shutil.rmtree(FOLDER, ignore_errors=True)
        recording, chapters = simulate(steps)
        comparison = steps.run("ask the golden model", lambda: compare_recording(recording))
        saved = write_waves(comparison, chapters)
        picture = FOLDER / "profile.png"
        try:
            steps.run("draw the picture", lambda: draw_demo(comparison, chapters, picture))
        except (IndexError, StopIteration):
            # Wrong RTL may lack the very edges that the close-ups are about.
            if comparison.mismatch is None:
                raise
    except SimError as error:
        return fail(str(error))
    if console.is_terminal:
        console.print("\n".join(steps.done), style="green")
    show_talk(recording, chapters)
    show_moves(comparison, chapters)
    show_comparison(comparison)
    console.print(
        "Look at " + ", ".join(relative(path) for path in [picture, *saved]) + " (`make waves` opens them)"
    )
    if comparison.mismatch is not None:
        write_report(comparison, FOLDER, "make demo")
        m = comparison.mismatch
        return fail(
            f"demo: RTL and golden model differ, first at clk edge {m.t} in {m.signal}: "
            f"see {relative(FOLDER)}/compare.txt"
        )
    console.print(
        f"[bold green]demo: {comparison.edges_compared} edges compared, 0 differences[/] "
        f"({time.monotonic() - begin:.0f} s)"
    )
    return 0


if __name__ == "__main__":
    sys.exit(run(main))
