"""Unit tests of blocks of rtl/pmc006, one simulation per test."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import SimOptions, cocotb_items
from cocotb_tests.harness.blocks import BLOCKS, NO_STAGES, run_block
from cocotb_tests.harness.collect import Item

ITEMS = cocotb_items("cocotb_tests.pmc006", "tb_restart", part=BLOCKS, shared=True, exact=NO_STAGES)


@pytest.mark.parametrize("item", ITEMS)
def test_block(item: Item, sim_options: SimOptions) -> None:
    """Run one simulation."""
    run_block(item, sim_options)
