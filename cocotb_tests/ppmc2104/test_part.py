"""Directed tests of the PPMC-2104AFP: one pytest item per cocotb test and build configuration."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F16, check_ranges, cocotb_items, run_item, verifies
from cocotb_tests.harness.build import part_design, ports

from .bench import PPMC2104

ITEMS = cocotb_items(
    "cocotb_tests.ppmc2104",
    "tb_acceptance_moves",
    "tb_acceptance_errors",
    "tb_acceptance_axes",
    "tb_acceptance_bus",
    "tb_bus",
    "tb_ports",
    "tb_commands",
    "tb_status",
    "tb_init",
    "tb_motion",
    "tb_ext_clock",
    "tb_ends",
    "tb_ramp",
    "tb_limits",
    "tb_excitation",
    "tb_reads",
    "tb_bad_input",
    "tb_datasheet",
    "tb_datasheet_rates",
    "tb_polling",
    part=PPMC2104,
)


RANGES = {
    "CLK_HZ": (("8_000_000", "200_000_000"), ("7_999_999", "200_000_001")),
    "XTAL_HZ": (("1_000_000", "16_000_000"), ("999_999", "16_000_001")),
    "TIMING": (('"FAST"', '"DATASHEET"'), ('"SLOW"', '""')),
}


@pytest.mark.parametrize("item", ITEMS)
def test_ppmc2104(item, sim_options):
    """Run one simulation."""
    run_item(item, sim_options)


@verifies("P2104-PAR-01")
def test_p2104_par_01_ranges():
    """The elaboration accepts each parameter at its bounds and rejects values just outside (P2104-PAR-01)."""
    check_ranges("P2104-PAR-01", part_design("ppmc2104", F16), RANGES)


@verifies("P2104-PORT-01", "P2104-PORT-05", "P2104-GEN-02")
def test_p2104_port_05_ports():
    """The top module has exactly the ports of the pin table (P2104-PORT-01, P2104-PORT-05)."""
    expected = {"clk": ("input", 0, 0), "rst_n": ("input", 0, 0)}
    for direction, names in (("input", PPMC2104.inputs), ("output", PPMC2104.outputs)):
        for name in names:
            lowest = PPMC2104.lowest.get(name, 0)
            expected[name] = (direction, lowest + PPMC2104.width(name) - 1, lowest)
    assert ports(part_design("ppmc2104", F16)) == expected
