"""`make demo`: build a part's RTL, drive it as a host does, compare it with the golden model, draw it."""

from __future__ import annotations

import argparse
import json
import shutil
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rich import box
from rich.table import Table

from cocotb_tests.harness.build import SimError, build, part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.compare import compare_recording, write_report
from cocotb_tests.harness.project import BUILD, ProjectError, console, fail, relative, run
from cocotb_tests.harness.runner import run_sim
from openppmc import parts
from openppmc.check.comparison import Comparison
from openppmc.check.records import Recording
from scripts.demo import waves
from scripts.demo.demos import Demo
from scripts.demo.steps import last_line, step

FOLDER = BUILD / "demo"
RUN = FOLDER / "run"
MOST = 11  # number of bytes of a block that are printed


def newest_build(part: str) -> str:
    """Return the progress of the Verilator build as text."""
    folders = sorted((BUILD / "sim").glob(f"{part}-*/"), key=lambda path: path.stat().st_mtime)
    count = len(list(folders[-1].glob("*.o"))) if folders else 0
    return f"{count} object files" if count else "reading SystemVerilog"


def repro(demo: Demo) -> str:
    """Return the command that repeats the demo."""
    return "make demo" if demo.name == "ppmc104" else f"make demo PART={demo.name}"


def simulate(demo: Demo) -> tuple[Recording, list[dict[str, Any]]]:
    """Build the RTL and run the demo; return the recording and the chapters."""
    design = part_design(demo.part, demo.config)
    step("build the RTL with Verilator", lambda: build(design), lambda: newest_build(demo.part))
    item = Item(demo.module, demo.test, demo.config, demo.part, ())
    step(
        "drive it like a host",
        lambda: run_sim(design, item, seed=1, folder=RUN, repro=repro(demo)),
        lambda: last_line(RUN / "progress"),
    )
    return Recording.from_json((RUN / "recording.json").read_text()), json.loads(
        (RUN / "chapters.json").read_text()
    )


def hexes(data: list[int]) -> str:
    """Return bytes in hexadecimal, two digits each; a long block is truncated."""
    text = " ".join(f"{byte:02X}" for byte in data[:MOST])
    return text + (" …" if len(data) > MOST else "")


def show_talk(demo: Demo, recording: Recording, chapters: list[dict[str, Any]]) -> None:
    """Print the table of the bytes that the host has sent, and of the responses."""
    clk_hz = int(str(recording.params["CLK_HZ"]))
    table = Table(title="Host and chip", title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("ms", justify="right")
    table.add_column("sent", no_wrap=True)
    table.add_column("meaning", overflow="fold")
    table.add_column("polls", justify="right")
    table.add_column("status read")
    table.add_column("answer", no_wrap=True)
    table.add_column("meaning", overflow="fold")
    for chapter in chapters:
        inside = [a for a in recording.accesses if chapter["begin"] <= a.t < chapter["end"]]
        rows = demo.words.exchanges(inside)
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
    """Print the comparison of RTL and golden model for each output."""
    table = Table(
        title="RTL compared with the golden model, every cycle",
        title_justify="left",
        box=box.SIMPLE_HEAD,
        pad_edge=False,
    )
    table.add_column("output")
    for head in ("edges of the RTL", "edges of the model", "differences"):
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
    """Return two figures as a range, or one figure if they are equal."""
    return f"{first:g}" if first == second else f"{first:g} … {second:g}"


def show_moves(demo: Demo, comparison: Comparison, chapters: list[dict[str, Any]]) -> None:
    """Print the motions of the motors as measured at the pins of the RTL."""
    recording = comparison.recording
    clk_hz = int(str(recording.params["CLK_HZ"]))
    motors = waves.motor_pulses(comparison, demo.view)
    for chapter in chapters:
        for motor, pulses in motors.items():
            falls = [t for t in pulses if chapter["begin"] <= t < chapter["end"]]
            if len(falls) < 2:
                continue
            gaps = [b - a for a, b in zip(falls, falls[1:], strict=False)]
            who = f", {demo.motors[motor]}" if motor in demo.motors else ""
            console.print(
                f"{chapter['title']}{who}: [bold]{demo.words.count(len(falls))}[/] "
                f"in {(falls[-1] - falls[0]) * 1e3 / clk_hz:.3f} ms, "
                f"intervals {spread(max(gaps), min(gaps))} cycles, "
                f"{spread(clk_hz / max(gaps) / 1e3, clk_hz / min(gaps) / 1e3)} {demo.words.speed}"
            )


def write_waves(demo: Demo, comparison: Comparison, chapters: list[dict[str, Any]]) -> list[Path]:
    """Write the VCD file and its saved views; return their paths."""
    vcd, gtkw, sucl = (FOLDER / f"{demo.name}.{suffix}" for suffix in ("vcd", "gtkw", "sucl"))
    waves.write_vcd(comparison, demo.view, vcd)
    period = 1_000_000_000_000 // int(str(comparison.recording.params["CLK_HZ"]))
    marks = [chapter["begin"] * period for chapter in chapters if chapter["key"] in demo.marks]
    waves.gtkwave(vcd, gtkw, demo.part, demo.view, comparison.recording.end * period, marks)
    waves.surfer(sucl, demo.view)
    return [vcd, gtkw, sucl]


def part_of(arguments: list[str] | None) -> str:
    """Return the part that the command line names."""
    parser = argparse.ArgumentParser(
        prog="demo", description="Move a part, compare it with the golden model, draw it."
    )
    parser.add_argument("--part", default="ppmc104")
    return str(parser.parse_args(arguments).part)


def chosen(arguments: list[str] | None) -> Demo | Callable[[], int]:
    """Return the demo of the part that the command line names, or a function that runs a special demo.

    If the part has no demo, the call raises ProjectError, which lists the parts that have one.
    """
    name = part_of(arguments)
    known = [row.name for row in parts.having("demo")]
    if name not in known:
        raise ProjectError(f"PART={name}: there is no demo of it (there is one of {', '.join(known)})")
    found: Demo | Callable[[], int] = parts.part(name).load("demo")
    return found


def main(arguments: list[str] | None = None) -> int:
    """Run the demo; return 0 if every edge of the RTL equals that of the golden model."""
    demo = chosen(arguments)
    return play(demo) if isinstance(demo, Demo) else demo()


def play(demo: Demo) -> int:
    """Run a demo on the pins of a part; return 0 if every edge of the RTL equals that of the golden model."""
    begin = time.monotonic()
    try:
        shutil.rmtree(FOLDER, ignore_errors=True)
        recording, chapters = simulate(demo)
        comparison = step("run the golden model", lambda: compare_recording(recording))
        saved = write_waves(demo, comparison, chapters)
        picture = FOLDER / "profile.png"
        try:
            step("draw the picture", lambda: demo.draw(comparison, chapters, picture))
        except (IndexError, StopIteration):
            # The close-ups need certain edges, which may be missing with faulty RTL.
            if comparison.mismatch is None:
                raise
    except SimError as error:
        return fail(str(error))
    show_talk(demo, recording, chapters)
    show_moves(demo, comparison, chapters)
    show_comparison(comparison)
    console.print(
        "Look at " + ", ".join(relative(path) for path in [picture, *saved]) + " (`make waves` opens them)"
    )
    if comparison.mismatch is not None:
        write_report(comparison, FOLDER, repro(demo))
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
