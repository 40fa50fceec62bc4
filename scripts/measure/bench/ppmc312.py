"""`make bench PART=ppmc312-serial`: speed of sixteen stations on a line, relative to the time of the line.

The program of the demo runs in three ways: RTL in Verilator with a cocotb master, a line of golden models
that exchange bits, and golden models that receive the pin changes of the RTL. The medians of several runs are
written to docs/benchmarks.md.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from statistics import median

from cocotb_tests.harness import project
from cocotb_tests.harness.build import SimError, build
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.project import console
from cocotb_tests.harness.runner import run_sim
from cocotb_tests.ppmc312.line.compare import compare_line
from cocotb_tests.ppmc312.line.demo import program
from cocotb_tests.ppmc312.line.library import FAST_ARGS
from cocotb_tests.ppmc312.line.master import Master, at_once
from cocotb_tests.ppmc312.line.models import ModelLine
from cocotb_tests.ppmc312.line.setting import F8L, LINE, STATIONS, design
from openppmc.check.records import Recording
from scripts.fpga.flow.machine import machine
from scripts.measure.bench import lines, section

NAME = "ppmc312-serial"
RUNS = 3
GOAL = 50
FOLDER = project.BUILD / "bench"


def seconds(work: Callable[[], object]) -> tuple[float, float]:
    """Return the wall time of one call, and the processor time of this process and its children."""
    begin, used = time.perf_counter(), os.times()
    work()
    now = os.times()
    spent = sum(b - a for a, b in zip(used[:4], now[:4], strict=True))
    return time.perf_counter() - begin, spent


def on_models() -> int:
    """Run the program on a line of golden models; return its cycles."""
    line = ModelLine()
    at_once(line.until(8))
    at_once(program(Master(line)))
    return line.now


def measure() -> list[tuple[str, int, float, float]]:
    """Return rows: way to run, cycles of the line, median wall time in s, median processor time in s."""
    console.print("building …")
    made = design(F8L, FAST_ARGS)
    build(made)
    item = Item("cocotb_tests.ppmc312.line.demo", "demo_line", F8L, LINE.name, ())
    repro = f"make bench PART={NAME}"
    times: dict[str, list[tuple[float, float]]] = {"rtl": [], "models": [], "replay": []}
    clk = 0
    for run in range(1, RUNS + 1):
        times["rtl"].append(seconds(lambda: run_sim(made, item, seed=1, folder=FOLDER, repro=repro)))
        recording = Recording.from_json((FOLDER / "recording.json").read_text())
        times["models"].append(seconds(on_models))
        times["replay"].append(seconds(lambda recording=recording: compare_line(recording)))
        clk = recording.end
        shown = ", ".join(f"{name} {rows[-1][0]:.1f} s" for name, rows in times.items())
        console.print(f"run {run} of {RUNS}: {shown}")
    labels = {
        "rtl": "RTL in Verilator with its cocotb master",
        "models": "golden models on a line, bit by bit",
        "replay": "golden models, pin changes of the RTL replayed and all outputs compared",
    }
    return [
        (text, clk, *(median(row[place] for row in times[key]) for place in (0, 1)))  # type: ignore[misc]
        for key, text in labels.items()
    ]


def rows_of(measured: list[tuple[str, int, float, float]], clk_hz: int) -> list[list[str]]:
    """Return the rows of the table; the ratio of line time to processor time is printed as 1/n."""
    rows = []
    for text, clk, wall, used in measured:
        ratio = used * clk_hz / clk
        goal = "reached" if ratio <= GOAL else "missed"
        rows.append(
            [text, f"{clk:,}", f"{wall:.1f}", f"{used:.1f}", f"{clk / used:,.0f}", f"1/{ratio:.0f}", goal]
        )
    return rows


def main() -> int:
    """Measure, print and write docs/benchmarks.md."""
    try:
        measured = measure()
    except SimError as error:
        return project.fail(str(error))
    rows = rows_of(measured, F8L.clk_hz)
    heads = ["simulation", "cycles", "seconds", "processor s", "cycles / s", "of real time", f"goal 1/{GOAL}"]
    text = (
        f"{STATIONS} stations of the PPMC-312 on one line: the run of `make demo PART={NAME}` at "
        f"{F8L.clk_hz / 1e6:g} MHz and 83 333 bps, {measured[0][1] / F8L.clk_hz * 1e3:.0f} ms of the line, "
        f"median of {RUNS} runs, start of the simulator included. The cycles/s and the share of real time "
        f"refer to processor time. {machine()}."
    )
    title = f"{STATIONS} stations on a line, median of {RUNS} runs"
    section.write(NAME, text, heads, rows, title)
    return lines.main()
