"""Directed part tests of the PPMC-312: one pytest item for each cocotb test and build configuration."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F16, SimOptions, check_ranges, cocotb_items, run_item, verifies
from cocotb_tests.harness.build import part_design
from cocotb_tests.harness.collect import Item

from .bench import PPMC312

MODULES = (
    "tb_checks_host",
    "tb_checks_events",
    "tb_checks_motion",
    "tb_checks_searches",
    "tb_checks_monitors",
    "tb_transactions",
    "tb_accept",
    "tb_corners",
    "tb_delays",
    "tb_collisions",
    "tb_clock",
    "tb_datasheet",
    "tb_time_limits",
    "tb_goals",
    "tb_bus",
    "tb_resets",
    "tb_settings",
    "tb_least_tables",
    "tb_curves",
    "tb_motion_starts",
    "tb_motion_walks",
    "tb_motion_stops",
    "tb_motion_searches",
    "tb_refusals",
    "tb_abnormal",
    "tb_terminals",
    "tb_positions",
    "tb_serial_sequence",
    "tb_serial_checks",
    "tb_serial_transactions",
    "tb_serial_line",
    "tb_serial_frames",
    "tb_serial_codes",
    "tb_serial_motions",
    "tb_serial_polls",
    "tb_serial_resets",
)
RANGES = {"SND_LEAD": (("1", "16"), ("0", "17")), "SND_WAIT": (("0", "8"), ("9", "-1"))}
ITEMS = cocotb_items("cocotb_tests.ppmc312", *MODULES, part=PPMC312)


@pytest.mark.parametrize("item", ITEMS)
def test_ppmc312(item: Item, sim_options: SimOptions) -> None:
    """One simulation of the part passes."""
    run_item(item, sim_options)


@verifies("P312-SER-18")
def test_ppmc312_driver_times_in_range() -> None:
    """Elaboration accepts only SND_LEAD 1 to 16 and SND_WAIT 0 to 8 (P312-SER-18)."""
    check_ranges("P312-SER-18", part_design("ppmc312", F16), RANGES)
