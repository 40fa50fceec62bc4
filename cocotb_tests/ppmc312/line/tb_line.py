"""Runs the scenarios on sixteen RTL stations, then compares each station with a separate golden model."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any

import cocotb

from cocotb_tests.harness import RtlBench, configs, verifies

from .compare import check_line
from .master import Master, RtlPort
from .scenarios import BAD, GOOD, ONE_MUTE, TWINS, Scene, twins
from .setting import F8L, LINE


async def play(dut: Any, scenes: Sequence[Scene], at_least: int, **pins: int) -> None:
    """Run all scenarios one after the other, then compare every output."""
    bench = await RtlBench.start(dut, LINE, settle=8, **pins)
    cocotb.log.info("seed %d", bench.seed)
    master = Master(RtlPort(bench))
    for scene in scenes:
        try:
            await scene(master, random.Random(f"{scene.__name__} {bench.seed}"))
        except AssertionError as error:
            check_line(bench)
            raise AssertionError(f"{scene.__name__}: {error}") from None
    await bench.clocks(100)
    check_line(bench, at_least)


@cocotb.test()
@configs(F8L)
@verifies("P312-SER-01", "P312-SER-02", "P312-SER-18", "P312-SER-19", "P312-SER-20", "P312-SER-30")
async def line_sixteen_axes(dut: Any) -> None:
    """Sixteen axes on one line move as commanded; the master sets them up, starts and polls them, and reads
    their positions.
    """
    await play(dut, GOOD, 8_000)


@cocotb.test()
@configs(F8L)
@verifies("P312-SER-10", "P312-SER-12", "P312-SER-14", "P312-SER-15", "P312-BAD-16")
async def line_bad_input(dut: Any) -> None:
    """After each disturbance of the line, all sixteen stations answer their first poll."""
    await play(dut, BAD, 1_500)


@cocotb.test()
@configs(F8L)
@verifies("P312-PRT-03", "P312-BAD-16", "P312-BAD-17")
async def line_twins(dut: Any) -> None:
    """Two stations with one address that answer together do not disturb the other fourteen stations."""
    await play(dut, (twins,), 400, adr=TWINS, mod=ONE_MUTE)
