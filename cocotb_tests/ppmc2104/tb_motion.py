"""Operations, starts, base clocks (P2104-OPR, P2104-TIM, P2104-BCK, P2104-INTV).

W is the pulse and set-up time of 5 us in cycles.
"""

from __future__ import annotations

from itertools import product, repeat
from typing import Any

from cocotb_tests.harness import F8, F11, F16, F48, F100, directed
from cocotb_tests.harness.axis_driver import NO_PULSES_DONE, indices, rates
from cocotb_tests.harness.checks import check_intervals
from cocotb_tests.harness.config import F16X8

from .env import Env
from .expected_timing import ERROR, INIT_A, INIT_EXT

CLOCKS = (F8, F11, F16, F16X8, F48, F100)


@directed("P2104-OPR-01", "P2104-TIM-01", "P2104-TIM-06", "P2104-SW-03", "P2104-STA-04", builds=CLOCKS)
async def p2104_tim_01_starts(dut: Any) -> None:
    """For each operation that is accepted with run high, pulse 1 follows hold and dir by W to W + 2 cycles
    (P2104-TIM-01).
    """
    env = await Env.start(dut)
    w = env.cfg.w
    for axis in await env.both(INIT_A):
        await axis.send(0x85, [0])
        turned = 0
        for code, n, rate in (
            (0x42, None, None),
            (0x4B, 4, None),
            (0x44, 3, 20),
            (0x4D, None, 20),
            (0xC6, None, None),
        ):
            await axis.go(code, n, rate)
            first = await axis.pulse(1)
            (fall, _), *_ = axis.edges("hold")
            env.window("P2104-TIM-01", f"hold to pulse 1, {code:#x}", first - fall, w, w + 2)
            dirs = axis.edges("dir")
            env.check(
                "P2104-OPR-01",
                f"dir edges, {code:#x}",
                dirs,
                [(fall, code >> 3 & 1)] * (turned != code >> 3 & 1),
            )
            turned = code >> 3 & 1
            if n is None and code != 0x42:
                await axis.pulse(2, 2)
                await axis.command(0x40)
            await axis.idle()
            await env.bench.level_is(axis.pin("hold"), 1)
            env.check(
                "P2104-TIM-06",
                "pout_n and dir at rest",
                (axis.level("pout_n"), axis.level("dir")),
                (1, turned),
            )
            await axis.finish()


@directed("P2104-OPR-02", "P2104-TIM-02", "P2104-BAD-21", builds=(F16, F11, F100))
async def p2104_tim_02_run(dut: Any) -> None:
    """In RUN wait, pulse 1 occurs W to W + 6 cycles after run rises, even if run is high for only 2 cycles
    (P2104-TIM-02).
    """
    env = await Env.start(dut)
    w = env.cfg.w
    for axis, (code, n, rate) in product(
        await env.both(INIT_A), ((0x42, None, None), (0x43, 3, None), (0x44, 3, 20))
    ):
        for width in (2, 3, 1_000):
            axis.set(run=0)
            await axis.go(code, n, rate)
            await env.bench.clocks(37)
            rise = axis.set(run=1)
            await env.bench.clocks(width)
            axis.set(run=0)
            first = await axis.pulse(1)
            env.window("P2104-TIM-02", f"run to pulse 1, {code:#x}, {width} cycles", first - rise, w, w + 6)
            await axis.result("P2104-OPR-02", n or 1, 0x80 | code & 7, 0)
        axis.set(run=1)
    # If run falls in any cycle near the acceptance, the axis is either in RUN wait or in START, and no other
    # result occurs.
    axis = env.x1
    for lead in range(-2, 12):
        axis.set(run=1)
        await env.bench.clocks(6)
        await env.host.write(1, 0x43)
        for byte in (2, 0):
            await env.bench.clocks(10)
            await env.host.write(0, byte)
        await env.bench.clocks(10)
        axis.since = env.bench.now
        axis.at(env.bench.now + lead + 2, run=0)
        await env.host.write(0, 0)
        await env.bench.clocks(w + 40)
        env.check("P2104-OPR-02", f"BUSY, run falls {lead}", await env.host.status() & axis.busy, axis.busy)
        started = bool(axis.pulses)
        if not started:
            axis.set(run=1)
        await axis.result("P2104-OPR-02", 3, 0x83, 0)
        if lead in (-2, 11):
            env.check("P2104-OPR-02", f"started, run falls {lead}", started, lead == 11)


