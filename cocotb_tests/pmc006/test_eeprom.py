"""tb/pmc006/eeprom_24c32.sv compared with openppmc/model/carrier/eeprom.py, and the Python device alone."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import Part, SimOptions, cocotb_items, run_item
from cocotb_tests.harness.build import Design
from cocotb_tests.harness.collect import Item
from cocotb_tests.harness.paths import ROOT
from openppmc.model.carrier.eeprom import Eeprom24C32

from .tb_eeprom import WRITE_CLK

TOP = "eeprom_24c32"
ITEMS = cocotb_items(
    "cocotb_tests.pmc006", "tb_eeprom", part=Part(TOP, {}), exact="only the EEPROM is simulated"
)
ARGS = ("-Wno-fatal", "--public-flat-rw")


@pytest.mark.parametrize("item", ITEMS)
@pytest.mark.parametrize("stretch", [11])
def test_both_devices(item: Item, stretch: int, sim_options: SimOptions) -> None:
    """With random traffic, both devices pull the lines in the same cycles and have equal contents
    afterwards.
    """
    params = {"WriteCycles": WRITE_CLK, "StretchCycles": stretch, "Device": 0x53}
    source = ROOT / "tb" / "pmc006" / f"{TOP}.sv"
    run_item(item, sim_options, design=Design(TOP, [source], params=params, args=ARGS))


def test_too_much_content() -> None:
    with pytest.raises(ValueError, match="do not fit"):
        Eeprom24C32(8_000_000, bytes(4097))
