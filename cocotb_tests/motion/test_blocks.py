"""Unit tests of the blocks of rtl/motion, one simulation per test."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import SimOptions, cocotb_items
from cocotb_tests.harness.blocks import BLOCKS, NO_STAGES, run_block
from cocotb_tests.harness.collect import Item

EXACT = "only ppmc_ext_clock has a synchroniser, and its outputs are checked in every cycle"
ITEMS = cocotb_items("cocotb_tests.motion", "tb_motion", part=BLOCKS, shared=True, exact=EXACT)
ITEMS += cocotb_items("cocotb_tests.motion", "tb_ramp", part=BLOCKS, shared=True, exact=NO_STAGES)


@pytest.mark.parametrize("item", ITEMS)
def test_block(item: Item, sim_options: SimOptions) -> None:
    """Run one simulation."""
    run_block(item, sim_options)
