"""Random hosts of the PPMC-312: a seed determines build, tables, instructions, pins, and the kind of host.

`build(seed)` returns the build, and `play(dut, seed)` plays the seed. Most hosts are well-behaved
(`reactive_host`); some misuse the device (`misuse_host`).
"""

from __future__ import annotations

import random
from typing import Any

from cocotb_tests.harness import D16, F16, F50, Config
from cocotb_tests.harness.random_host import Builds

from .host import Host
from .misuse_host import MisuseHost
from .reactive_host import ReactiveHost, UnsortedHost

ODD = Config("odd27x12", clk_hz=27_000_000, xtal_hz=12_000_000)
build = Builds("p312", ((F16, 110), (F50, 22), (ODD, 22), (D16, 8)))
MISUSE_SHARE = 0.15
"""Fraction of the hosts that mostly do not read, do not wait, and send invalid blocks."""


async def play(dut: Any, seed: int) -> None:
    """Play one seed; raise AssertionError if the device hangs or returns an invalid answer."""
    misuse = random.Random(f"p312 manners {seed}").random() < MISUSE_SHARE
    await (MisuseHost if misuse else ReactiveHost)(await Host.start(dut), seed).play()


async def play_changes(dut: Any, seed: int) -> None:
    """As `play`, with tables whose rates are not monotonic and many changes of the speed."""
    await UnsortedHost(await Host.start(dut), seed).play()
