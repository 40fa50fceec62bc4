"""Unit tests of the shared RTL blocks: one pytest item a cocotb test, one build an area."""

from __future__ import annotations

import importlib

import pytest

from cocotb_tests.common.collect import cocotb_items
from cocotb_tests.common.part import Part
from cocotb_tests.common.runner import run_item

from .wrapper import GROUPS, area_design

ITEMS = cocotb_items(
    "cocotb_tests.blocks",
    "tb_common",
    "tb_motion",
    "tb_ramp",
    "tb_host",
    "tb_single",
    "tb_stage",
    "tb_stage_walk",
    "tb_interval",
    "tb_i2c",
    part=Part("blocks", "BLK", {}),
)


@pytest.mark.parametrize("item", ITEMS)
def test_block(item, sim_options):
    """Run one simulation."""
    module = importlib.import_module(item.module)
    area = getattr(module, "AREA", item.module.rsplit("_", 1)[-1])
    groups = getattr(module, "GROUPS", GROUPS)
    run_item(item, sim_options, design=area_design(area, module.BLOCKS, groups))
