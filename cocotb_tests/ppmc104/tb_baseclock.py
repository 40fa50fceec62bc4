"""Base clocks, external clock and interval lengths (P104-BCK, P104-INT, P104-GEN-02..04, P104-TIM-03).

W is the pulse and set-up time of 5 us in cycles.
"""

from __future__ import annotations

from itertools import chain, repeat

from cocotb_tests.harness import BUSY, F8, F11, F16, F25, F50, F100, Config, directed
from cocotb_tests.harness.config import F16X1

from .env import Env
from .expected_timing import INIT_A, differences, rates

EXTERNAL = (0x1A, 9, 4, 4)


def carried(config: Config, edges: list[int], first: int, rate_list: list[int]) -> list[int]:
    """Return the times of the pulses that external clock edges cause with vsel = L; pulse 1 is on
    edges[first] (P104-INT-03).

    All times include the same constant delay from a pin edge to its effect.
    """
    x = (240 * config.clk_hz // config.xtal_hz + 1) // 2
    h = (272 * config.clk_hz // config.xtal_hz + 1) // 2
    pulses = [edges[first]]
    for r in rate_list:
        a = next(i for i, t in enumerate(edges) if t >= pulses[-1])
        b = a + r + 1
        wait = x - (edges[a] - pulses[-1])
        slow = edges[b] - edges[b - 1] > h
        pulses.append(edges[b] if slow else edges[b] + max(0, wait))
    return pulses


@directed(
    "P104-BCK-01",
    "P104-INT-01",
    "P104-INT-02",
    "P104-GEN-02",
    "P104-GEN-03",
    "P104-GEN-04",
    builds=(F16, F8, F11, F25, F50, F100, F16X1),
)
async def p104_bck_01_internal_clocks(dut):
    """For each core clock, crystal, csel and vsel, every pulse occurs on its quantum tick (P104-BCK-01)."""
    env = await Env.start(dut, INIT_A)
    for csel, vsel in ((1, 1), (0, 1), (1, 0), (0, 0)):
        env.bench.set(csel=csel, vsel=vsel)
        await env.bench.clocks(4)
        for r in (0, 1, 2, 3, 7):
            await env.move(0x44, 4, rate=r)
            env.check_train("P104-BCK-01", [r] * 3, csel, vsel)
            env.check_lows("P104-TIM-05", [r] * 3, csel, vsel)
        await env.move(0x43, 11)
        ramp = rates(INIT_A[1:], [0, 1, 2, 3, 4, 4, 3, 2, 1, 0])
        env.check_train("P104-INT-02", ramp, csel, vsel)


@directed("P104-BCK-02", "P104-BAD-16", "P104-INI-09")
async def p104_bck_02_latched(dut):
    """If csel and vsel change during a motion, only their levels at the start of the motion apply
    (P104-BCK-02).
    """
    env = await Env.start(dut, INIT_A)
    for csel, vsel in ((1, 1), (0, 1), (1, 0), (0, 0)):
        env.bench.set(csel=csel, vsel=vsel)
        await env.bench.clocks(4)
        await env.go(0x43, 9)
        while len(env.pulses) < 9:
            env.bench.set(csel=env.bench.rng.randrange(2), vsel=env.bench.rng.randrange(2))
            await env.bench.clocks(env.bench.rng.randrange(1, 200))
        await env.idle()
        env.check_train("P104-BCK-02", rates(INIT_A[1:], [0, 1, 2, 3, 3, 2, 1, 0]), csel, vsel)


@directed("P104-BCK-03", "P104-GEN-03", "P104-EX-12", builds=(F11, F25, F50))
async def p104_bck_03_cumulative(dut):
    """With a fractional number of cycles per quantum, pulses do not drift, and each interval is accurate to 1
    cycle (P104-BCK-03).
    """
    env = await Env.start(dut, (0x0A, 40, 0, 23))
    await env.move(0x43, 300)
    which = [min(j, 298 - j, 23) for j in range(299)]
    ramp = rates((40, 0, 23), which)
    env.check_train("P104-BCK-03", ramp)
    exact = env.cfg.clk_hz * 32 / env.cfg.xtal_hz
    for got, r in zip(env.intervals, ramp, strict=True):
        env.window(
            "P104-BCK-03", "interval against the fraction", round(abs(got - exact * (r + 1)) * 1000), 0, 1000
        )


@directed("P104-BCK-03")
async def p104_bck_03_phase_restart(dut):
    """For any phase of the free-running quantum at the start, intervals are counted from pulse 1
    (P104-BCK-03).
    """
    env = await Env.start(dut, INIT_A)
    for wait in range(0, 34, 3):
        await env.move(0x44, 3, rate=1)
        env.check_train("P104-BCK-03", [1, 1])
        await env.bench.clocks(wait)


@directed(
    "P104-BCK-04",
    "P104-INT-01",
    "P104-INI-01",
    "P104-TIM-03",
    builds=(F16, F25, F100),
)
async def p104_bck_04_external_edges(dut):
    """With external clocks of any duty cycle and jitter, each pulse follows the clock edge that belongs to it
    (P104-BCK-04).
    """
    env = await Env.start(dut, EXTERNAL)
    rng = env.bench.rng
    delays = set()
    for low, high_time in ((16, 2), (16, 14), (40, 20), (23, 7), (100, 98)):
        gaps = [low] * 400 if low != 23 else [rng.randrange(23, 60) for _ in range(400)]
        clock = env.bench.external_clock(gaps, high=high_time)
        await env.move(0x43, 14)
        clock.cancel()
        await env.bench.align()
        env.bench.set(clock=0)
        edges = [t for t in env.clock_edges(env.since) if t <= env.pulses[-1]]
        first = max(i for i, t in enumerate(edges) if t < env.pulses[0] - 1)
        at, expected = first, [first]
        for r in rates((9, 4, 4), [0, 1, 2, 3, 4, 4, 4, 4, 4, 3, 2, 1, 0]):
            at += r + 1
            expected.append(at)
        delays |= {pulse - edges[i] for pulse, i in zip(env.pulses, expected, strict=True)}
        await env.bench.clocks(20)
    env.check("P104-BCK-04", "different delays from edge to pulse", len(delays), 1)
    env.window("P104-BCK-04", "delay from edge to pulse", min(delays), 2, 5)


@directed(
    "P104-BCK-05",
    "P104-BAD-14",
    uncompared="P104-BCK-05 lets intervals of less than 16 cycles grow by whole periods",
    exact="the period of the clock must be sampled unchanged",
)
async def p104_bck_05_too_fast_clock(dut):
    """With an external clock period of 4 to 15 cycles at rate 0, count, phases and results are correct, and
    no interval is too short (P104-BCK-05).
    """
    env = await Env.start(dut, (0x1A, 3, 0, 4))
    for period in (4, 5, 7, 9, 12, 15):
        clock = env.bench.external_clock(repeat(period), high=2)
        for code, rate in ((0x44, 0), (0x43, None), (0xC3, None)):
            before = env.bench.level("s")
            await env.move(code, 25, rate)
            env.check("P104-BCK-05", f"pulses at {period} cycles", len(env.pulses), 25)
            env.check("P104-BCK-05", "shortest interval", min(env.intervals) >= period, True)
            env.check("P104-BCK-05", "intervals are whole periods", {i % period for i in env.intervals}, {0})
            turns = 25 if code != 0xC3 else 0
            table = [0b00011, 0b00110, 0b01100, 0b01001]
            expected = table[(table.index(before) + turns) % 4]
            env.check("P104-BCK-05", "s", env.bench.level("s"), expected)
            await env.result("P104-BCK-05", 25, 0x80 | code & 7, 0)
        await env.go(0x46)
        await env.pulse(30)
        env.bench.set(l1_n=0)
        await env.idle()
        count = len(env.pulses)
        env.check("P104-BCK-05", "finish status", await env.finish(), 0x96)
        env.check("P104-BCK-05", "pulses and rest", await env.remaining(), (1 << 24) - count - 1)
        env.bench.set(l1_n=1)
        clock.cancel()
        await env.bench.align()
        env.bench.set(clock=0)
        await env.bench.clocks(8)


@directed("P104-INT-03", "P104-INT-04", builds=(F16, F25))
async def p104_int_03_vsel_low_external(dut):
    """With vsel = L and a constant or changing external clock, each pulse occurs at the time in
    P104-INT-03.
    """
    env = await Env.start(dut, EXTERNAL, vsel=0)
    rng = env.bench.rng
    us = env.cfg.us
    steady = [us(x) for x in (1.5, 2.5, 4, 7, 7.5, 7.75, 8, 8.375, 8.75, 9, 12)]
    trains = [[period] * 400 for period in steady]
    trains.append([rng.randrange(us(2), us(14)) for _ in range(400)])
    trains.append([us(8.5) + rng.randrange(-3, 4) for _ in range(400)])
    trains.append(list(chain.from_iterable([us(3)] * 5 + [us(11)] * 2 for _ in range(60))))
    for gaps in trains:
        for code, n, rate_list in (
            (0x44, 9, [3] * 8),
            (0x43, 8, rates((9, 4, 4), [0, 1, 2, 3, 2, 1, 0])),
            (0x44, 7, [0] * 6),
        ):
            clock = env.bench.external_clock(gaps, high=8)
            await env.go(code, n, rate_list[0] if code == 0x44 else None)
            await env.pulse(n, 300)
            clock.cancel()
            await env.bench.align()
            env.bench.set(clock=0)
            await env.idle()
            edges = env.clock_edges(env.since)
            first = max(i for i, t in enumerate(edges) if t < env.pulses[0] - 1)
            delay = env.pulses[0] - edges[first]
            got = [t - delay for t in env.pulses]
            expected = carried(env.cfg, edges, first, rate_list)
            same = f"pulses at {gaps[:3]} cycles, {code:#x}"
            env.check("P104-INT-03", same, differences(got), differences(expected))
            await env.bench.clocks(20)


@directed("P104-INT-04", "P104-EX-08", builds=(F16, F100))
async def p104_int_04_steady_consequences(dut):
    """With vsel = L, constant external periods up to 7.5 us add 7.5 us to an interval; periods of 9 us or
    more add nothing (P104-INT-04).
    """
    env = await Env.start(dut, EXTERNAL, vsel=0)
    us = env.cfg.us
    for micros in (2, 4, 7.5, 8, 9, 10):
        period = us(micros)
        clock = env.bench.external_clock(repeat(period), high=period // 2)
        await env.move(0x44, 6, rate=9)
        clock.cancel()
        await env.bench.align()
        env.bench.set(clock=0)
        expected = 10 * period + (us(7.5) if micros <= 8 else 0)
        for interval in env.intervals:
            more = us(0.5) if micros == 8 else 0
            env.window("P104-INT-04", f"interval at {micros} us", interval, expected - 2, expected + 2 + more)
        await env.bench.clocks(20)


@directed("P104-INT-05", "P104-BAD-17", "P104-TIM-05", builds=(F16, F11, F100))
async def p104_int_05_no_speed_limit(dut):
    """With RH = 0, every interval of a ramp is exact at the maximum speed, and commands are executed during
    it (P104-INT-05).
    """
    env = await Env.start(dut, (0x0A, 7, 0, 9))
    await env.go(0x43, 200)
    await env.pulse(60)
    env.check("P104-INT-05", "0x86 at top speed", await env.host.command(0x86), 0x14)
    env.check("P104-INT-05", "its data", await env.host.data(0x0F), BUSY)
    await env.idle()
    ramp = rates((7, 0, 9), [min(j, 198 - j, 9) for j in range(199)])
    env.check_train("P104-INT-05", ramp)
    env.check_lows("P104-TIM-05", ramp)


@directed("P104-TIM-03", "P104-BAD-13", "P104-LIM-03", "P104-LIM-05", "P104-LIM-06", "P104-FDC-03")
async def p104_tim_03_waiting_for_the_clock(dut):
    """Without an external clock, operations wait in START, and all stop causes take effect (P104-TIM-03)."""
    env = await Env.start(dut, EXTERNAL)
    causes = {"l1_n": 0x90, "alm_n": 0xA0, "cnp_n": 0x80}
    for code, rate in ((0x44, 9), (0x45, 9), (0x47, 9), (0x43, None), (0x46, None)):
        n = 10 if code in (0x43, 0x44) else None
        rest = 9 if n else (1 << 24) - 1
        for pin, bits in causes.items():
            await env.go(code, n, rate)
            await env.bench.clocks(700)
            env.check("P104-TIM-03", "BUSY without edges", await env.host.status(), BUSY)
            ends = pin != "cnp_n" or code == 0x47
            env.bench.set(**{pin: 0})
            await env.bench.clocks(20)
            env.check(
                "P104-BAD-13", f"BUSY of {code:#x}, {pin}", await env.host.status(), 0 if ends else BUSY
            )
            if not ends:
                await env.host.command(0x40)
                bits = 0xC0
            env.bench.set(**{pin: 1})
            await env.result("P104-TIM-03", 0, bits | code & 7, rest)
            bits = causes[pin]
        await env.go(code, n, rate)
        await env.host.command(0x41)
        if code & 7 in (3, 6):
            await env.bench.clocks(700)
            env.check("P104-BAD-13", "0x41 waits for an edge", await env.host.status(), BUSY)
            await env.ticks(2, 100)
            await env.result("P104-FDC-03", 1, 0xC0 | code & 7, rest - 1)
        else:
            await env.result("P104-BAD-13", 0, 0xC0 | code & 7, rest)


@directed("P104-TIM-03", "P104-BCK-04", builds=(F16, F100))
async def p104_tim_03_first_edge(dut):
    """The first external edge at least W after the start causes pulse 1 (P104-TIM-03)."""
    env = await Env.start(dut, EXTERNAL)
    w = env.cfg.w
    for offset in (-20, -8, 0, 8, 20):
        await env.host.send(0x44, [9, 1, 0])
        env.since = env.bench.now
        await env.host.write(0, 0)
        fell = await env.bench.edge("hold", 0) if env.bench.level("hold") else env.bench.falls("hold")[-1]
        # An edge driven at t takes effect 2 to 3 cycles later; the pins follow 1 cycle after that.
        at = fell + w - 3 + offset
        await env.bench.until(at)
        await env.ticks(1, 4)
        await env.bench.clocks(40)
        expected = 0 if offset < -2 else 1
        if abs(offset) > 2:
            env.check("P104-TIM-03", f"pulses, edge at W {offset:+d}", len(env.pulses), expected)
        if not env.pulses:
            await env.ticks(1, 40)
        env.check("P104-TIM-03", "pulses after the next edge", len(env.pulses), 1)
        await env.host.command(0x40)
        await env.result("P104-TIM-03", 1, 0xC4, 0)
        await env.bench.clocks(env.cfg.us(34_100) if offset == 99 else 10)
        await env.bench.reset()
        await env.bench.clocks(8)
        await env.init(*EXTERNAL)


@directed("P104-BCK-04", "P104-BAD-13")
async def p104_bck_04_clock_stops_and_resumes(dut):
    """If the external clock stops for 50 us within an interval, no edge is missed or added when it continues
    (P104-BCK-04).
    """
    env = await Env.start(dut, EXTERNAL)
    for stop_after in (3, 12, 20, 21):
        gaps = [32] * stop_after + [800] + [32] * 200
        await env.go(0x44, 5, rate=9)
        await env.bench.clocks(100)
        clock = env.bench.external_clock(gaps, high=16)
        await env.idle()
        clock.cancel()
        await env.bench.align()
        env.bench.set(clock=0)
        edges = env.clock_edges(env.since)
        got = [t - edges[0] for t in env.pulses]
        expected = [edges[10 * j] - edges[0] + got[0] for j in range(5)]
        env.check("P104-BCK-04", f"pulses, stop after edge {stop_after}", got, expected)
        await env.finish()
        await env.bench.clocks(8)
