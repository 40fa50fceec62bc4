"""The seeds that a simulation plays one after the other (`batches`)."""

from __future__ import annotations

import os
import re
from collections.abc import Awaitable, Callable
from typing import Any

import cocotb

SEEDS = "OPENPPMC_SEEDS"
_ALONE = re.compile(r"seed -?\d+ alone: make .*")


async def each_seed(test: str, play: Callable[[int], Awaitable[Any]]) -> None:
    """Play the seeds of the batch, or the one of the run; the log tells how to repeat each alone."""
    seeds = os.environ.get(SEEDS, os.environ.get("OPENPPMC_SEED", "1")).split()
    for seed in map(int, seeds):
        if len(seeds) > 1:
            cocotb.log.info("seed %d alone: make test T=%s SEED=%d", seed, test, seed)
        await play(seed)


def last_seed(log: str) -> list[str]:
    """What the log of a batch says of the seed that came last, if it is one."""
    return _ALONE.findall(log)[-1:]
