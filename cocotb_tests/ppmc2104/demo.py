"""Stimulus of `make demo PART=ppmc2104`: a straight line of two axes, then separate moves."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import HostBus, RtlBench
from cocotb_tests.harness.sessions import DemoLog

from .bench import PPMC2104

# Axis 1 has a 4-phase motor in full step, axis 2 in half step. Both axes use the internal clock and switch
# their phases at standstill.
SETTINGS = {1: (0x12, 127, 39, 200), 2: (0x36, 255, 79, 100)}  # code, RL, RH, PA
PULSES = {1: 1000, 2: 500}
CW, CCW = 0x43, 0x6B  # ramped moves: axis 1 clockwise, axis 2 counterclockwise
CONTINUOUS, HIGH_SPEED = 0x45, 0x66  # axis 1 moves until its limit, axis 2 until its slow-down limit
RATE = 49  # 10 kpps
PULSES_TO_LIMIT, PULSES_TO_SLOW_DOWN = {1: 150}, {2: 130}
BUSY = {1: 0x04, 2: 0x08}
CMND = 0x30
INTERRUPT_LATENCY = 2400  # cycles, 150 us: latency of a busy host, in which both axes end
BETWEEN_AXES = 320  # cycles, 20 us: time in which the host processes the answers of one axis
LONG = 4_000_000


async def serve(host: HostBus, pending: set[int]) -> None:
    """Wait for the interrupt, then read end status and remaining pulses of each axis of `pending` that is at
    standstill.
    """
    bench = host.bench
    if bench.level("int_n"):
        await bench.edge("int_n", 0, timeout=LONG)
    await bench.clocks(INTERRUPT_LATENCY)
    status = await host.status()
    for axis in sorted(pending):
        if not status & BUSY[axis]:
            await host.fetch(0x80 | (axis - 1) << 5)
            await host.fetch(0x83 | (axis - 1) << 5, 3)
            pending.discard(axis)
            await bench.clocks(BETWEEN_AXES)


@cocotb.test()
async def demo_two_axes(dut: Any) -> None:
    """A host starts both axes with RUN and then moves them separately; the run is recorded from reset to
    its end.
    """
    bench = await RtlBench.start(dut, PPMC2104, run=0b00)
    host = HostBus(bench)
    demo_log = DemoLog(bench)
    with demo_log.chapter("reset", "after reset"):
        await host.status()
        await host.fetch(0x81)
        await host.fetch(0xA1)
    with demo_log.chapter("init", "set up both axes"):
        for setting in SETTINGS.values():
            await host.init(*setting)
        await host.poll(CMND, 0)
    with demo_log.chapter("wait", "two moves wait for RUN"):
        await host.move(CW, PULSES[1])
        await host.move(CCW, PULSES[2])
        await bench.clocks(48_000)
    with demo_log.chapter("move", "a line: 1000 and 500 pulses"):
        await bench.align()
        bench.set(run=0b11)
        pending = {1, 2}
        while pending:
            await serve(host, pending)
    with demo_log.chapter("pause", "rest"):
        await bench.edge("hold", 0b11, timeout=LONG)
        await bench.clocks(32_000)
    with demo_log.chapter("limits", "each to its own limit"):
        start = bench.now
        await host.send(CONTINUOUS, [RATE])
        await host.send(HIGH_SPEED)
        last = await bench.nth_fall(PULSES_TO_LIMIT[1], start, "pout_n[1]", LONG)
        bench.at(last + 1100, **{"fl_n[1]": 0})
        pending = {1, 2}
        await serve(host, pending)
        await host.fetch(0x81)
        last = await bench.nth_fall(PULSES_TO_SLOW_DOWN[2], start, "pout_n[2]", LONG)
        bench.at(last + 700, **{"fhl_n[2]": 0})
        while pending:
            await serve(host, pending)
        await host.fetch(0xA1)
    with demo_log.chapter("rest", "rest until HOLD rises"):
        await bench.edge("hold", 0b11, timeout=LONG)
        await bench.clocks(16_000)
    demo_log.save()
