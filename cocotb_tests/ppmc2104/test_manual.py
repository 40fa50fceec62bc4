"""The sessions of the manual on the PPMC-2104: one pytest item per chapter."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import cocotb_items, run_item

from .bench import PPMC2104

ITEMS = cocotb_items("cocotb_tests.ppmc2104", "tb_manual", part=PPMC2104)


@pytest.mark.parametrize("item", ITEMS)
def test_manual(item, sim_options):
    """Run one simulation."""
    run_item(item, sim_options)
