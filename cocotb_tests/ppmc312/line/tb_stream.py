"""Runs the stream of one seed on sixteen RTL stations, then compares each station with a separate golden
model.
"""

from __future__ import annotations

import os
from typing import Any

import cocotb

from cocotb_tests.harness import RtlBench, configs, verifies

from .compare import check_line
from .master import Master, RtlPort
from .setting import F8L, LINE
from .stream import pins_of, play

SIZE = 120
"""Length of the stream in characters."""


@cocotb.test()
@configs(F8L)
@verifies("P312-BAD-16", "P312-SER-10", "P312-SER-15", "P312-SER-19")
async def line_stream(dut: Any) -> None:
    """After each section of a random stream on the line, every station answers its first or second poll."""
    seed = int(os.environ.get("OPENPPMC_SEED", "1"))
    bench = await RtlBench.start(dut, LINE, settle=8, **pins_of(seed))
    cocotb.log.info("seed %d", seed)
    try:
        late = await play(Master(RtlPort(bench)), seed, SIZE)
    except AssertionError as error:
        check_line(bench)
        raise AssertionError(f"stream of seed {seed}: {error}") from None
    await bench.clocks(100)
    check_line(bench)
    cocotb.log.info("%d stations needed a second poll", late)
