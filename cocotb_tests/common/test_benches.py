"""Tests of the test benches in a simulation, one simulation per test."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import PARTS, SimOptions, cocotb_items, run_item
from cocotb_tests.harness.collect import Item

ITEMS = cocotb_items("cocotb_tests.common", "tb_benches", part=PARTS["ppmc104"], exact="they test the bench")


@pytest.mark.parametrize("item", ITEMS)
def test_benches(item: Item, sim_options: SimOptions) -> None:
    """Run one simulation."""
    run_item(item, sim_options)
