"""Random hosts for the PPMC-312: a seed decides build, tables, instructions, pins, and the host's manners.

The host plays on the golden model and reacts to it; the tape goes to the RTL. `plan(seed)` says the build,
`play(seed, config)` plays. Most hosts are lively ones (`lively_host`), some are rough (`rough_host`).
"""

from __future__ import annotations

import random

from cocotb_tests.harness.config import D16, F16, F50, Config

from .host import Host
from .lively_host import Lively
from .rough_host import Player, host_of

__all__ = ["BUILDS", "ODD", "host_of", "plan", "play"]

ODD = Config("odd27x12", clk_hz=27_000_000, xtal_hz=12_000_000)
BUILDS: tuple[tuple[Config, int], ...] = ((F16, 110), (F50, 22), (ODD, 22), (D16, 8))
ROUGH = 0.15
"""Share of the hosts that do not read, do not wait, and send nonsense most of the time."""


def plan(seed: int) -> Config:
    """Build of a seed (any int)."""
    builds, weights = zip(*BUILDS, strict=True)
    return random.Random(f"p312 build {seed}").choices(builds, weights)[0]


def play(seed: int, config: Config) -> Host:
    """Play one seed on the model; AssertionError if the part hangs or answers nonsense."""
    rough = random.Random(f"p312 manners {seed}").random() < ROUGH
    return (Player if rough else Lively)(seed, config).play()
