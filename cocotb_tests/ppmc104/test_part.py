"""Directed tests of the PPMC-104: one pytest item per cocotb test and build configuration."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F16, check_ranges, cocotb_items, run_item, verifies
from cocotb_tests.harness.build import part_design

from .bench import PPMC104

ITEMS = cocotb_items(
    "cocotb_tests.ppmc104",
    "tb_acceptance_moves",
    "tb_acceptance_stops",
    "tb_acceptance_clocks",
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
    "tb_datasheet_stops",
    "tb_lookup",
    "tb_ext_clock",
    "tb_manual",
    part=PPMC104,
)

# A row contains a parameter, the bounds of its legal range, and values just outside the range.
RANGES = {
    "CLK_HZ": (("8_000_000", "200_000_000"), ("7_999_999", "200_000_001")),
    "XTAL_HZ": (("1_000_000", "16_000_000"), ("999_999", "16_000_001")),
    "TIMING": (('"FAST"', '"DATASHEET"'), ('"SLOW"', '""')),
    "PHASE_IDLE": (("1'b0", "1'b1"), ()),
}


@pytest.mark.parametrize("item", ITEMS)
def test_ppmc104(item, sim_options):
    """Run one simulation."""
    run_item(item, sim_options)


@verifies("P104-PAR-01")
def test_p104_par_01_ranges():
    """The elaboration accepts each parameter at its bounds and rejects values just outside (P104-PAR-01)."""
    check_ranges("P104-PAR-01", part_design("ppmc104", F16), RANGES)
