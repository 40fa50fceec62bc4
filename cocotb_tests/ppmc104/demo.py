"""Stimulus of `make demo`: a host initialises a PPMC-104 and makes two moves; a standstill follows."""

from __future__ import annotations

from typing import Any

import cocotb

from cocotb_tests.harness import HostBus, RtlBench
from cocotb_tests.harness.sessions import DemoLog

from .bench import PPMC104

# 4-phase motor, full step, high level = coil on, internal clock, phases chopped at standstill.
INIT = 0x2A
SLOW, FAST, RAMP = 199, 19, 250  # 2.5 kpps to 25 kpps within 250 pulses
ACC_DEC, CONTINUOUS = 0x43, 0x45
RATE = 49  # 10 kpps
PULSES_TO_LIMIT = 60
INTERRUPT_LATENCY = 800  # cycles: processing time of an old host, 50 us


async def results(host: HostBus) -> None:
    """Wait for the interrupt, then read finish status and remaining pulses as a host does."""
    bench = host.bench
    if bench.level("int_n"):
        await bench.edge("int_n", 0, timeout=3_000_000)
    await bench.clocks(INTERRUPT_LATENCY)
    await host.status()
    await host.fetch(0x80)
    await host.fetch(0x83, 3)


@cocotb.test()
async def demo_move(dut: Any) -> None:
    """A host moves the motor by 1000 pulses, and then until L1 ends the motion; the run is recorded from
    reset to its end.
    """
    bench = await RtlBench.start(dut, PPMC104)
    host = HostBus(bench)
    demo_log = DemoLog(bench)
    with demo_log.chapter("reset", "after reset"):
        await host.status()
        await host.fetch(0x81)
    with demo_log.chapter("init", "initialise"):
        await host.init(INIT, SLOW, FAST, RAMP)
        await host.status()
        # During the table build this command stays in the buffer, so IBF = 0 indicates that the chip is
        # ready.
        await host.fetch(0x82)
    with demo_log.chapter("move", "1000 pulses with ramps"):
        await host.move(ACC_DEC, 1000)
        await results(host)
    with demo_log.chapter("pause", "rest"):
        await bench.clocks(64_000)
    with demo_log.chapter("limit", "run into limit L1"):
        start = bench.now
        await host.send(CONTINUOUS, [RATE])
        last = await bench.nth_fall(PULSES_TO_LIMIT, since=start)
        bench.at(last + 700, l1_n=0)
        await results(host)
        await host.fetch(0x81)
    with demo_log.chapter("rest", "rest until HOLD rises"):
        await bench.edge("hold", 1, timeout=2_000_000)
        await bench.clocks(16_000)
    demo_log.save()
