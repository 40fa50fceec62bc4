"""The cycle counts in docs/benchmarks.md, which do not depend on the computer."""

from __future__ import annotations

from cocotb_tests.harness.project import DOCS
from openppmc.model.clock import Latency
from scripts.measure.bench import costs


def test_costs_in_benchmarks_are_those_of_the_rtl() -> None:
    """The cycle counts in docs/benchmarks.md are those of the RTL (`make bench PART=ppmc104`)."""
    page = (DOCS / "benchmarks.md").read_text(encoding="utf-8")
    block = page.split("<!-- bench:costs -->")[1].split("<!-- /bench:costs -->")[0]
    printed = [[cell.strip() for cell in line.strip("|").split("|")] for line in block.splitlines()]
    found = costs.measure()
    assert [row for row in printed if row[0] in found] == costs.rows(found)
    # Five cycles pass from the strobe to the start of the build, and five from its end to the next command.
    longest = next(cycles for what, cycles in found.items() if "longest" in what)
    assert longest == Latency().build(255, 0, 11_220) + 5
