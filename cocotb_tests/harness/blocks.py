"""Unit tests of RTL blocks under pytest: one item a cocotb test, one build an area."""

from __future__ import annotations

import importlib

from .collect import Item
from .part import Part
from .runner import SimOptions, run_item
from .wrapper import GROUPS, area_design

BLOCKS = Part("blocks", {})


def run_block(item: Item, options: SimOptions) -> None:
    """Run one simulation of the area that the item's module tests."""
    module = importlib.import_module(item.module)
    area = getattr(module, "AREA", item.module.rsplit("_", 1)[-1])
    groups = getattr(module, "GROUPS", GROUPS)
    run_item(item, options, design=area_design(area, module.BLOCKS, groups))
