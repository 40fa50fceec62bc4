"""Runs the tests of the on-chip bus bridges: one pytest item per cocotb test, one build for all tests."""

from __future__ import annotations

from pathlib import Path

import pytest

from cocotb_tests.harness import Part, cocotb_items, run_item
from cocotb_tests.harness.build import Design, part_design
from cocotb_tests.harness.jitter import JITTER, stage_counts
from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.simulate import Job, simulate

EXACT = "all inputs of the synchronisers come from registers of the same clock"
ITEMS = cocotb_items(
    "cocotb_tests.host.buses",
    "tb_axil",
    "tb_wishbone",
    "tb_resets",
    part=Part("buses", {}),
    shared=True,
    exact=EXACT,
)

# The verilated.mk of the wheel cannot build a design that is split into several C++ files.
ONE_FILE = ("--output-split", "0")


def buses_design(item) -> Design:
    """Return the design: the sources of a PPMC-104, the templates of both bridges, and the test top."""
    part = part_design("ppmc104", item.config)
    templates = [
        ROOT / "packages" / "templates" / f"ppmc104_example_{bus}.sv" for bus in ("axil", "wishbone")
    ]
    top = Path(__file__).with_name("buses_top.sv")
    sources = [*part.sources, *templates, top]
    return Design("buses_top", sources, part.includes, dict(item.config.extra), ONE_FILE)


@pytest.mark.parametrize("item", ITEMS)
def test_bus(item, sim_options):
    """Run one simulation."""
    run_item(item, sim_options, design=buses_design(item))


def test_registered_inputs_are_never_late(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With JITTER=1, a device behaves as usual if all its inputs come from registers of its clock."""
    monkeypatch.setenv(JITTER, "1")
    items = tuple(item for (item,) in (param.values for param in ITEMS) if item.test.endswith("part_moves"))
    found = simulate(Job(buses_design(items[0]), items, seed=1), tmp_path / "run")
    assert len(found) == 2 and all(outcome.good for outcome in found.values()), found
    text = (tmp_path / "run" / "log.txt").read_text(encoding="utf-8")
    assert "ppmc_sync: 0 late, 0 prompt" in text and stage_counts(text) == (0, 0)