@directed("P2104-TIM-02", "P2104-OPR-10", builds=(F11, F48))
async def p2104_tim_02_one_edge_for_both(dut: Any) -> None:
    """If both axes are in RUN wait and both run pins rise together, at any phase of the quantum, pulse 1 of
    both axes occurs on the same edge (P2104-TIM-02).
    """
    env = await Env.start(dut)
    first, second = await env.both(INIT_A)
    for shift in range(5):
        env.bench.set(run=0)
        await first.go(0x43, 9)
        await second.go(0x44, 5, 3)
        await env.bench.clocks(30 + shift)
        env.bench.set(run=3)
        await first.idle()
        await second.idle()
        env.check("P2104-TIM-02", "first pulses", first.pulses[0], second.pulses[0])
        first.check_train("P2104-BCK-05", rates(INIT_A[1:], indices(9, 4)))
        second.check_train("P2104-BCK-05", [3] * 4)


@directed("P2104-BCK-01", "P2104-BCK-03", "P2104-INTV-01", "P2104-TIM-05", "P2104-GEN-04", builds=CLOCKS)
async def p2104_bck_01_intervals(dut: Any) -> None:
    """For each core clock, crystal and csel, the time of every pulse is the sum of the exact intervals before
    it (P2104-BCK-01, P2104-INTV-01).
    """
    env = await Env.start(dut)
    for axis, csel in product(await env.both((0x02, 30, 3, 9)), (1, 0)):
        axis.set(csel=csel)
        await env.bench.clocks(4)
        for rate in (1, 2, 3, 6, 10):
            await axis.move(0x44, 5, rate)
            axis.check_train("P2104-INTV-01", [rate] * 4, csel)
            if env.cfg in (F8, F16, F16X8, F48):
                axis.check_lows("P2104-TIM-05", [rate] * 4, csel)
            half = env.cfg.quanta(4 * (rate + 1)) if csel and rate < 3 else env.cfg.w
            for low in axis.low_times[:-1]:
                env.window("P2104-TIM-05", f"low time at rate {rate}", low, half - 1, half + 1)
        await axis.move(0x43, 22)
        axis.check_train("P2104-BCK-03", rates((30, 3, 9), indices(22, 9)), csel)
        env.check("P2104-TIM-05", "low times", set(axis.low_times), {env.cfg.w})


@directed("P2104-BCK-02", "P2104-BAD-20", "P2104-BCK-05", "P2104-LIM-08")
async def p2104_bck_02_csel_latched(dut: Any) -> None:
    """If csel changes during motions of both axes, only the level of the axis's own pin at the start applies
    (P2104-BCK-02).
    """
    env = await Env.start(dut)
    first, second = await env.both(INIT_A)
    for one, two in product((0, 1), (0, 1)):
        first.set(csel=one)
        second.set(csel=two)
        await env.bench.clocks(4)
        await first.go(0x43, 9)
        await second.go(0x43, 9)
        for _ in range(40):
            await env.bench.clocks(env.bench.rng.randrange(5, 60))
            env.bench.set(csel=env.bench.rng.randrange(4))
        await first.idle()
        await second.idle()
        first.check_train("P2104-BCK-02", rates(INIT_A[1:], indices(9, 4)), one)
        second.check_train("P2104-BCK-02", rates(INIT_A[1:], indices(9, 4)), two)


@directed(
    "P2104-BCK-04",
    "P2104-BCK-05",
    "P2104-TIM-03",
    "P2104-TIM-05",
    "P2104-GEN-07",
    builds=(F16, F11, F100),
)
async def p2104_bck_04_external_by_hand(dut: Any) -> None:
    """With separate external clocks, each pulse of each axis follows an edge of the clock of this axis
    (P2104-BCK-04, P2104-BCK-05).
    """
    env = await Env.start(dut)
    first, second = await env.both((0x0A, 5, 2, 4))
    for axis, other in ((first, second), (second, first)):
        for n, rate, period in ((4, 3, 24), (4, 1, 30), (6, None, 18)):
            await axis.go(0x44 if rate is not None else 0x43, n, rate)
            await env.bench.clocks(env.cfg.w + 20)
            await other.ticks(5)
            env.check("P2104-BCK-05", "pulses by edges of the other clock", axis.pulses, [])
            begin = env.bench.now
            expected = [rate] * (n - 1) if rate is not None else rates((5, 2, 4), indices(n, 4))
            await axis.ticks(sum(r + 1 for r in expected) + 1, period)
            edges = axis.clock_edges(begin)
            places, place = [0], 0
            for r in expected:
                place += r + 1
                places.append(place)
            env.check("P2104-BCK-04", "number of pulses", len(axis.pulses), n)
            delays = {t - edges[i] for t, i in zip(axis.pulses, places, strict=True)}
            env.check("P2104-BCK-04", "one delay of all pulses", len(delays), 1)
            env.window("P2104-BCK-04", "edge to pulse", delays.pop(), 2, 5)
            await axis.result("P2104-BCK-04", n, 0x84 if rate is not None else 0x83, 0)


