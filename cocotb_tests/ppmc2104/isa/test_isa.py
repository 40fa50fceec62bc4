"""Simulations of isa_4axis and of its slave alone, and a check of the parameters."""

from __future__ import annotations

import pytest

from cocotb_tests.harness import F16, cocotb_items, run_item
from cocotb_tests.harness.blocks import NO_STAGES, area_design
from cocotb_tests.harness.build import SimError, build

from ...harness.isa import NANOSECONDS
from .setting import ISA_4AXIS, design
from .tb_slave import BLOCKS

HOW = {"part": ISA_4AXIS, "shared": True}
ITEMS = cocotb_items("cocotb_tests.ppmc2104.isa", "tb_bus", "tb_motion", exact=NANOSECONDS, **HOW)
SLAVE_ITEMS = cocotb_items("cocotb_tests.ppmc2104.isa", "tb_slave", exact=NO_STAGES, **HOW)
RANDOM = [item for (item,) in (param.values for param in ITEMS) if item.test == "isa_random_both_parts"]
# One seed of DATASHEET is enough, because its set-up is long.
RANDOM = [item for item in RANDOM if not item.config.datasheet]
SEEDS = range(2, 7)


@pytest.mark.parametrize("item", ITEMS)
def test_isa_4axis(item, sim_options):
    """Run one simulation of the module."""
    run_item(item, sim_options, design=design(item.config))


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("item", RANDOM, ids=[item.id for item in RANDOM])
def test_isa_4axis_random(item, seed, sim_options):
    """Run further seeds of the random hosts."""
    run_item(item.with_seed(seed), sim_options, design=design(item.config))


@pytest.mark.parametrize("item", SLAVE_ITEMS)
def test_isa_slave(item, sim_options):
    """Run one simulation of the slave alone."""
    run_item(item, sim_options, design=area_design("isa", BLOCKS))


@pytest.mark.parametrize("base", [0x301, 0x304, 0x400], ids=hex)
def test_bad_base_address(base):
    """A base address that is not a multiple of 8, or is above 3FFh, stops the elaboration (ISA-03)."""
    with pytest.raises(SimError, match="Base must be 0 .. 3FFh and a multiple"):
        build(design(F16, BASE_ADDR=base))
