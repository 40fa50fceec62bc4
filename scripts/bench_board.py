"""How fast the virtual board is: register accesses a second over its UART, and board time against wall time.

Part of `make bench`; the table goes between its markers of docs/benchmarks.md.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from rich.table import Table

from cocotb_tests.harness import project
from cocotb_tests.harness.project import console
from openppmc import sim
from openppmc.host import Ppmc104, PpmcError
from openppmc.host.bridge.script import Script
from scripts.flow.machine import machine
from scripts.flow.report import markdown_table

BLOCK = 255
CLK_HZ = 8_000_000
BAUD = 1_000_000


@dataclass(frozen=True)
class Figures:
    """Of one virtual board. accesses: register reads/s in blocks of 255, at `baud`; commands: round trips/s
    of a command with its answer; factor: board time / wall time in a move; mclk: clk in millions a second
    of processor time, at full speed."""

    baud: int
    accesses: float
    commands: float
    factor: float
    mclk: float


def rate(work: object, count: int, seconds: float) -> float:
    """How often `work` (worth `count` each time) can be done in a second."""
    begin, done = time.perf_counter(), 0
    while (passed := time.perf_counter() - begin) < seconds:
        work()  # type: ignore[operator]
        done += count
    return done / passed


def full_speed() -> float:
    """Millions of clk in a second of processor time, motor turning."""
    with sim.start("speed=max,cw=2000000000,slow_cw=2000000000") as board, Ppmc104.open(board.port) as axis:
        axis.initialise()
        axis.jog(0, high=True)
        stat = Path(f"/proc/{board.process.pid}/stat")

        def now() -> tuple[int, float]:
            words = stat.read_text().rsplit(")", 1)[1].split()
            return board.status().clk, (int(words[11]) + int(words[12])) / 100

        before = now()
        time.sleep(3)
        after = now()
        axis.stop()
    return (after[0] - before[0]) / max(0.01, after[1] - before[1]) / 1e6


def measure(baud: int, seconds: float = 3.0) -> Figures:
    """Start a board and measure. Raises SimError, PpmcError."""
    with sim.start("cw=2000000000,slow_cw=2000000000") as board, Ppmc104.open(board.port, baud) as axis:
        axis.initialise()
        block = Script().read_many(1, BLOCK)
        accesses = rate(lambda: axis.link.execute(block), BLOCK, seconds)
        outputs = Script().call(0x82).get(1)
        commands = rate(lambda: axis.link.execute(outputs), 1, seconds)
        axis.jog(0, high=True)
        first, begin = board.status().clk, time.perf_counter()
        time.sleep(seconds)
        factor = (board.status().clk - first) / CLK_HZ / (time.perf_counter() - begin)
        axis.stop()
    return Figures(axis.link.baud, accesses, commands, factor, full_speed())


def main() -> int:
    """Measure, print, write docs/benchmarks.md."""
    parser = argparse.ArgumentParser(prog="bench_board.py", description=__doc__)
    parser.add_argument(
        "--baud", type=int, default=BAUD, help="default %(default)s; docs are written for it only"
    )
    baud = parser.parse_args().baud
    try:
        figures = measure(baud)
    except (sim.SimError, PpmcError) as error:
        return project.fail(str(error))
    rows = [
        [f"register accesses/s, blocks of {BLOCK}", f"{figures.accesses:,.0f}"],
        ["commands with their answer/s", f"{figures.commands:,.0f}"],
        ["board time / wall time, motor turning", f"{figures.factor:.2f}"],
        ["million clk / s of processor time", f"{figures.mclk:.2f}"],
    ]
    table = Table(title=f"virtual board, {figures.baud} baud", title_justify="left", show_header=False)
    table.add_column()
    table.add_column(justify="right")
    for row in rows:
        table.add_row(*row)
    console.print(table)
    if figures.baud == BAUD:
        text = f"The virtual board at {CLK_HZ / 1e6:g} MHz and {BAUD:,} baud, through pyserial. {machine()}."
        project.update_benchmarks("bench:board", text + "\n\n" + markdown_table(["figure", ""], rows))
        console.print("written: docs/benchmarks.md")
    return 0


if __name__ == "__main__":
    sys.exit(project.run(main))