@directed("P2104-TIM-05", "P2104-BCK-04", "P2104-BAD-19")
async def p2104_tim_05_external_low_times(dut: Any) -> None:
    """With fast external clocks and small rates, low times are shortened as the rule states
    (P2104-TIM-05).
    """
    env = await Env.start(dut)
    axis = env.x2
    await axis.init(*INIT_EXT)
    for period, high, rate, low in (
        (16, 8, 0, 8),
        (60, 20, 0, 20),
        (160, 60, 0, 80),
        (16, 8, 1, 16),
        (16, 8, 3, 32),
        (16, 8, 4, 32),
        (40, 20, 3, 80),
        (40, 20, 2, 40),
        (16, 8, 12, 80),
    ):
        clock = env.bench.external_clock(repeat(period), axis.clock, high=high)
        await env.bench.clocks(4 * period)
        await axis.move(0x44, 6, rate)
        check_intervals(axis.bench, "P2104-BCK-04", axis.intervals, [period * (rate + 1)] * 5)
        for got in axis.low_times[1:-1]:
            env.window("P2104-TIM-05", f"low time, {period} cycles, rate {rate}", got, low - 1, low + 1)
        env.check("P2104-TIM-05", "last low time", axis.low_times[-1], env.cfg.w)
        clock.cancel()
        await axis.finish()
        env.bench.set(**{axis.clock: 0})
        await env.bench.clocks(period)


@directed(
    "P2104-BAD-19",
    "P2104-BCK-04",
    "P2104-END-06",
    uncompared="P2104-BAD-19: edges of a clock that is too fast are missed",
)
async def p2104_bad_19_clock_too_fast(dut: Any) -> None:
    """With an external period of 4 cycles or less, counts and reads are correct (P2104-BAD-19).

    The test is not compared with the model, because the number of missed edges is not specified.
    """
    env = await Env.start(dut)
    axis = env.x1
    await axis.init(*INIT_EXT)
    for period, high in ((4, 2), (3, 1), (2, 1)):
        clock = env.bench.external_clock(repeat(period), axis.clock, high=high)
        for code, n, rate in ((0x44, 40, 0), (0x43, 60, None), (0xC3, 13, None)):
            await axis.go(code, n, rate)
            await axis.result(f"P2104-BAD-19, {period} cycles", n, 0x80 | code & 7, 0)
        await axis.go(0x45, rate=0)
        await axis.pulse(5)
        await axis.command(0x40)
        await axis.idle()
        env.check("P2104-BAD-19", "remaining", await axis.remaining(), NO_PULSES_DONE - len(axis.pulses) - 1)
        clock.cancel()
        env.bench.set(**{axis.clock: 0})
        await axis.finish()


@directed("P2104-BAD-18", "P2104-TIM-03", "P2104-OPR-04", "P2104-OPR-10")
async def p2104_bad_18_clock_stopped(dut: Any) -> None:
    """Without an external clock, a started axis waits; a stop or a switch ends the operation
    (P2104-BAD-18).
    """
    env = await Env.start(dut)
    first, second = env.axes
    await first.init(*INIT_EXT)
    await second.init(*INIT_A)
    for code, cause, finish in (
        (0x43, "", 0xC3),
        (0x44, "fl_n", 0x94),
        (0x4C, "bl_n", 0x94),
        (0x45, "alm_n", 0xA5),
        (0x47, "org_n", 0x87),
    ):
        for pulses in (0, 2):
            n = 100 if code & 7 in (3, 4) else None
            await first.go(code, n, 1 if code != 0x43 else None)
            await first.tick_until(pulses)
            await second.move(0x43, 12)
            second.check_train("P2104-OPR-10", rates(INIT_A[1:], indices(12, 4)))
            env.check("P2104-BAD-18", "it waits", len(first.pulses), pulses)
            if cause:
                first.set(**{cause: 0})
            else:
                await first.command(0x40)
            await first.result("P2104-BAD-18", pulses, finish, (n or NO_PULSES_DONE) - pulses - 1)
            if cause:
                first.set(**{cause: 1})
            await second.finish()
    # A deceleration stop sets the deceleration flag, which takes effect with the next edges; at RL the stop
    # ends the motion immediately.
    await first.go(0x43, 100)
    await first.tick_until(3)
    await first.command(0x41)
    await first.refused("P2104-BAD-18", "a second 41", 8, 0x41)
    await first.tick_until(6)
    await first.result("P2104-BAD-18", 6, 0xC3, 93)
    await first.go(0x43, 100)
    await first.tick_until(1)
    await first.command(0x41)
    await first.result("P2104-BAD-18", 1, 0xC3, 98)
    await first.go(0x42)
    await first.result("P2104-OPR-04", 1, 0x82, 0)


