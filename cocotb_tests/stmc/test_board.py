"""Tests of the board j105_stmc: one pytest item a cocotb test and build configuration; its parameters."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F16, check_ranges, cocotb_items, run_item

from .bench import J105_STMC
from .board import design

ITEMS = cocotb_items("cocotb_tests.stmc", "tb_board", part=J105_STMC)
RANGES = {
    "BASE_ADDR": (("'h3B0", "0", "'h3FE"), ("'h3B1", "'h400")),
    "EXT_HZ": (("1", "48_675", "4_000_000"), ("0", "4_000_001")),
}


@pytest.mark.parametrize("item", ITEMS)
def test_board(item, sim_options):
    """Run one simulation."""
    run_item(item, sim_options, design=design(item.config))


def test_j105_parameter_ranges():
    """Given address and step clock at and just outside their ranges, when elaborated, then as they say."""
    check_ranges("J105 1.5", design(F16), RANGES)
