"""`make bench`: measure the speed of a demo on RTL and golden model.

For the PPMC-104 it also measures the virtual board and the commands. The figures are written between their
markers in docs/benchmarks.md. Times in seconds depend on the machine and its load. Ratios of two times in one
run are repeatable.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable

from cocotb_tests.harness import project
from cocotb_tests.harness.build import SimError
from cocotb_tests.harness.project import console
from openppmc.host import PpmcError
from openppmc.sim import SimError as BoardError
from scripts.demo.demos import Demo
from scripts.fpga.flow.machine import machine
from scripts.measure.bench import board, captures, costs, moves, section
from scripts.measure.bench.run_times import LABELS, PLAIN, Times, turns

RUNS = 3
HEADS = ["simulation", "cycles", "output edges", "seconds", "cycles / s", "time, Verilator alone = 1"]


def played(name: str, demo: Demo) -> tuple[Times, list[list[str]]]:
    """Run a demo alternately on RTL and golden model; return the times and the rows of the table."""
    times = None
    console.print("building …")
    for run, times in enumerate(turns(demo, RUNS), 1):
        shown = ", ".join(f"{side} {taken[-1]:.2f} s" for side, taken in times.seconds.items())
        console.print(f"{name}, turn {run} of {RUNS}: {shown}")
    assert times is not None
    clocks = times.recording.end
    rows = []
    for side, label in LABELS.items():
        middle = times.middle(side)
        figures = [
            f"{clocks:,}",
            f"{len(times.recording.edges):,}",
            f"{middle:.2f}",
            f"{clocks / middle:,.0f}",
        ]
        rows.append([label, *figures, f"{times.ratio(side):.2f}"])
    return times, rows


def bench(name: str, demo: Demo) -> None:
    """Measure and write all figures of a part."""
    times, rows = played(name, demo)
    mhz = int(str(times.recording.params["CLK_HZ"])) / 1e6
    text = (
        f"The run of `make demo` at {mhz:g} MHz, median of {RUNS} rounds, start of the simulator included.\n"
        "All simulations produce the same output edges. The seconds depend on the machine and its load. "
        f"Each round has a ratio; the last column is their median. {machine()}."
    )
    if name == costs.PART:
        figures = board.measure()
        alone = times.recording.end / times.middle(PLAIN)
        rows.append(
            [
                "virtual board: RTL, UART bridge, motor",
                "",
                "",
                "",
                f"{figures.clk:,.0f}",
                f"{alone / figures.clk:.2f}",
            ]
        )
        text += (
            " The virtual board runs at full speed with a turning motor; its cycles / s are of "
            "processor time."
        )
        section.write(
            "board",
            f"The virtual board at {board.CLK_HZ / 1e6:g} MHz and {board.BAUD:,} baud, through pyserial. "
            f"{machine()}.",
            board.HEADS,
            figures.rows(),
            "virtual board",
        )
        section.write(
            "costs",
            "Waits of a host, counted at the pins of the PPMC-104 (FAST) with the shortest bus accesses: "
            "from the end of the last data byte until the next command is executed, and from the start of "
            "a command until its last answer is read.",
            costs.HEADS,
            costs.rows(costs.measure()),
            "cycles of commands",
        )
        moves.bench()
        captures.bench()
    title = f"run of `make demo PART={name}`, median of {RUNS} rounds"
    section.write(name, text, HEADS, rows, title)


def main() -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(prog="python -m scripts.measure.bench", description=__doc__)
    parser.add_argument("--part", default="ppmc104")
    row = project.part(parser.parse_args().part)
    try:
        if row.bench:
            own: Callable[[], int] = row.load("bench")
            return own()
        bench(row.name, row.load("demo"))
    except (SimError, BoardError, PpmcError) as error:
        return project.fail(str(error))
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
