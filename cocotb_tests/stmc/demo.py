"""Stimulus of `make demo PART=stmc` on the ISA bus of the board.

An old program moves the motor, runs it to a limit switch and to the reference point, and then holds it.
"""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import IsaHost, RtlBench
from cocotb_tests.harness.isa import IsaMaster
from cocotb_tests.harness.sessions import DemoLog
from openppmc.check.records import steps

from .bench import J105_STMC

BASE = 0x3B0
# 4-phase motor, full step, positive logic for the driver on the board, 48.675 kHz, chopped at standstill.
INIT = 0x3A
SLOW, FAST, RAMP = 50, 10, 60  # 973.5 to 4867.5 steps/s within 60 steps
MOVE, TO_LIMIT, TO_REFERENCE = 0x43, 0x46, 0x4F  # the last move is counterclockwise
STEPS = 300
# Numbers of steps of TO_LIMIT after which L3 and L1 become active.
STEPS_TO_SLOW_DOWN, STEPS_TO_LIMIT = 120, 170
DIVISOR = 25  # 1947 steps/s
STEPS_TO_REFERENCE = 40
INTERRUPT_LATENCY = 800  # cycles, 50 us: processing time of a PC of the old system
LONG = 4_000_000


async def results(host: IsaHost) -> None:
    """Wait for the interrupt, then read finish status and remaining steps as an interrupt handler does."""
    bench = host.bench
    if not bench.level("irq"):
        await bench.edge("irq", 1, timeout=LONG)
    await bench.clocks(INTERRUPT_LATENCY)
    await host.status()
    await host.fetch(0x80)
    await host.fetch(0x83, 3)


async def step(bench: RtlBench, n: int, since: int) -> int:
    """Wait for the n-th step on edge `since` or later; return its edge."""
    seen = [(since, bench.level("drv"))]
    while len(steps([*seen, *bench.edges("drv", since)])) < n:
        await bench.edge("drv", timeout=LONG)
    await bench.align()
    return steps([*seen, *bench.edges("drv", since)])[n - 1]


@cocotb.test()
async def demo_board(dut: Any) -> None:
    """The program of a host on the bus is recorded from power-up to the end."""
    bench = await RtlBench.start(dut, J105_STMC)
    host = IsaHost(IsaMaster(bench), BASE)
    demo_log = DemoLog(bench)
    with demo_log.chapter("reset", "after reset"):
        await host.status()
        await host.fetch(0x81)
    with demo_log.chapter("init", "initialise"):
        await host.init(INIT, SLOW, FAST, RAMP)
        await host.status()
        # During the table build this command stays in the buffer, so IBF = 0 indicates that the board is
        # ready.
        await host.fetch(0x82)
        await bench.clocks(8000)
    with demo_log.chapter("move", f"{STEPS} steps with ramps"):
        await host.move(MOVE, STEPS)
        await results(host)
    with demo_log.chapter("pause", "rest"):
        await bench.clocks(64_000)
    with demo_log.chapter("limit", "accelerate to the limit"):
        await host.send(TO_LIMIT)
        start = bench.now
        last = await step(bench, STEPS_TO_SLOW_DOWN, start)
        bench.at(last + 700, l3_n=0)
        last = await step(bench, STEPS_TO_LIMIT, start)
        bench.at(last + 2500, l1_n=0)
        await results(host)
        await host.fetch(0x81)
    with demo_log.chapter("pause2", "rest"):
        await bench.clocks(64_000)
    with demo_log.chapter("reference", "back to the reference point"):
        await host.send(TO_REFERENCE, [DIVISOR])
        start = bench.now
        last = await step(bench, 2, start)
        bench.at(last + 900, l1_n=1, l3_n=1)
        last = await step(bench, STEPS_TO_REFERENCE, start)
        bench.at(last + 3000, cnp_n=0)
        await results(host)
    with demo_log.chapter("rest", "rest until HOLD rises"):
        await bench.edge("hold", 1, timeout=LONG)
        await bench.clocks(16_000)
    demo_log.save()
