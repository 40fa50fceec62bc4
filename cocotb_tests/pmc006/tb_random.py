"""Random hosts, compared with the golden model in every cycle."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import random_test

from . import random_host


@random_test(
    "P006-FRM-02",
    "P006-FRM-03",
    "P006-FRM-07",
    "P006-UART-03",
    "P006-UART-05",
    "P006-STA-10",
    "P006-STA-14",
    "P006-STA-18",
    "P006-MOT-03",
    "P006-MOT-05",
    "P006-MOT-20",
    "P006-MOT-30",
    "P006-EXC-13",
    "P006-EXC-24",
    "P006-CHP-06",
    "P006-PRG-15",
    "P006-PRG-16",
    "P006-BAD-05",
    "P006-BAD-16",
    "P006-BAD-17",
    "P006-BAD-24",
    least=200,
)
async def p006_random_host(dut: Any, seed: int) -> None:
    """With the pin changes of random hosts, all outputs change as in the golden model."""
    await random_host.play(dut, seed)
