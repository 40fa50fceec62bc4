"""Tests of the board j105_stmc and of its parameters: one pytest item per cocotb test and build
configuration.
"""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F16, check_ranges, cocotb_items, run_item

from ..harness.isa import NANOSECONDS
from .bench import J105_STMC
from .board import design

ITEMS = cocotb_items("cocotb_tests.stmc", "tb_board", part=J105_STMC, exact=NANOSECONDS)
RANGES = {
    "BASE_ADDR": (("'h3B0", "0", "'h3FE"), ("'h3B1", "'h400")),
    "EXT_HZ": (("1", "48_675", "4_000_000"), ("0", "4_000_001")),
}


@pytest.mark.parametrize("item", ITEMS)
def test_board(item, sim_options):
    """Run one simulation."""
    run_item(item, sim_options, design=design(item.config))


def test_j105_parameter_ranges():
    """The elaboration accepts address and step clock at their bounds and rejects values just outside."""
    check_ranges("J105 1.5", design(F16), RANGES)
