"""If a block does not respond, its test fails quickly, with a message that names the wait."""

from __future__ import annotations

import re
import time

import pytest

from cocotb_tests.common.tb_stalled import BLOCKS
from cocotb_tests.harness import Part, cocotb_items
from cocotb_tests.harness.blocks import area_design
from cocotb_tests.harness.build import build
from cocotb_tests.harness.simulate import FAILED, Job, tried

FOUND = cocotb_items("cocotb_tests.common", "tb_stalled", part=Part("x", {}), exact="without a part")
ITEMS = {param.values[0].test: param.values[0] for param in FOUND}


@pytest.mark.parametrize(
    ("test", "said"),
    [
        (
            "waits_for_an_edge",
            r"not finished within 1500000 cycles; the test waits in tb_stalled\.py:\d+: "
            r"await u\.run_until\(\"q2_o",
        ),
        ("polls", r"not finished within 3000 cycles; the test waits in tb_stalled\.py:\d+: await risen\(\)"),
    ],
)
def test_a_stalled_block_fails_with_the_line_it_waits_in(test: str, said: str) -> None:
    """The message names the line that waits, also if the test is the second one of its process."""
    items = tuple(ITEMS[name] for name in sorted({"polls", test}))
    job = Job(area_design("stalled", BLOCKS), items, 1)
    build(job.design)
    begin = time.monotonic()
    outcome = tried(job)[items[-1]]
    assert outcome.kind == FAILED and re.search(said, outcome.text), outcome
    assert time.monotonic() - begin < 120  # without the limit of 10 s the test would take many minutes
