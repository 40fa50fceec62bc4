"""`make bench`: how fast the demo simulates: RTL with its cocotb host, RTL in Verilator alone, golden model.

The sides take turns on the same recording, several times. The medians go between the markers of
docs/benchmarks.md: seconds, which are those of one machine and its load, and how often as long as Verilator
alone a side takes in the same turn, which repeats.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from statistics import median

from rich.table import Table

from cocotb_tests.harness import project
from cocotb_tests.harness.build import SimError, build, part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.compare import replay
from cocotb_tests.harness.follower import new_model
from cocotb_tests.harness.project import console
from cocotb_tests.harness.runner import run_sim
from cocotb_tests.harness.stimulus import Recording
from scripts.demo.demos import Demo
from scripts.flow import plain_sim
from scripts.flow.machine import machine
from scripts.flow.report import markdown_table

RUNS = 3
FOLDER = project.BUILD / "bench"
LABELS = {
    "rtl": "RTL in Verilator with its cocotb host",
    "plain": "the same RTL in Verilator alone, same pin changes",
    "model": "golden model, same pin changes",
}
HEADS = ["side", "clk", "output edges", "seconds", "clk / s", "time, Verilator alone = 1"]


def seconds(work: Callable[[], object]) -> float:
    """Wall time of one call."""
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def measure(demo: Demo) -> tuple[Recording, dict[str, list[float]]]:
    """Seconds of each run of all sides."""
    design = part_design(demo.part, demo.config)
    console.print("building …")
    build(design)
    program = plain_sim.build(design, project.BUILD / "plain" / demo.part)
    item = Item(demo.module, demo.test, demo.config, demo.part, ())
    times: dict[str, list[float]] = {side: [] for side in LABELS}
    for run in range(1, RUNS + 1):
        times["rtl"].append(seconds(lambda: run_sim(design, item, seed=1, folder=FOLDER, repro="make bench")))
        recording = Recording.from_json((FOLDER / "recording.json").read_text())
        begin = time.perf_counter()
        edges = plain_sim.play(program, recording)
        times["plain"].append(time.perf_counter() - begin)
        plain_sim.check(recording, edges)
        model = new_model(recording.part, recording.params)
        times["model"].append(seconds(lambda recording=recording, model=model: replay(recording, model)))
        shown = ", ".join(f"{side} {taken[-1]:.2f} s" for side, taken in times.items())
        console.print(f"run {run} of {RUNS}: {shown}")
    return recording, times


def main() -> int:
    """Measure and write docs/benchmarks.md."""
    parser = argparse.ArgumentParser(prog="bench.py", description=__doc__)
    parser.add_argument("--part", default="ppmc104")
    name = parser.parse_args().part
    row = project.part(name)
    if row.bench:
        own: Callable[[], int] = row.load("bench")
        return own()
    try:
        recording, times = measure(row.load("demo"))
    except SimError as error:
        return project.fail(str(error))
    clocks = recording.end
    rows = []
    for side, label in LABELS.items():
        middle = median(times[side])
        ratio = median(taken / plain for taken, plain in zip(times[side], times["plain"], strict=True))
        figures = [f"{clocks:,}", f"{len(recording.edges):,}", f"{middle:.2f}", f"{clocks / middle:,.0f}"]
        rows.append([label, *figures, f"{ratio:.2f}"])
    table = Table(title=f"demo run of {name}, median of {RUNS} runs", title_justify="left")
    for index, head in enumerate(HEADS):
        table.add_column(head, justify="right" if index else "left")
    for row in rows:
        table.add_row(*row)
    console.print(table)
    mhz = int(str(recording.params["CLK_HZ"])) / 1e6
    text = f"The run of `make demo` at {mhz:g} MHz, median of {RUNS} runs, start of the simulator included.\n"
    text += "All sides make the same output edges. Seconds depend on the machine and on what else it does; "
    text += f"the last column is the median of the ratios in one turn. {machine()}."
    project.update_benchmarks(f"bench:{name}", text + "\n\n" + markdown_table(HEADS, rows))
    console.print("written: docs/benchmarks.md")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
