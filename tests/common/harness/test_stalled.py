"""A block that does not answer fails its test quickly, with a message that names the wait."""

from __future__ import annotations

import time

import pytest

from cocotb_tests.common.tb_stalled import BLOCKS
from cocotb_tests.harness.build import SimError, build
from cocotb_tests.harness.collect import cocotb_items
from cocotb_tests.harness.part import Part
from cocotb_tests.harness.runner import run_sim
from cocotb_tests.harness.wrapper import area_design

ITEMS = [param.values[0] for param in cocotb_items("cocotb_tests.common", "tb_stalled", part=Part("x", {}))]


@pytest.mark.parametrize(
    ("test", "said"),
    [
        (
            "waits_for_an_edge",
            r"no end within 1500000 clk, the test waits in tb_stalled\.py:\d+: await u\.run_until\(\"q2_o",
        ),
        ("polls", r"no end within 3000 clk, the test waits in tb_stalled\.py:\d+: await risen\(\)"),
    ],
)
def test_a_stalled_block_fails_with_the_line_it_waits_in(test: str, said: str) -> None:
    (item,) = (item for item in ITEMS if item.test == test)
    design = area_design("stalled", BLOCKS)
    build(design)
    begin = time.monotonic()
    with pytest.raises(SimError, match=said):
        run_sim(design, item, item.seed)
    assert time.monotonic() - begin < 120  # 10 s; many minutes without the limit
