"""Directed part tests of the PMC006B4: one pytest item for each cocotb test and build configuration."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import SimOptions, cocotb_items, run_item
from cocotb_tests.harness.collect import Item

from .bench import PMC006

ITEMS = cocotb_items(
    "cocotb_tests.pmc006",
    "tb_acceptance_link",
    "tb_acceptance_motion",
    "tb_acceptance_guard",
    "tb_acceptance_modes",
    "tb_acceptance_program",
    "tb_sequence",
    "tb_link",
    "tb_codes",
    "tb_motion",
    "tb_angle",
    "tb_bridge",
    "tb_current",
    "tb_guard",
    "tb_stall",
    "tb_analog",
    "tb_clock",
    "tb_states",
    "tb_keys",
    "tb_program",
    "tb_waits",
    "tb_collisions",
    "tb_resets",
    "tb_streams",
    "tb_delays",
    part=PMC006,
)


@pytest.mark.parametrize("item", ITEMS)
def test_pmc006(item: Item, sim_options: SimOptions) -> None:
    """One simulation of the part passes."""
    run_item(item, sim_options)
