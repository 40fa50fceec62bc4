"""Directed tests of the PMC006B4 with an EEPROM: part and device in one top."""

from __future__ import annotations

from dataclasses import replace

import pytest

from cocotb_tests.harness import Config, SimOptions, cocotb_items, run_item
from cocotb_tests.harness.build import Design, part_design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.paths import ROOT

from .bench import PMC006, WITH_EEPROM

ITEMS = cocotb_items(
    "cocotb_tests.pmc006",
    "tb_boot",
    "tb_save",
    "tb_all_states",
    "tb_memory",
    "tb_acceptance_memory",
    part=PMC006,
)
SOURCES = (ROOT / "tb" / "pmc006" / "eeprom_24c32.sv", ROOT / "cocotb_tests" / "pmc006" / "eeprom_bench.sv")


def design(config: Config) -> Design:
    """Return the design of the part with its EEPROM."""
    part = part_design(PMC006.name, config)
    ports = ("clk", "rst_n", *WITH_EEPROM.inputs, *WITH_EEPROM.outputs)
    return replace(part, top="pmc006_eeprom_bench", sources=[*part.sources, *SOURCES], ports=ports)


@pytest.mark.parametrize("item", ITEMS)
def test_pmc006_memory(item: Item, sim_options: SimOptions) -> None:
    """One simulation of the part with its EEPROM passes."""
    run_item(item, sim_options, design=design(item.config))
