"""Scripts of the golden model's own tests and of this folder, played on the RTL: one simulation a module."""

from __future__ import annotations

import pytest

from cocotb_tests.harness.collect import Item, cocotb_items
from cocotb_tests.harness.runner import SimOptions, run_item

from .bench import PMC006

ITEMS = cocotb_items("cocotb_tests.pmc006", "tb_scripts", part=PMC006)


@pytest.mark.parametrize("item", ITEMS)
def test_scripts(item: Item, sim_options: SimOptions) -> None:
    """All outputs of the RTL change as those of the golden model, whose answers the scripts check."""
    run_item(item, sim_options)
