"""Random hosts for the PPMC-312: a seed decides build, tables, instructions, pins, and the host's manners.

`build(seed)` says the build, `play(dut, seed)` plays. Most hosts are lively ones (`lively_host`), some are
rough (`rough_host`).
"""

from __future__ import annotations

import random
from typing import Any

from cocotb_tests.harness import D16, F16, F50, Config
from cocotb_tests.harness.random_host import Builds

from .host import Host
from .lively_host import Lively
from .rough_host import Player

ODD = Config("odd27x12", clk_hz=27_000_000, xtal_hz=12_000_000)
build = Builds("p312", ((F16, 110), (F50, 22), (ODD, 22), (D16, 8)))
ROUGH = 0.15
"""Share of the hosts that do not read, do not wait, and send nonsense most of the time."""


async def play(dut: Any, seed: int) -> None:
    """Play one seed; AssertionError if the part hangs or answers nonsense."""
    rough = random.Random(f"p312 manners {seed}").random() < ROUGH
    await (Player if rough else Lively)(await Host.start(dut), seed).play()
