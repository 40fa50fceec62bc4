"""Constrained-random hosts of the bank, compared with the golden model edge by edge."""

from __future__ import annotations

import logging
from typing import Any

from cocotb_tests.harness import random_test
from cocotb_tests.harness.compare import add_counts

from .random_host import INTERVALS, in_motion, play


@random_test(
    "BANK-WIN-05",
    "BANK-WIN-07",
    "BANK-HSK-03",
    "BANK-HSK-04",
    "BANK-CHP-01",
    "BANK-MOT-01",
    "BANK-MOT-02",
    "BANK-MOT-03",
    "BANK-MOT-04",
    "BANK-MOT-05",
    "BANK-GRP-02",
    "BANK-GRP-03",
    "BANK-GRP-04",
    least=200,
)
async def bank_random_host(dut: Any, seed: int) -> None:
    """During the transactions of a random host, all outputs change on the same edges as in the golden
    model.
    """
    made = await play(dut, seed)
    logging.getLogger("cocotb.bank").info("seed %d: %d intervals", seed, made)
    add_counts(intervals=made)
    assert not in_motion(seed) or made >= INTERVALS, f"only {made} intervals"
