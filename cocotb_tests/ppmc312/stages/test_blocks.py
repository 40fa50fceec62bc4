"""Unit tests of the stage blocks of the PPMC-312, one simulation per test."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import SimOptions, cocotb_items
from cocotb_tests.harness.blocks import BLOCKS, run_block
from cocotb_tests.harness.collect import Item

EXACT = "only ppmc312_interval has a synchroniser, and its pulses are checked in every cycle"
ITEMS = cocotb_items(
    "cocotb_tests.ppmc312.stages",
    "tb_stage",
    "tb_stage_walk",
    "tb_interval",
    part=BLOCKS,
    shared=True,
    exact=EXACT,
)


@pytest.mark.parametrize("item", ITEMS)
def test_block(item: Item, sim_options: SimOptions) -> None:
    """One simulation of a block passes."""
    run_block(item, sim_options)
