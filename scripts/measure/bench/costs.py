"""Cycles of a table build, and of a command with its response, at the pins of the RTL, without the host."""

from __future__ import annotations

import json

from cocotb_tests.harness.build import build, part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.config import F16
from cocotb_tests.harness.runner import run_sim
from scripts.measure.bench.run_times import FOLDER

PART, MODULE, TEST = "ppmc104", "cocotb_tests.ppmc104.costs", "count_costs"
CLOCKS = (16, 100)  # MHz
HEADS = ["wait", "cycles", *(f"µs at {mhz} MHz" for mhz in CLOCKS)]


def measure() -> dict[str, int]:
    """Return operation -> cycles; raise SimError if the simulation fails."""
    design = part_design(PART, F16)
    build(design)
    run_sim(design, Item(MODULE, TEST, F16, PART, ()), 1, folder=FOLDER / "costs", repro="make bench")
    found: dict[str, int] = json.loads((FOLDER / "costs" / "costs.json").read_text())
    return found


def rows(found: dict[str, int]) -> list[list[str]]:
    """Return a table row for each operation; HEADS has the headings."""
    return [[what, f"{clk:,}", *(f"{clk / mhz:,.1f}" for mhz in CLOCKS)] for what, clk in found.items()]
