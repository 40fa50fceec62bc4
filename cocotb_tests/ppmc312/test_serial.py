"""Directed tests of the PPMC-312 in serial mode: one pytest item a cocotb test and build configuration."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.collect import Item, cocotb_items
from cocotb_tests.harness.runner import SimOptions, run_item

from .bench import PPMC312

MODULES = (
    "tb_serial_tour",
    "tb_serial_checks",
    "tb_serial_transactions",
    "tb_serial_line",
    "tb_serial_frames",
    "tb_serial_codes",
    "tb_serial_motions",
    "tb_serial_polls",
    "tb_serial_resets",
)
ITEMS = cocotb_items("cocotb_tests.ppmc312", *MODULES, part=PPMC312)


@pytest.mark.parametrize("item", ITEMS)
def test_serial(item: Item, sim_options: SimOptions) -> None:
    """Run one simulation."""
    run_item(item, sim_options)
