"""`make bench PART=bank`: speed of the run of the demo in Verilator alone and on the golden model."""

from __future__ import annotations

import time
from statistics import median

from cocotb_tests.harness import project
from cocotb_tests.harness.build import SimError
from cocotb_tests.harness.project import console
from openppmc.model.bank import PpmcBank
from scripts.demo.bank.demo import NAME, build, play, simulate
from scripts.demo.bank.moves import AXES, CLK_HZ
from scripts.fpga.flow.machine import machine
from scripts.measure.bench import section

RUNS = 3
SIDES = ("RTL in Verilator alone", "golden model, same pin changes")
HEADS = ["simulation", "cycles", "output edges", "seconds", "cycles / s"]


def measure() -> tuple[int, int, list[list[float]]]:
    """Return cycles, output edges, and the seconds of each run on Verilator and on the golden model.

    The call raises ProjectError if the edges differ.
    """
    program = build()
    played = play()
    times: list[list[float]] = [[], []]
    for run in range(1, RUNS + 1):
        begin = time.perf_counter()
        comparison = simulate(program, played)
        times[0].append(time.perf_counter() - begin)
        if comparison.mismatch is not None:
            raise project.ProjectError(f"RTL and golden model differ: {comparison.mismatch}")
        begin = time.perf_counter()
        model = PpmcBank(AXES, CLK_HZ)
        for t, pin, level in comparison.recording.stimulus:
            model.pins(t, **{pin: level})
        model.run_until(comparison.recording.end)
        times[1].append(time.perf_counter() - begin)
        console.print(f"run {run} of {RUNS}: {times[0][-1]:.2f} s, {times[1][-1]:.2f} s")
    return comparison.recording.end, comparison.edges_compared, times


def main() -> int:
    """Measure and write docs/benchmarks.md."""
    try:
        clk, edges, times = measure()
    except SimError as error:
        return project.fail(str(error))
    rows = []
    for side, taken in zip(SIDES, times, strict=True):
        middle = median(taken)
        rows.append([side, f"{clk:,}", f"{edges:,}", f"{middle:.2f}", f"{clk / middle:,.0f}"])
    text = (
        f"{AXES} axes of a bank: the run of `make demo PART={NAME}` at {CLK_HZ / 1e6:g} MHz, median of "
        f"{RUNS} runs, files of pin changes and edges included. Both simulations produce the "
        f"same output edges. {machine()}."
    )
    section.write(NAME, text, HEADS, rows)
    return 0
