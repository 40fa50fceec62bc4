"""Phases and switching at standstill (P2104-PHS, P2104-SW)."""

from __future__ import annotations

from itertools import product
from typing import Any

from cocotb_tests.harness import F11, F16, F48, directed
from cocotb_tests.harness.axis_driver import differences, steps

from .env import Env
from .expected_timing import INIT_A, STEP_CODES

FULL, OFF = 0b11100, 0b11111


@directed("P2104-PHS-01", "P2104-PHS-04", "P2104-PHS-05", "P2104-TIM-04", "P2104-EX-11")
async def p2104_phs_01_lists_in_motion(dut: Any) -> None:
    """For each motor type, each pulse of a ramp selects the next row of the list on the edge of the pulse, in
    both directions (P2104-PHS-01).
    """
    env = await Env.start(dut)
    for axis, (name, code) in product(env.axes, STEP_CODES.items()):
        await axis.init(code, *INIT_A[1:])
        patterns = steps(name, positive=False)
        place = 0
        for op, direction, n in ((0x53, 1, 14), (0x5B, -1, 25), (0x54, 1, 11)):
            await axis.go(op, n, 5 if op == 0x54 else None)
            await axis.idle()
            places = [(place + direction * i) % len(patterns) for i in range(1, n + 1)]
            expected = list(zip(axis.pulses, [patterns[i] for i in places], strict=True))
            got = env.bench.edges(axis.phases, axis.since)
            env.check("P2104-PHS-04", f"{name} by {op:#x}, axis {axis.n}", got, expected)
            place = places[-1]
        half = name.replace("full", "half")
        env.check("P2104-PHS-05", name, steps(half)[::2], steps(half.replace("half", "full")))
        await axis.command(0xC0)


@directed("P2104-PHS-02", "P2104-PHS-03", "P2104-PHS-04", "P2104-AUX-01")
async def p2104_phs_02_off_until_set(dut: Any) -> None:
    """Without a setting, all phases stay high during any instruction; POUT mode does not change the pattern
    (P2104-PHS-02, P2104-PHS-04).
    """
    env = await Env.start(dut)
    for axis in env.axes:
        for _ in range(2):
            since = env.bench.now
            await axis.send(0x84, [0x40, 0x40])
            await axis.refused("P2104-PHS-02", "42", 4, 0x42)
            await axis.refused("P2104-PHS-02", "a bad setting", 9, 0x12, 5, 4, 4, 0)
            await axis.send(0x02, [9, 4, 4])
            await axis.refused("P2104-PHS-02", "86 instead of the last byte", 3, 0x86)
            await env.bench.clocks(2_000)
            env.check("P2104-PHS-02", "edges of the phases", env.bench.edges(axis.phases, since), [])
            env.check("P2104-PHS-02", "phases", axis.phases_now, OFF)
            await axis.init(*INIT_A)
            await axis.move(0x42)
            await axis.move(0x42)
            pattern = axis.phases_now
            await axis.move(0xC3, 5)
            env.check("P2104-PHS-04", "pattern", (pattern, axis.phases_now), (0b10011, 0b10011))
            await axis.init(0x01, *INIT_A[1:])
            env.check("P2104-PHS-03", "pattern after a second setting", axis.phases_now, pattern)
            await axis.command(0xC0)
            await env.bench.clocks(2)
            await env.errors()


@directed("P2104-SW-01", "P2104-SW-04", "P2104-SW-05", "P2104-AUX-06", "P2104-GEN-04", builds=(F16, F11, F48))
async def p2104_sw_04_times(dut: Any) -> None:
    """With default and programmed times, each chopper phase of both axes is accurate to 1 quantum, without
    drift (P2104-SW-04).
    """
    env = await Env.start(dut)
    q = env.cfg.quanta
    for times in ((0x53, 0xA6), (0x40, 0x41), (0xFF, 0x40)):
        for axis in env.axes:
            if times != (0x53, 0xA6):
                await axis.send(0x84, times)
            await axis.init(0x12, *INIT_A[1:])
        since = env.bench.now
        await env.bench.clocks(20 * q(2 * sum(times)))
        for axis in env.axes:
            spans = axis.stretches(since)
            env.check("P2104-SW-01", "patterns by turns", {v for v, _ in spans}, {FULL, OFF})
            for pattern, span in spans:
                value = times[0] if pattern == FULL else times[1]
                env.window("P2104-SW-04", f"{pattern:05b}", span, q(2 * value - 1) - 1, q(2 * value + 1) + 1)
            falls = [t for t, v in env.bench.edges(axis.phases, since) if v == FULL]
            env.window("P2104-SW-04", "periods", len(falls), 18, 21)
            total = falls[-1] - falls[0] - q(2 * sum(times) * (len(falls) - 1))
            env.window("P2104-SW-04", "drift", total, -q(1) - 1, q(1) + 1)
            await axis.command(0xC0)


