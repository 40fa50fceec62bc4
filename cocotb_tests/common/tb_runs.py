"""Not tests of a block: every way in which a test can end (tests/common/harness/test_runs.py)."""

from __future__ import annotations

import ctypes
import os
from pathlib import Path
from typing import Any

import cocotb
import pytest
from cocotb.triggers import Timer

from ..harness import inside
from ..harness.clock import clockwork

LEFT: list[str] = []


async def _clk(dut: Any, **levels: int) -> int:
    """One clk with these inputs, all others 0; the level of q behind it."""
    for pin in ("clk", "fire", "die"):
        getattr(dut, pin).value = levels.get(pin, 0)
    await Timer(1, "step")
    dut.clk.value = 1
    await Timer(1, "step")
    return int(dut.q.value)


@cocotb.test()
async def passes(dut):
    """q changes with each clk."""
    assert await _clk(dut) != await _clk(dut)


@cocotb.test()
async def raises(dut):
    """pytest.raises() works."""
    with pytest.raises(ValueError, match="of no use"):
        raise ValueError("of no use")
    await _clk(dut)


@cocotb.test()
async def skips(dut):
    """pytest.skip() within a test."""
    await _clk(dut)
    pytest.skip("nothing to do")


@cocotb.test(skip=True)
async def skipped(dut):
    """Would fail."""
    raise AssertionError("it ran")


@cocotb.test()
async def xfails(dut):
    """pytest.xfail() within a test."""
    await _clk(dut)
    pytest.xfail("known fault")


@cocotb.test(expect_fail=True)
async def expected(dut):
    """A failure that cocotb expects."""
    assert await _clk(dut) == 2


@cocotb.test()
@cocotb.parametrize(step=[1, -2])
async def cases(dut, step):
    """Two cases, of which one fails."""
    await _clk(dut)
    assert step > 0


@cocotb.test()
async def shows(dut):
    """A plain assert."""
    levels = [await _clk(dut) for _ in range(2)]
    assert levels == [7, 7]


@cocotb.test()
@cocotb.parametrize(edge=[1, 2])
async def clocked(dut: Any, edge: int) -> None:
    """An assertion fires at one rising edge of a clock that is started."""
    work = clockwork()
    dut.fire.value = dut.die.value = 0
    work.clock(work.port("clk"), 10)
    await Timer(20 * edge - 15, "step")
    dut.fire.value = 1
    await Timer(10, "step")
    dut.fire.value = 0
    await Timer(30, "step")


@cocotb.test()
async def fires(dut):
    """An assertion of the RTL."""
    await _clk(dut, fire=1)
    await _clk(dut)


@cocotb.test()
async def dies(dut):
    """$fatal in the RTL."""
    await _clk(dut, die=1)


@cocotb.test()
async def crashes(dut):
    """A segmentation fault."""
    await _clk(dut)
    ctypes.string_at(0)


@cocotb.test()
async def loops(dut):
    """No end, and no time of the simulation passes."""
    await _clk(dut)
    while True:
        pass


@cocotb.test()
async def leaks(dut):
    """Leaves something behind."""
    await _clk(dut)
    LEFT.append("something")


@cocotb.test()
async def follows(dut):
    """Fails behind `leaks` only."""
    await _clk(dut)
    assert not LEFT


@cocotb.test()
async def wavers(dut):
    """Fails the first time, passes from then on."""
    await _clk(dut)
    seen = Path(os.environ["OPENPPMC_SEEN"])
    if not seen.exists():
        seen.touch()
        raise AssertionError("the first time")


@cocotb.test()
async def shy(dut):
    """Fails without waves only."""
    await _clk(dut)
    assert b"--trace" in Path("/proc/self/cmdline").read_bytes(), "nobody looks"


@cocotb.test()
async def pries(dut):
    """Reads a signal that is hidden."""
    await _clk(dut)
    assert int(dut.u_inner.count.value) == 1


@cocotb.test()
@inside("u_inner.count")
async def looks(dut):
    """Reads a signal that it has asked for."""
    first = int(dut.u_inner.count.value)
    await _clk(dut)
    assert int(dut.u_inner.count.value) == (first + 1) % 16
