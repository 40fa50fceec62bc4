"""Tests of the bench in a simulation, one simulation each."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.collect import Item, cocotb_items
from cocotb_tests.harness.part import PARTS
from cocotb_tests.harness.runner import SimOptions, run_item

ITEMS = cocotb_items("cocotb_tests.common", "tb_benches", part=PARTS["ppmc104"])


@pytest.mark.parametrize("item", ITEMS)
def test_benches(item: Item, sim_options: SimOptions) -> None:
    """Run one simulation."""
    run_item(item, sim_options)
