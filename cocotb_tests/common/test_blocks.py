"""Unit tests of the blocks of rtl/common, one simulation per test."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import SimOptions, cocotb_items
from cocotb_tests.harness.blocks import BLOCKS, NO_STAGES, run_block
from cocotb_tests.harness.collect import Item

ITEMS = cocotb_items("cocotb_tests.common", "tb_common", part=BLOCKS, shared=True, tolerant=True)
ITEMS += cocotb_items("cocotb_tests.common", "tb_i2c", part=BLOCKS, shared=True, exact=NO_STAGES)


@pytest.mark.parametrize("item", ITEMS)
def test_block(item: Item, sim_options: SimOptions) -> None:
    """Run one simulation."""
    run_block(item, sim_options)
