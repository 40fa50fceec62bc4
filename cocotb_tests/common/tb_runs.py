"""Test cases that end in every possible way, for tests/common/harness/test_runs.py; they test no block."""

from __future__ import annotations

import ctypes
import os
from pathlib import Path
from typing import Any

import cocotb
import pytest
from cocotb.triggers import Timer

from ..harness import probe
from ..harness.sim_backend import sim_backend

LEFT: list[str] = []


async def _clk(dut: Any, **levels: int) -> int:
    """Make one clock cycle with these input levels (0 if omitted); return the level of output q after it."""
    for pin in ("clk", "fire", "die"):
        getattr(dut, pin).value = levels.get(pin, 0)
    await Timer(1, "step")
    dut.clk.value = 1
    await Timer(1, "step")
    return int(dut.q.value)


@cocotb.test()
async def passes(dut):
    """q changes in each cycle."""
    assert await _clk(dut) != await _clk(dut)


@cocotb.test()
async def raises(dut):
    """pytest.raises() works within a test."""
    with pytest.raises(ValueError, match="of no use"):
        raise ValueError("of no use")
    await _clk(dut)


@cocotb.test()
async def skips(dut):
    """The test calls pytest.skip()."""
    await _clk(dut)
    pytest.skip("nothing to do")


@cocotb.test(skip=True)
async def skipped(dut):
    """The test is skipped by its decorator; it would fail if it ran."""
    raise AssertionError("it ran")


@cocotb.test()
async def xfails(dut):
    """The test calls pytest.xfail()."""
    await _clk(dut)
    pytest.xfail("known fault")


@cocotb.test(expect_fail=True)
async def expected(dut):
    """The decorator states that the test is expected to fail, and the test fails."""
    assert await _clk(dut) == 2


@cocotb.test()
@cocotb.parametrize(step=[1, -2])
async def cases(dut, step):
    """The test has two cases, of which one fails."""
    await _clk(dut)
    assert step > 0


@cocotb.test()
async def shows(dut):
    """A plain assert fails."""
    levels = [await _clk(dut) for _ in range(2)]
    assert levels == [7, 7]


@cocotb.test()
@cocotb.parametrize(edge=[1, 2])
async def clocked(dut: Any, edge: int) -> None:
    """An assertion of the RTL fires at one rising edge of a running clock."""
    work = sim_backend()
    dut.fire.value = dut.die.value = 0
    work.clock(work.port("clk"), 10)
    await Timer(20 * edge - 15, "step")
    dut.fire.value = 1
    await Timer(10, "step")
    dut.fire.value = 0
    await Timer(30, "step")


@cocotb.test()
async def fires(dut):
    """An assertion of the RTL fires."""
    await _clk(dut, fire=1)
    await _clk(dut)


@cocotb.test()
async def dies(dut):
    """The RTL calls $fatal."""
    await _clk(dut, die=1)


@cocotb.test()
async def crashes(dut):
    """A segmentation fault occurs."""
    await _clk(dut)
    ctypes.string_at(0)


@cocotb.test()
async def loops(dut):
    """The test does not end, although no simulation time passes."""
    await _clk(dut)
    while True:
        pass


@cocotb.test()
async def leaks(dut):
    """The test leaves state for a later test."""
    await _clk(dut)
    LEFT.append("something")


@cocotb.test()
async def follows(dut):
    """The test fails only if it runs after `leaks`."""
    await _clk(dut)
    assert not LEFT


@cocotb.test()
async def wavers(dut):
    """The test fails when it runs for the first time and passes from then on."""
    await _clk(dut)
    seen = Path(os.environ["OPENPPMC_SEEN"])
    if not seen.exists():
        seen.touch()
        raise AssertionError("the first time")


@cocotb.test()
async def shy(dut):
    """The test fails only if no waves are recorded."""
    await _clk(dut)
    assert b"--trace" in Path("/proc/self/cmdline").read_bytes(), "no trace"


@cocotb.test()
async def pries(dut):
    """The test reads a hidden signal."""
    await _clk(dut)
    assert int(dut.u_inner.count.value) == 1


@cocotb.test()
@probe("u_inner.count")
async def looks(dut):
    """The test reads an inner signal that its decorator `probe` names."""
    first = int(dut.u_inner.count.value)
    await _clk(dut)
    assert int(dut.u_inner.count.value) == (first + 1) % 16