@directed("P2104-SW-01", "P2104-SW-02", "P2104-SW-03", "P2104-OPR-08", "P2104-END-08", builds=(F16, F11))
async def p2104_sw_03_motions(dut: Any) -> None:
    """If a chopping axis starts in either phase, it moves with the full pattern; a complete ON phase follows
    its end (P2104-SW-03).
    """
    env = await Env.start(dut)
    q, w = env.cfg.quanta, env.cfg.w
    for axis, (code, n, rate) in product(
        env.axes, ((0x52, None, None), (0x53, 3, None), (0xD3, 3, None), (0x54, 2, 30))
    ):
        await axis.init(0x16, *INIT_A[1:])
        for phase, waiting in ((FULL, False), (OFF, False), (OFF, True)):
            pattern = env.bench.level_at(axis.phases, env.bench.now)
            while axis.phases_now == OFF:
                await env.bench.edge(axis.phases)
            pattern = axis.phases_now
            if phase == OFF:
                await env.bench.edge(axis.phases, OFF)
            await env.bench.clocks(30)
            axis.set(run=0 if waiting else 1)
            await axis.go(code, n, rate)
            if waiting:
                await env.bench.clocks(3_000)
                axis.set(run=1)
            first = await axis.pulse(1)
            env.check(
                "P2104-SW-03", "pattern before pulse 1", env.bench.level_at(axis.phases, first - 1), pattern
            )
            changes = [t for t, _ in env.bench.edges(axis.phases, axis.since) if t < first]
            env.check(
                "P2104-SW-03", "edges before pulse 1", len(changes), 1 if phase == OFF else len(changes)
            )
            env.window(
                "P2104-SW-03", "full pattern before pulse 1", first - max(changes, default=0), w, 10**9
            )
            await axis.idle()
            rise = env.bench.rises(axis.pout, axis.since)[-1]
            off = [t for t, v in env.bench.edges(axis.phases, rise) if v == OFF]
            off = off[0] if off else await env.bench.edge(axis.phases, OFF)
            low, high = q(2 * 0x53) - q(1) - 1, q(2 * 0x53) + q(1) + 7
            env.window("P2104-SW-02", "pout_n rise to OFF", off - rise, low, high)
            moved = [t for t, v in env.bench.edges(axis.phases, first) if t <= rise]
            env.check("P2104-OPR-08", "steps", moved, [] if code & 0x80 else axis.pulses)
        await axis.command(0xC0)
    env.check("P2104-GEN-04", "quantum ticks", set(differences([q(i) for i in range(9)])) <= {2, 3, 4}, True)


@directed("P2104-SW-02", "P2104-INI-07", "P2104-SW-01")
async def p2104_sw_02_at_completion(dut: Any) -> None:
    """After a setting with S = 1, the first ON phase begins when the table is complete, not before
    (P2104-SW-02).
    """
    env = await Env.start(dut)
    for axis, rl in product(env.axes, (9, 200)):
        await axis.command(0xC0)
        await axis.host.init(0x12 | axis.axis_bit, rl, 4, 4)
        since = env.bench.now
        while (await env.host.status()) & axis.cmnd:
            env.check("P2104-SW-02", "phases while the table is built", axis.phases_now, FULL)
        ready = env.bench.now
        off = await env.bench.edge(axis.phases, OFF)
        env.window("P2104-SW-02", "CMND fall to OFF", off - ready, 664 - 20, 664 + 4)
        env.window("P2104-HSK-05", "build", ready - since, 500, 40_000)
