"""Scripts of the golden model's own tests and of this folder, played on the RTL: one simulation a module."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.collect import Item, cocotb_items
from cocotb_tests.harness.runner import SimOptions, run_item

from .bench import PPMC312

ITEMS = cocotb_items("cocotb_tests.ppmc312", "tb_scripts", part=PPMC312)


@pytest.mark.parametrize("item", ITEMS)
def test_scripts(item: Item, sim_options: SimOptions) -> None:
    """All outputs of the RTL change as those of the golden model, whose answers the scripts check."""
    run_item(item, sim_options)
