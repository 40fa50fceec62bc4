"""Directed part tests of the PPMC-104: one pytest item a cocotb test and build configuration."""

from __future__ import annotations

import pytest

from cocotb_tests.common.collect import cocotb_items
from cocotb_tests.common.runner import run_item

ITEMS = cocotb_items(
    "cocotb_tests.ppmc104",
    "tb_acceptance_1",
    "tb_acceptance_2",
    "tb_acceptance_3",
    "tb_bus",
    "tb_status",
    "tb_commands",
    "tb_init",
    "tb_stops",
    "tb_reads",
    "tb_baseclock",
    "tb_ramp",
    "tb_forced_decel",
    "tb_timing_end",
    "tb_excitation",
    "tb_limits",
    "tb_bad_input",
    "tb_datasheet",
    "tb_datasheet_2",
)


@pytest.mark.parametrize("item", ITEMS)
def test_ppmc104(item, sim_options):
    """Run one simulation."""
    run_item(item, sim_options)
