"""Unit tests of the blocks of rtl/host, one simulation per test."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import SimOptions, cocotb_items
from cocotb_tests.harness.blocks import BLOCKS, run_block
from cocotb_tests.harness.collect import Item

ITEMS = cocotb_items(
    "cocotb_tests.host", "tb_char", "tb_host", "tb_spi", part=BLOCKS, shared=True, tolerant=True
)


@pytest.mark.parametrize("item", ITEMS)
def test_block(item: Item, sim_options: SimOptions) -> None:
    """Run one simulation."""
    run_block(item, sim_options)
