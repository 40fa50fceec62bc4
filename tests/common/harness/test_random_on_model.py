"""The actions of random hosts depend on responses, so they must be the same on the golden model alone and on
the RTL.
"""

from __future__ import annotations

import pytest

from cocotb_tests.bank import test_random as bank
from cocotb_tests.harness import RandomItems
from cocotb_tests.pmc006 import test_random as pmc006
from cocotb_tests.ppmc104 import test_random as ppmc104
from cocotb_tests.ppmc312 import test_random as ppmc312
from cocotb_tests.ppmc2104 import test_random as ppmc2104
from cocotb_tests.stmc import test_random as stmc


@pytest.mark.parametrize(
    ("items", "seed"),
    [
        (ppmc104.random_item, 3),
        (ppmc2104.random_item, 1),
        (stmc.random_item, 3),
        (ppmc312.random_item, 2),
        (ppmc312.random_item, 8043),  # the host ends while a motion waits for its start
        (ppmc312.noise_item, 1),
        (ppmc312.serial_item, 1),
        (pmc006.random_item, 2),
        (bank.random_item, 4),
    ],
    ids=lambda value: value.test if isinstance(value, RandomItems) else str(value),
)
def test_a_host_does_the_same_on_both_sides(items: RandomItems, seed: int) -> None:
    """For each seed, all pin changes on the RTL are the same as on the model alone."""
    on_rtl, on_the_model = items.pins(seed)
    assert on_rtl == on_the_model != ""
