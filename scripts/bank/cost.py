"""Cost of a bank by its number of axes, from docs/bank/sizes.json, which scripts/bank/sizes.py writes."""

from __future__ import annotations

from cocotb_tests.harness.project import DOCS
from scripts.flow.yosys_job import BEST

FILE = DOCS / "bank" / "sizes.json"
AXES = (4, 8, 16, 32, 64)
CLK_HZ = 100_000_000
RECIPES = {"plain": {"ecp5": "default", "ice40": "default"}, "tuned": BEST}


def markdown() -> str:
    return ""
