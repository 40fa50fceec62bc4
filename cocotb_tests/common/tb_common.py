"""Contracts of rtl/common: ppmc_sync, ppmc_reset, ppmc_ram, ppmc_tick_gen, ppmc_square, ppmc_xtal_timer."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import cocotb
from cocotb.triggers import Timer

from ..harness import Block, BlockDriver, rng, same
from ..harness.jitter import jitters

TICKS = [
    (8_000_000, 16_000_000, 4),
    (11_059_200, 16_000_000, 4),
    (16_000_000, 16_000_000, 4),
    (25_000_000, 16_000_000, 4),
    (25_000_000, 8_000_000, 4),
    (100_000_000, 16_000_000, 4),
    (200_000_000, 16_000_000, 4),
    (11_059_200, 1_000_000, 1),
    (25_000_000, 16_000_000, 1),  # shorter than two cycles
    (16_000_000, 16_000_000, 1),  # every cycle
]
SQUARES = [
    (8_000_000, 16_000_000, 2),
    (11_059_200, 16_000_000, 2),
    (16_000_000, 16_000_000, 2),
    (48_000_000, 16_000_000, 2),
    (200_000_000, 1_000_000, 2),
    (25_000_000, 12_000_000, 3),
    (16_000_000, 2 * 48_675, 1),  # crystal of the J105 board
    (8_000_000, 4_000_000, 1),
]
TIMERS = [
    (8_000_000, 16_000_000, 8),
    (11_059_200, 16_000_000, 8),
    (16_000_000, 16_000_000, 8),
    (25_000_000, 16_000_000, 6),
    (200_000_000, 1_000_000, 3),
    (8_000_000, 20_000_000, 8),
    (9_999_999, 20_000_000, 6),
]
BLOCKS = {
    "sync": Block("ppmc_sync", "d_i:5 q1_o:5 q2_o:5", {"Width": 5, "ResetVal": "5'b10110"}),
    "reset": Block("ppmc_reset", "rst_no"),
    "ram": Block(
        "ppmc_ram",
        "clk_i we_i waddr_i:5 wdata_i:9 raddr_i:5 rdata_o:9",
        {"Width": 9, "AddrBits": 5},
        bare=True,
    ),
    **{
        f"tick{i}": Block(
            "ppmc_tick_gen",
            "restart_i tick_o",
            {"ClkHz": clk, "XtalHz": xtal, "TickXtal": step, "MinCycles": 1 + (step * clk >= 2 * xtal)},
        )
        for i, (clk, xtal, step) in enumerate(TICKS)
    },
    **{
        f"square{i}": Block("ppmc_square", "wave_o", {"ClkHz": clk, "XtalHz": xtal, "HalfXtal": half})
        for i, (clk, xtal, half) in enumerate(SQUARES)
    },
    **{
        f"timer{i}": Block(
            "ppmc_xtal_timer",
            f"restart_i limit_i:{width} past_o",
            {"ClkHz": clk, "XtalHz": xtal, "Width": width},
        )
        for i, (clk, xtal, width) in enumerate(TIMERS)
    },
}


def unit(dut, name: str, watch: str) -> BlockDriver:
    return BlockDriver(dut, name, BLOCKS, watch)


@cocotb.test()
async def sync_two_stages(dut):
    """A level appears on q1 after the edge that samples it, and on q2 one cycle later. During reset, both are
    ResetVal. With JITTER=1, some changes, but not all, appear one cycle late.
    """
    rand, u = rng(), unit(dut, "sync", "q1_o q2_o")
    await u.reset(d_i=0)
    past, before = [0b10110, 0b10110], 0b10110
    late = prompt = 0
    for n in range(300):
        level = rand.getrandbits(5)
        q1, q2 = await u.clk(d_i=level)
        wrong, changed = q1 ^ past[-1], past[-1] ^ past[-2]
        same(f"cycle {n}: wrong bits of q1 without a change; q2", (wrong & ~changed, q2), (0, before))
        late, prompt, before = late | wrong, prompt | changed & ~wrong, q1
        past.append(level)
    same("late bits, prompt bits", (late, prompt), (0b11111 if jitters() else 0, 0b11111))
    same("reset at once", await u.settle(rst_ni=0), (0b10110, 0b10110))


@cocotb.test()
async def reset_release(dut):
    """rst_no falls immediately with rst_ni and rises on the second edge that samples rst_ni = 1."""
    rand, u = rng(), unit(dut, "reset", "rst_no")
    await u.reset()
    for _ in range(60):
        same("fall", await u.settle(rst_ni=0), 0)
        for _ in range(rand.randrange(3)):
            same("held", await u.clk(), 0)
        u.put(rst_ni=1)
        same("before edge 1", await u.clk(), 0)
        if rand.random() < 0.3:
            same("second fall", await u.settle(rst_ni=0), 0)
            u.put(rst_ni=1)
            same("restarts", await u.clk(), 0)
        same("before edge 2", await u.clk(), 0)
        same("after edge 2", await u.clk(), 1)


@cocotb.test()
async def ram_two_clk(dut):
    """If reads and writes use different addresses, read data is valid two cycles after its address."""
    rand, u = rng(), unit(dut, "ram", "rdata_o")
    u.choose()
    mem, due = [0] * 32, []
    for n in range(1500):
        read, write = rand.sample(range(32), 2)
        we, value = int(n > 100 and rand.random() < 0.5), rand.getrandbits(9)
        got = await u.clk(we_i=we, waddr_i=write, wdata_i=value, raddr_i=read)
        if n > 1:
            same(f"cycle {n}", got, due[n - 2])
        due.append(mem[read])
        if we:
            mem[write] = value


@cocotb.test()
async def tick_gen_exact(dut):
    """After a restart at any time, tick n occurs exactly ceil(n * TickXtal * ClkHz / XtalHz) cycles later."""
    rand = rng()
    for i, (clk, xtal, step) in enumerate(TICKS):
        u = unit(dut, f"tick{i}", "tick_o")
        period = Fraction(step * clk, xtal)
        await u.reset()
        # With these settings, the phase of the ticks repeats after at most 1728 cycles.
        for run in [2000] + [rand.randint(1, ceil(6 * period)) for _ in range(15)]:
            await u.clk(restart_i=1)
            n = 1
            for j in range(1, run + 1):
                due = j == ceil(n * period)
                same(f"{clk} Hz, {xtal} Hz, cycle {j} of {run}", await u.clk(restart_i=0), due)
                n += due
        await u.settle(rst_ni=0)
        same(f"{clk} Hz, {xtal} Hz, in reset", await u.settle(), 0)


@cocotb.test()
async def square_no_drift(dut):
    """Toggle t occurs ceil(t * HalfXtal * ClkHz / XtalHz) cycles after reset."""
    for i, (clk, xtal, half) in enumerate(SQUARES):
        u = unit(dut, f"square{i}", "wave_o")
        period = Fraction(half * clk, xtal)
        await u.reset()
        level, t = 0, 1
        for j in range(5000):
            if j == ceil(t * period):
                level, t = 1 - level, t + 1
            same(f"{clk} Hz, {xtal} Hz, {j} cycles after the reset", await u.clk(), level)
        await u.settle(rst_ni=0)
        same("level in reset", await u.settle(), 0)


@cocotb.test()
async def xtal_timer_exact(dut):
    """past_o rises in the cycle after ceil(limit * ClkHz / XtalHz) cycles, and then remains high."""
    rand = rng()
    for i, (clk, xtal, width) in enumerate(TIMERS):
        u = unit(dut, f"timer{i}", "past_o")
        await u.reset()
        top = 2**width - (4 if xtal > 2 * clk else 2)
        for limit in [top, 0, 1, 2] + [rand.randint(0, top) for _ in range(6)]:
            due = ceil(Fraction(limit * clk, xtal))
            run = due + 2**width * 3 if limit == top else rand.randint(0, due + 5)
            await u.clk(restart_i=1, limit_i=limit)
            for j in range(1, run + 1):
                got = await u.clk(restart_i=0)
                same(f"{clk} Hz, {xtal} Hz, limit {limit}, cycle {j}", got, j > due)


@cocotb.test()
async def xtal_timer_new_limit(dut):
    """While the timer counts, past_o follows a new limit in the same cycle."""
    u = unit(dut, "timer2", "past_o")
    await u.reset()
    await u.clk(restart_i=1, limit_i=100)
    for _ in range(50):
        await u.clk(restart_i=0)
    same("50 passed, limit 51", await u.settle(limit_i=51), 0)
    same("50 passed, limit 50", await u.settle(limit_i=50), 1)
    await Timer(1, "step")
    same("reset", await u.settle(rst_ni=0), 0)
