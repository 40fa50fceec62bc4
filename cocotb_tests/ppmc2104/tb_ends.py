"""Ends of operations and the hold delay (P2104-END, P2104-HLD)."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import F11, F16, F48, directed
from cocotb_tests.harness.axis_driver import NO_PULSES_DONE

from .env import Env
from .expected_timing import INIT_A, INIT_B


@directed(
    "P2104-END-01", "P2104-END-07", "P2104-END-08", "P2104-SW-02", "P2104-INT-05", builds=(F16, F11, F48)
)
async def p2104_end_01_normal_end(dut: Any) -> None:
    """After the last rise of pout_n in a complete move of a chopping axis, all actions of the end occur on
    one edge (P2104-END-01).
    """
    env = await Env.start(dut)
    q = env.cfg.quanta
    for axis in env.axes:
        await axis.init(0x12, *INIT_A[1:])
        await axis.send(0x85, [1])
        for code, n, rate in ((0x42, None, None), (0x43, 9, None), (0xC3, 2, None), (0x4C, 5, 20)):
            await axis.go(code, n, rate)
            await axis.busy_until(lambda: env.bench.level("int_n") == 0, "P2104-END-01")
            status = await env.host.status()
            env.check("P2104-END-01", "BUSY after int_n", status & axis.busy, 0)
            rise = env.bench.rises(axis.pout, axis.since)[-1]
            end = await axis.wait_end()
            env.window("P2104-END-01", "pout_n to int_n", end - rise, 0, 4)
            pattern = axis.phases_now
            off = await env.bench.edge(axis.phases, 0x1F)
            env.window(
                "P2104-SW-02", "pout_n to OFF", off - rise, q(2 * 0x53) - q(1) - 1, q(2 * 0x53) + q(1) + 6
            )
            hold = await env.bench.edge(axis.pin("hold"), 1)
            clocks = env.cfg.cyc(4_096)
            env.window("P2104-END-07", "pout_n to hold", hold - rise, clocks, clocks + 24)
            await env.bench.level_is(axis.phases, pattern)
            await axis.result("P2104-END-01", n or 1, 0x80 | code & 7, 0)
        await axis.command(0xC0)


@directed("P2104-END-02", "P2104-END-03", "P2104-TIM-05", "P2104-END-08", builds=(F16, F48))
async def p2104_end_02_pulse_finishes(dut: Any) -> None:
    """An immediate end that occurs at any time in the low time of a pulse does not shorten this pulse
    (P2104-END-02).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    w = env.cfg.w
    for after in (1, 2, w // 2, w - 5, w - 4, w - 3, w - 2, w - 1, w, w + 1, w + 5):
        await axis.go(0x45, rate=60)
        fall = await axis.pulse(3)
        await env.bench.until(fall + after)
        pin = axis.set(alm_n=0)
        end = await axis.wait_end()
        env.check("P2104-END-02", f"low times, {after} cycles", axis.low_times, [w] * 3)
        last = max(pin, fall + w)
        env.window("P2104-END-02", f"end, {after} cycles", end - last, 0, 8)
        pattern = axis.phases_now
        axis.set(alm_n=1)
        await axis.result("P2104-END-02", 3, 0xA5, NO_PULSES_DONE - 4)
        env.check("P2104-END-08", "phases", axis.phases_now, pattern)


@directed("P2104-END-07", "P2104-HLD-01", "P2104-HLD-02", "P2104-OPR-01")
async def p2104_end_07_hold(dut: Any) -> None:
    """Only accepted moves restart the hold timer (here 256 us); no other code does (P2104-END-07,
    P2104-HLD-02).
    """
    env = await Env.start(dut)
    for axis in await env.both(INIT_A):
        await axis.send(0x85, [1])
        await axis.move(0x42)
        rise = env.bench.rises(axis.pout, axis.since)[-1]
        await axis.fetch(0x80)
        axis.set(alm_n=0)
        await axis.refused("P2104-HLD-02", "42 on ALM", 7, 0x42)
        axis.set(alm_n=1)
        await axis.send(0x02, [9, 4, 4, 0])
        hold = await env.bench.edge(axis.pin("hold"), 1)
        env.window("P2104-END-07", "pout_n to hold", hold - rise, 4_096, 4_120)
        since = env.bench.now
        await axis.ready()
        for code in (0x81, 0x82, 0x83, 0x86):
            await axis.fetch(code)
        await env.bench.clocks(100)
        env.check("P2104-HLD-02", "hold edges", axis.edges("hold", since), [])
        # An operation without a pulse changes hold like any other operation.
        axis.set(run=0)
        await axis.go(0x42)
        await axis.command(0x40)
        await axis.idle()
        end = env.bench.now
        hold = await env.bench.edge(axis.pin("hold"), 1)
        env.window("P2104-END-07", "zero pulses: hold", hold - end, 4_096 - 60, 4_120)
        axis.set(run=1)
        # If an operation is accepted just before the timer expires, hold stays low.
        await axis.move(0x42)
        rise = env.bench.rises(axis.pout, axis.since)[-1]
        await env.bench.until(rise + 4_096 - 10)
        await axis.move(0x42)
        await env.bench.clocks(1_000)
        env.check("P2104-END-07", "hold", [v for _, v in axis.edges("hold", rise)], [])
        await env.bench.edge(axis.pin("hold"), 1)
        await axis.finish()