@directed("P2104-OPR-03", "P2104-OPR-05", "P2104-OPR-06", "P2104-RD-06", "P2104-END-06", "P2104-EX-10")
async def p2104_opr_03_pulse_counts(dut: Any) -> None:
    """If an operation of N pulses is stopped after three pulses, the number of remaining pulses is that for
    this N (P2104-OPR-03).
    """
    env = await Env.start(dut)
    for axis in await env.both(INIT_A):
        for code, data, total in (
            (0x43, [0, 0, 0], 1),
            (0x43, [0xFF, 0xFF, 0xFF], 1 << 24),
            (0x43, [0, 0, 0x80], (1 << 23) + 1),
            (0x44, [20, 0x00, 0x01, 0x00], 257),
            (0x44, [20, 0xFF, 0xFF, 0xFF], 1 << 24),
            (0x45, [20], 1 << 24),
            (0x46, [], 1 << 24),
            (0x47, [20], 1 << 24),
            (0xC3, [3, 2, 1], 0x010204),
            (0xC6, [], 1 << 24),
        ):
            axis.since = env.bench.now
            await axis.send(code, data)
            if total == 1:
                await axis.result("P2104-OPR-03", 1, 0x83, 0)
                continue
            await axis.pulse(3, 20)
            await axis.command(0x40)
            await axis.result(f"P2104-OPR-03 {code:#x}", 3, 0xC0 | code & 7, total - 4)


@directed("P2104-OPR-07", "P2104-ERR-05", "P2104-INTV-01")
async def p2104_opr_07_rate_bytes(dut: Any) -> None:
    """Rate 00 is accepted only with the external clock, rate FF with both clocks (P2104-OPR-07)."""
    env = await Env.start(dut)
    axis = await env.ready(2, INIT_A)
    for code, data in ((0x44, [0, 2, 0, 0]), (0x45, [0]), (0x47, [0])):
        since = env.bench.now
        await axis.refused("P2104-OPR-07", f"{code:#x} 00", 9, code, *data)
        env.quiet("P2104-ERR-03", since)
    await axis.move(0x44, 3, 255)
    env.check("P2104-OPR-07", "intervals at FF", axis.intervals, [8_192] * 2)
    await axis.command(0xC0)
    await axis.init(*INIT_EXT)
    for code, n in ((0x44, 3), (0x45, None), (0x47, None)):
        await axis.go(code, n, 0)
        await axis.tick_until(3)
        if n is None:
            await axis.command(0x40)
        await axis.result("P2104-OPR-07", 3, (0x80 if n else 0xC0) | code & 7, 0 if n else (1 << 24) - 4)
    env.check("P2104-OPR-07", "ERROR", await env.host.status() & ERROR, 0)


@directed("P2104-OPR-10", "P2104-BCK-05", "P2104-INT-01", builds=(F16, F11))
async def p2104_opr_10_independent_axes(dut: Any) -> None:
    """No activity of one axis disturbs a long ramp of the other axis (P2104-OPR-10)."""
    env = await Env.start(dut)
    for axis, other in (env.axes, env.axes[::-1]):
        await axis.init(0x02, 40, 3, 20)
        await other.init(0x1E, *INIT_A[1:])
        await axis.go(0x53, 200)
        await axis.pulse(1, 3)
        await other.go(0x47, rate=0)
        await other.ticks(40, 9)
        other.set(org_n=0, alm_n=0, fl_n=0, bl_n=0, fhl_n=0, bhl_n=0, csel=0, run=0)
        await other.idle()
        await other.refused("P2104-OPR-10", "a start on ALM", 7, 0x42)
        await other.send(0x84, [0x40, 0x40])
        await other.send(0x85, [0])
        other.set(org_n=1, alm_n=1, fl_n=1, bl_n=1, fhl_n=1, bhl_n=1, csel=1, run=1)
        await env.bench.clocks(100)
        await other.move(0x5A)
        await other.command(0xC0)
        await other.init(0x03, *INIT_A[1:])
        await axis.idle()
        axis.check_train("P2104-OPR-10", rates((40, 3, 20), indices(200, 20)))
        steps = [t for t, _ in env.bench.edges(axis.phases, axis.since)]
        env.check("P2104-OPR-10", "steps", steps, axis.pulses)
        await axis.result("P2104-OPR-10", 200, 0x83, 0)
        await axis.command(0xC0)
        await other.finish()
        await other.command(0xC0)
