"""Tests of the blocks around a bank: ppmc_bank_axis_port, and the carrier with its SPI host."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import SimOptions, cocotb_items, run_item
from cocotb_tests.harness.blocks import BLOCKS, NO_STAGES, run_block
from cocotb_tests.harness.build import Design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import files

VIEW = cocotb_items("cocotb_tests.bank", "tb_view", part=BLOCKS, shared=True, exact=NO_STAGES)
SPI = cocotb_items("cocotb_tests.bank", "tb_spi", part=BLOCKS, shared=True, tolerant=True)
# Start values are 0, as in an FPGA. The build uses one C++ file, as in the tests of the UART bridge.
FROM_ZERO = ("--output-split", "0", "--x-initial", "0")


@pytest.mark.parametrize("item", VIEW)
def test_view(item: Item, sim_options: SimOptions) -> None:
    """Run one simulation of ppmc_bank_axis_port."""
    run_block(item, sim_options)


@pytest.mark.parametrize("item", SPI)
def test_carrier(item: Item, sim_options: SimOptions) -> None:
    """Run one simulation of ppmc_bank_carrier."""
    params = {"CLK_HZ": item.config.clk_hz, **dict(item.config.extra)}
    includes = [ROOT / "rtl" / "common"]
    design = Design("ppmc_bank_carrier", files("ppmc_bank_carrier"), includes, params, FROM_ZERO)
    run_item(item, sim_options, design=design)
