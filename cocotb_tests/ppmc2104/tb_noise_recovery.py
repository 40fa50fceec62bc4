"""Noise on all pins, from which the core must recover."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import IBF, HostBus, RtlBench, random_test
from cocotb_tests.harness.axis_driver import indices, offsets, rates
from cocotb_tests.harness.jitter import jitters
from cocotb_tests.harness.random_host import UNCOMPARED
from cocotb_tests.ppmc2104.expected_timing import BUSY1, BUSY2, CMND1, CMND2, OBF
from cocotb_tests.ppmc2104.random_noise import noise

from .bench import PPMC2104

# Rates that are slow enough for both axes in DATASHEET timing, too.
RAMP = (0x33, 0x25, 4)


@random_test(
    "P2104-BAD-14",
    "P2104-BAD-15",
    "P2104-BAD-20",
    "P2104-BAD-21",
    "P2104-BAD-22",
    "P2104-BAD-26",
    uncompared=UNCOMPARED,
)
async def p2104_random_noise(dut: Any, seed: int) -> None:
    """After noise on all pins, both axes work again if they receive stops, Excitation OFF and a setting."""
    # In style 1, the host below has no set-up time of R/W*, which JITTER=1 needs.
    bench = await RtlBench.start(dut, PPMC2104, seed=seed, busc=0 if jitters() else seed & 1)
    din = noise(bench)
    await din.make(bench.rng.choice((2_000, 10_000, 40_000)))
    await din.stop()
    host = HostBus(bench, timeout=bench.config.us(200_000))
    at_rest = IBF | BUSY1 | BUSY2 | CMND1 | CMND2
    for _ in range(6):
        # The first code may only end a data wait, so both stops are repeated until both axes are at
        # standstill.
        for code in (0x40, 0x60):
            await host.command(code)
        await bench.clocks(bench.config.us(1_000))
        if not await host.poll(IBF, 0) & (BUSY1 | BUSY2):
            break
    await host.poll(at_rest, 0)
    starts = []
    for axis, base in ((1, 0x00), (2, 0x20)):
        await host.command(0xC0 | base)
        await host.init(0x02 | base, *RAMP)
        await host.poll(at_rest, 0)
        await host.command(0x86 | base)
        await host.poll(at_rest, 0)
        while await host.status() & OBF:
            await host.read_data()
        starts.append(bench.now)
        await host.send(0x43 | base, [13, 0, 0])
        await bench.nth_fall(14, starts[-1], f"pout_n[{axis}]")
        await host.poll(at_rest, 0)
    expected = offsets(bench.config, rates(RAMP, indices(14, RAMP[2])))
    for axis, base in ((1, 0x00), (2, 0x20)):
        pulses = bench.pulses(starts[axis - 1], f"pout_n[{axis}]")
        bench.check("P2104-BAD-26", f"pulses of axis {axis}", [t - pulses[0] for t in pulses], expected)
        bench.check("P2104-BAD-26", "end status", await host.fetch(0x80 | base), [0x83])
        for t, _ in bench.edges(f"dir[{axis}]"):
            held = bench.level_at(f"hold[{axis}]", t)
            bench.check("P2104-TIM-06", f"hold when dir changed at {t}", held, 0)
    bench.check("P2104-ERR-06", "status after the last reads", await host.status(), 0)
