"""Runs the tests of the on-chip bus bridges: one pytest item per cocotb test, one build for all tests."""

from __future__ import annotations

from pathlib import Path

import pytest

from cocotb_tests.harness import Part, cocotb_items, run_item
from cocotb_tests.harness.build import Design, part_design
from cocotb_tests.harness.paths import ROOT

ITEMS = cocotb_items(
    "cocotb_tests.host.buses", "tb_axil", "tb_wishbone", "tb_resets", part=Part("buses", {}), shared=True
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
