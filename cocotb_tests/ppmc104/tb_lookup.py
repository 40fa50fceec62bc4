"""Steep ramps, whose rates are looked up during an interval; every edge is compared with the golden model."""

from __future__ import annotations

from itertools import repeat

from cocotb_tests.harness import D16, F8, F16, HostBus, directed, start_bench

from .bench import PPMC104


@directed("P104-DS-12", builds=(D16,))
async def p104_ds_12_opens_in_a_steep_deceleration(dut):
    """In DATASHEET with steep ramps, a waiting byte is accepted as soon as the rules allow (P104-DS-12)."""
    bench = await start_bench(dut, PPMC104)
    host = HostBus(bench)
    await host.init(0x0A, 120, 3, 12)
    for n in (30, 18, 33, 26):
        await bench.until(bench.now + 300_000)
        await host.send(0x43, (n, 0, 0))
        await bench.nth_fall(5, since=bench.now)
        await host.command(0xC1, poll=False)
        await host.wait_idle(1_000_000)
        await host.command(0xC2)


@directed("P104-TIM-05", "P104-BCK-04", builds=(F16, F8))
async def p104_tim_05_external_cuts_on_steep_ramps(dut):
    """With external clocks that have short high times, every low time of a ramp that skips rates is correct
    (P104-TIM-05).
    """
    bench = await start_bench(dut, PPMC104)
    host = HostBus(bench)
    for slow, fast, steps, period, high in (
        (40, 0, 6, 24, 2),
        (90, 0, 4, 120, 2),
        (30, 3, 5, 20, 3),
        (9, 1, 9, 17, 8),
    ):
        clock = bench.external_clock(repeat(period), high=high)
        await host.init(0x1A, slow, fast, steps)
        for code, n in ((0x43, 2 * steps + 4), (0x43, steps), (0xC3, steps + 1), (0x4B, 3 * steps)):
            await host.send(code, (n, 0, 0))
            await host.wait_idle(400_000)
        clock.cancel()
        bench.set(clock=0)
        await bench.clocks(8)
