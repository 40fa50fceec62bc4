"""Directed tests of the STMC core: one pytest item per cocotb test and build configuration."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F16, check_ranges, cocotb_items, run_item
from cocotb_tests.harness.build import part_design

from .bench import STMC

ITEMS = cocotb_items(
    "cocotb_tests.stmc",
    "tb_acceptance_moves",
    "tb_acceptance_stops",
    "tb_acceptance_registers",
    "tb_bus",
    "tb_status",
    "tb_init",
    "tb_motion",
    "tb_ext_clock",
    "tb_stops",
    "tb_chopper",
    "tb_datasheet",
    part=STMC,
)

# A row contains a parameter, its legal values, and values just outside its range (docs/stmc/README.md, 3).
RANGES = {
    "CLK_HZ": (("8_000_000", "200_000_000"), ("7_999_999", "200_000_001")),
    "XTAL_HZ": (("1_000_000", "20_000_000"), ("999_999", "20_000_001")),
    "TIMING": (('"FAST"', '"DATASHEET"'), ('"SLOW"', '""')),
    "READ_MAP": (('"SHEET"', '"FAMILY"'), ('"sheet"', '""')),
    "PHASE_IDLE": (("1'b0", "1'b1"), ()),
    "HOLD_XT": (("1", "544_000"), ("0",)),
    "CHOP_ON_XT": (("1", "1_040"), ("0",)),
    "CHOP_OFF_XT": (("1", "1_740"), ("0",)),
}


@pytest.mark.parametrize("item", ITEMS)
def test_stmc(item, sim_options):
    """Run one simulation."""
    run_item(item, sim_options)


def test_stmc_parameter_ranges():
    """The elaboration accepts each parameter at its bounds and rejects values just outside."""
    check_ranges("STMC 1.4", part_design("stmc", F16), RANGES)
