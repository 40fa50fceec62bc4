"""Directed tests of the bank: one pytest item per cocotb test and build configuration."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import SimOptions, check_ranges, cocotb_items, run_item, verifies
from cocotb_tests.harness.build import part_design
from cocotb_tests.harness.collect import Item

from .bench import BANK, F100

ITEMS = cocotb_items(
    "cocotb_tests.bank",
    "tb_window",
    "tb_bytes",
    "tb_motion",
    "tb_group",
    "tb_limits",
    "tb_standstill",
    "tb_edges",
    "tb_delays",
    part=BANK,
)

# Each row contains a parameter, its legal values, and values just outside its range. The other parameters
# keep their defaults: 32 axes, 100 MHz.
RANGES = {
    "CLK_HZ": (("32_000_000", "200_000_000"), ("28_000_000", "204_000_000", "100_000_001")),
    "XTAL_HZ": (("1_000_000", "16_000_000"), ("999_999", "16_000_001", "15_000_000")),
    "AXES": (("4", "8", "16", "32", "64"), ("0", "2", "12", "128")),
    "PHASE_IDLE": (("1'b0", "1'b1"), ()),
}


@pytest.mark.parametrize("item", ITEMS)
def test_bank(item: Item, sim_options: SimOptions) -> None:
    """Run the simulation of one item."""
    run_item(item, sim_options)


@verifies("BANK-GEN-01", "BANK-GEN-02")
def test_bank_gen_02_ranges() -> None:
    """The elaboration accepts each parameter at its bounds and rejects values just outside (BANK-GEN-02)."""
    check_ranges("BANK-GEN-02", part_design("bank", F100), RANGES)
