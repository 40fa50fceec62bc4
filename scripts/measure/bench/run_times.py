"""The run times of a demo in three programs ("sides"): RTL with cocotb, RTL in Verilator alone, golden model.

In each turn, every side runs once. Thus, other load on the machine has little effect on the ratios of a turn.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from statistics import median

from cocotb_tests.harness import project
from cocotb_tests.harness.build import MAINS, build, part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.compare import replay
from cocotb_tests.harness.dut_bench import new_model
from cocotb_tests.harness.runner import run_sim
from openppmc.check.records import Recording
from scripts.demo.demos import Demo
from scripts.fpga.flow import plain_sim

FOLDER = project.BUILD / "bench"
PLAIN = "plain"
LABELS = {
    "own": "RTL in Verilator with its cocotb host, our main program",
    "cocotb": "the same on cocotb's own main program",
    PLAIN: "RTL in Verilator alone, same pin changes",
    "model": "golden model, same pin changes",
}


@dataclass(frozen=True)
class Times:
    """Recording of the demo's run, and the seconds of each side, with one value per turn."""

    recording: Recording
    seconds: dict[str, list[float]]

    def middle(self, side: str) -> float:
        """Return the median of the times that a side took, in s."""
        return median(self.seconds[side])

    def ratio(self, side: str) -> float:
        """Return the median ratio of a side's time to the time of Verilator alone in the same turn."""
        pairs = zip(self.seconds[side], self.seconds[PLAIN], strict=True)
        return median(taken / plain for taken, plain in pairs)


def turns(demo: Demo, count: int) -> Iterator[Times]:
    """Run `count` turns; yield all times so far after each turn. Raises SimError or ProjectError."""
    designs = {main: replace(part_design(demo.part, demo.config), main=main) for main in MAINS}
    for design in designs.values():
        build(design)
    program = plain_sim.build(next(iter(designs.values())), project.BUILD / "plain" / demo.part)
    item = Item(demo.module, demo.test, demo.config, demo.part, ())
    times: dict[str, list[float]] = {side: [] for side in LABELS}
    for _ in range(count):
        for main, design in designs.items():
            begin = time.perf_counter()
            run_sim(design, item, seed=1, folder=FOLDER / main, repro="make bench")
            times[main].append(time.perf_counter() - begin)
        recording = Recording.from_json((FOLDER / "own" / "recording.json").read_text())
        begin = time.perf_counter()
        edges = plain_sim.play(program, recording)
        times[PLAIN].append(time.perf_counter() - begin)
        plain_sim.check(recording, edges)
        model = new_model(recording.part, recording.params)
        begin = time.perf_counter()
        replay(recording, model)
        times["model"].append(time.perf_counter() - begin)
        yield Times(recording, times)
