"""The start, the pulse shape and the end of a motion (P104-TIM, P104-END).

W is the pulse and set-up time of 5 us in cycles.
"""

from __future__ import annotations

from cocotb_tests.harness import BUSY, F8, F11, F16, F25, F50, F100, IBF, directed

from .env import C_EVENT_LATEST, PINS_LATEST, Env
from .expected_timing import INIT_A, INIT_B

ALL = 1 << 24
OPERATIONS = ((0x42, None, None), (0x43, 6, None), (0x44, 6, 9), (0x45, None, 9), (0x46, None, None))
OPERATIONS += ((0x47, None, 9), (0xC3, 6, None), (0xC6, None, None))


@directed(
    "P104-TIM-01",
    "P104-TIM-02",
    "P104-TIM-04",
    "P104-GEN-03",
    "P104-OPR-01",
    "P104-DS-09",
    builds=(F16, F8, F11, F25, F50, F100),
)
async def p104_tim_02_start(dut):
    """At the CCW start of each operation, hold and dir change together; pulse 1 and s follow W to W + 2
    cycles later (P104-TIM-02).
    """
    env = await Env.start(dut, INIT_A)
    w = env.cfg.w
    for code, n, rate in OPERATIONS:
        await env.bench.reset()
        await env.bench.clocks(6)
        await env.init(*INIT_A)
        since = env.bench.now
        edge0 = await env.go(code | 8, n, rate, poll=False)
        status = await env.host.poll(IBF, 0)
        env.check("P104-OPR-01", "status at the start", status, BUSY)
        first = await env.pulse(1)
        fell = env.bench.falls("hold", since)[0]
        env.check("P104-OPR-01", "dir moves with hold", env.bench.edges("dir", since), [(fell, 1)])
        env.window("P104-TIM-01", "edge 0 to hold", fell - edge0, 2, PINS_LATEST)
        env.window("P104-TIM-02", f"hold to pulse 1 of {code:#x}", first - fell, w, w + 2)
        moves = [t for t, _ in env.bench.edges("s", fell)]
        env.check("P104-TIM-04", "edges of s", moves, [] if code >= 0xC0 else [first])


@directed("P104-TIM-05", "P104-TIM-04", builds=(F16, F25))
async def p104_tim_05_external_low_times(dut):
    """With external clocks and vsel = H, low times at rates 0 to 9 are W or end at the clock edge in
    P104-TIM-05.
    """
    env = await Env.start(dut, (0x1A, 9, 4, 4))
    w, us, slack = env.cfg.w, env.cfg.us, env.bench.slack
    for period in (us(1), us(2), us(4), us(7.5), us(8.5), us(20)):
        for high in (period // 4, period // 2, 3 * period // 4):
            for rate in (0, 1, 2, 3, 6, 9):
                clock = env.bench.external_clock([period] * 300, high=high)
                await env.move(0x44, 5, rate)
                clock.cancel()
                await env.bench.align()
                env.bench.set(clock=0)
                cut = (rate + 1) // 2 * period if rate else (high if period < us(8) else w)
                what = f"low time at {period}/{high} cycles, rate {rate}"
                *lows, last = env.bench.low_times(env.since)
                env.check("P104-TIM-05", f"number of pulses and last {what}", (len(lows), last), (4, w))
                for low in lows:
                    env.window("P104-TIM-05", what, low, min(w, cut - slack), min(w, cut + slack))
                await env.bench.clocks(8)


@directed("P104-TIM-05", "P104-INT-03", builds=(F16, F25))
async def p104_tim_05_vsel_low(dut):
    """With vsel = L, each low time is W, for any rate and clock (P104-TIM-05)."""
    env = await Env.start(dut, (0x1A, 9, 4, 4), vsel=0)
    for period in (env.cfg.us(1), env.cfg.us(4), env.cfg.us(12)):
        for rate in (0, 1, 3):
            clock = env.bench.external_clock([period] * 300, high=period // 2)
            await env.move(0x44, 5, rate)
            clock.cancel()
            await env.bench.align()
            env.bench.set(clock=0)
            env.check(
                "P104-TIM-05", "low times", env.bench.low_times(env.since), [env.cfg.w] * len(env.pulses)
            )
            await env.bench.clocks(8)
    await env.init(*INIT_A)
    for rate in (0, 1, 2, 3):
        await env.move(0x44, 5, rate)
        env.check("P104-TIM-05", "low times, internal", env.bench.low_times(env.since), [env.cfg.w] * 5)


@directed("P104-TIM-05", "P104-END-02", "P104-LIM-03", builds=(F16, F11))
async def p104_tim_05_end_in_the_low_time(dut):
    """A limit in any cycle of a low time, long or shortened, does not change the length of the low time
    (P104-TIM-05).
    """
    env = await Env.start(dut, INIT_A)
    for rate in (0, 1, 2, 9):
        expected = env.cfg.cyc(16 * (rate + 1)) if rate <= 2 else env.cfg.w
        step = 1 if rate == 0 else 7
        for delay in range(1, expected, step):
            await env.go(0x44, 30, rate)
            await env.pulse(3, delay)
            hit = env.bench.set(l1_n=0)
            end = await env.wait_end()
            await env.idle()
            rise = env.bench.rises("pout_n", env.since)[-1]
            count = len(env.pulses)
            env.window("P104-END-02", "end after the rise or the limit", end - max(rise, hit), 0, 8)
            lows = env.bench.low_times(env.since)
            env.check("P104-TIM-05", f"low times at rate {rate}, limit at +{delay}", lows, [expected] * count)
            env.window("P104-END-02", "pulses", count, 3, 3 if delay < expected - 8 else 4)
            env.bench.set(l1_n=1)
            await env.result("P104-END-02", count, 0x94, 30 - count - 1)


@directed("P104-TIM-05", "P104-END-03", "P104-FDC-02")
async def p104_tim_05_last_pulse_of_a_deceleration(dut):
    """If even the start-up rate is fast (RL = 1), the last low time of a forced deceleration is W
    (P104-TIM-05).
    """
    env = await Env.start(dut, (0x0A, 1, 0, 6))
    for j in (2, 5, 9):
        await env.go(0x43, 200)
        await env.pulse(j)
        await env.host.command(0x41)
        end = await env.wait_end()
        await env.idle()
        lows = env.bench.low_times(env.since)
        env.check("P104-TIM-05", "last low time", lows[-1], env.cfg.w)
        env.check("P104-TIM-05", "longest of the others", max(lows[:-1]) <= 32, True)
        env.window("P104-END-03", "end after the last rise", end - env.bench.rises("pout_n")[-1], 0, 4)
        await env.result("P104-END-03", len(lows), 0xC3, 200 - len(lows) - 1)


@directed("P104-TIM-06", "P104-PHS-07", "P104-STP-01")
async def p104_tim_06_dir(dut):
    """Only the start of a move changes dir; stops and rejected commands do not (P104-TIM-06)."""
    env = await Env.start(dut, INIT_B)
    levels, starts = [], []
    for bit in (1, 0, 1, 1, 0):
        for base, n, rate in ((0x43, 40, None), (0x45, None, 9)):
            since = env.bench.now
            await env.go(base | bit << 3, n, rate)
            await env.pulse(4, 100)
            await env.statuses("c 42 c 4A c 0A")
            await env.host.command(0x41)
            await env.idle()
            starts += env.bench.falls("hold", since)
            levels.append(env.bench.level("dir"))
            await env.bench.clocks(300)
    env.check("P104-TIM-06", "levels", levels, [1, 1, 0, 0, 1, 1, 1, 1, 0, 0])
    env.check("P104-PHS-07", "edges of dir", [v for _, v in env.bench.edges("dir")], [1, 0, 1, 0])
    env.check("P104-PHS-07", "first edge is at a start", env.bench.edges("dir")[0][0], starts[0])


@directed("P104-END-01", "P104-TIM-05", "P104-RD-07", builds=(F16, F25, F100))
async def p104_end_01_normal_end(dut):
    """At the end of each counted move, BUSY, INT, finish status and remaining count change at most 4 cycles
    after the last rise of pout_n (P104-END-01).
    """
    env = await Env.start(dut, INIT_A)
    for code, n, rate in ((0x42, None, None), (0x43, 9, None), (0x44, 3, 0), (0x44, 3, 30), (0xC3, 9, None)):
        await env.go(code, n, rate)
        end = await env.wait_end()
        status = await env.host.status()
        env.check("P104-END-01", "BUSY after INT", status & BUSY, 0)
        lows = env.bench.low_times(env.since)
        env.check("P104-END-01", "pulses at the end", len(lows), n or 1)
        env.check("P104-TIM-05", "last low time", lows[-1], env.cfg.w)
        env.window("P104-END-01", "end after the rise", end - env.bench.rises("pout_n")[-1], 0, 4)
        await env.result("P104-END-01", n or 1, 0x80 | code & 7, 0)


@directed("P104-END-01", "P104-END-05", "P104-LIM-01", "P104-LIM-09")
async def p104_end_05_too_late(dut):
    """Causes of an end that occur after pulse event N have no effect (P104-END-05)."""
    env = await Env.start(dut, INIT_A)
    for pin in ("l1_n", "l3_n", "alm_n", "cnp_n"):
        for delay in (2, 30, 76):
            for code, n, rate in ((0x43, 3, None), (0x44, 3, 4), (0x42, None, None)):
                await env.go(code, n, rate)
                await env.pulse(n or 1, delay)
                env.bench.set(**{pin: 0})
                await env.idle()
                env.bench.set(**{pin: 1})
                await env.result("P104-END-05", n or 1, 0x80 | code & 7, 0)


@directed("P104-END-02", "P104-LIM-01", "P104-LIM-03", "P104-LIM-05", "P104-LIM-06", builds=(F16, F100))
async def p104_end_02_reaction_time(dut):
    """A limit, an alarm or the origin ends the motion within 8 cycles if pout_n is high, and otherwise within
    4 cycles of the rise of pout_n (P104-END-02).
    """
    env = await Env.start(dut, INIT_A)
    w = env.cfg.w
    for pin, bits in (("l1_n", 0x97), ("alm_n", 0xA7), ("cnp_n", 0x87)):
        for delay in (5, w - 10, w + 30):
            await env.go(0x47, None, 9)
            await env.pulse(2, delay)
            hit = env.bench.set(**{pin: 0})
            end = await env.wait_end()
            rise = env.bench.rises("pout_n")[-1]
            if delay > w:
                env.window("P104-END-02", f"{pin} to the end", end - hit, 0, 8)
            else:
                env.window("P104-END-02", "rise to the end", end - rise, 0, 4)
            env.check("P104-END-02", "BUSY", await env.host.status() & BUSY, 0)
            env.bench.set(**{pin: 1})
            await env.result("P104-END-02", 2, bits, ALL - 3)


@directed("P104-END-04", "P104-LIM-09", "P104-BAD-15", exact="the switches must be sampled at the same edge")
async def p104_end_04_cause_bits(dut):
    """If several causes apply at the end of a move or before, exactly the bits of these causes are set
    (P104-END-04).
    """
    env = await Env.start(dut, INIT_B)
    for pins, bits in (
        ({"l1_n": 0, "alm_n": 0}, 0x30),
        ({"l1_n": 0, "l2_n": 0}, 0x10),
        ({"alm_n": 0, "l2_n": 0, "l4_n": 0}, 0x20),
        ({"l1_n": 0, "alm_n": 0, "cnp_n": 0, "l2_n": 0}, 0x30),
    ):
        await env.go(0x43, 100)
        await env.pulse(3, 100)
        env.bench.set(**pins)
        await env.idle()
        env.bench.set(**dict.fromkeys(pins, 1))
        await env.result("P104-END-04", 3, 0x83 | bits, 96)
    # If the hard limit occurs while the motor decelerates for L3, bits 3 and 4 are set. If ALM occurs while
    # it decelerates for command 0x41, bits 6 and 5 are set.
    await env.go(0x43, 100)
    await env.pulse(5, 100)
    env.bench.set(l3_n=0)
    await env.pulse(7, 100)
    env.bench.set(l1_n=0)
    await env.idle()
    env.bench.set(l3_n=1, l1_n=1)
    await env.result("P104-END-04", 7, 0x9B, 92)
    await env.go(0x43, 100)
    await env.pulse(5, 100)
    await env.host.command(0x41)
    await env.pulse(7, 100)
    env.bench.set(alm_n=0)
    await env.idle()
    env.bench.set(alm_n=1)
    await env.result("P104-END-04", 7, 0xE3, 92)
    # A slow-down limit that was released again has set bit 3; command 0x40 during the deceleration also sets
    # bit 6.
    await env.go(0x43, 100)
    await env.pulse(5, 100)
    await env.bench.pulse_pin("l3_n", 0, 5)
    await env.pulse(7, 100)
    await env.host.command(0x40)
    await env.result("P104-END-04", 7, 0xCB, 92)


@directed("P104-END-06", "P104-END-05", "P104-RD-07")
async def p104_end_06_one_left_or_none(dut):
    """Both a move that ended one pulse early and a complete move have a remaining count of 0; their cause
    bits differ (P104-END-06).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 4, rate=9)
    await env.pulse(3, 200)
    env.bench.set(alm_n=0)
    await env.idle()
    env.bench.set(alm_n=1)
    await env.result("P104-END-06", 3, 0xA4, 0)
    await env.go(0x44, 1, rate=9)
    await env.result("P104-END-06", 1, 0x84, 0)
    env.bench.set(l1_n=0)
    await env.go(0x42)
    await env.result("P104-END-06", 0, 0x92, 0)


@directed("P104-END-07", "P104-CMD-02")
async def p104_end_07_int(dut):
    """After ends with I = 0 and I = 1 in any order, only command 0x80 or a reset releases a pending INT
    (P104-END-07).
    """
    env = await Env.start(dut, INIT_A)
    expected = 1
    for code in (0x52, 0x52, 0x42, 0x52, 0x42, 0x42):
        await env.go(code)
        env.check("P104-END-07", "int_n at the start", env.bench.level("int_n"), expected)
        await env.idle()
        expected = 0 if code == 0x42 else expected
        env.check("P104-END-07", f"int_n after {code:#x}", env.bench.level("int_n"), expected)
    env.bench.set(l1_n=0)
    await env.move(0x53, 5)
    env.bench.set(l1_n=1)
    await env.host.command(0xC0)
    await env.init(*INIT_A)
    env.check("P104-END-07", "int_n after 0xC0 and init", env.bench.level("int_n"), 0)
    env.check("P104-END-07", "finish status of the newest", await env.finish(), 0x93)
    env.check("P104-END-07", "int_n after 0x80", env.bench.level("int_n"), 1)
    await env.move(0x42)
    await env.bench.reset()
    env.check("P104-END-07", "int_n after reset", env.bench.level("int_n"), 1)


@directed("P104-END-08", "P104-DS-09", "P104-LIM-07", builds=(F8, F11))
async def p104_end_08_hold(dut):
    """hold rises 34.0 ms after BUSY falls, both after a step that an active alarm suppresses and after a
    normal step (P104-END-08).
    """
    env = await Env.start(dut, INIT_A)
    us = env.cfg.us
    for alarm in (0, 1):
        env.bench.set(alm_n=alarm)
        await env.bench.clocks(4)
        await env.go(0x42)
        end = await env.wait_end()
        await env.finish()
        await env.host.command(0x81)
        rise = await env.bench.edge("hold", 1, us(35_000))
        env.window("P104-END-08", f"BUSY fall to hold, alm_n = {alarm}", rise - end, us(34_000), us(34_100))
        await env.bench.clocks(100)


@directed("P104-END-08", "P104-OPR-01", builds=(F8,))
async def p104_end_08_hold_restarts(dut):
    """If a second operation starts within 34 ms, the hold time is counted from the second end
    (P104-END-08).
    """
    env = await Env.start(dut, INIT_A)
    us = env.cfg.us
    await env.go(0x42)
    first = await env.wait_end()
    await env.finish()
    await env.bench.until(first + us(33_900))
    await env.go(0x42)
    second = await env.wait_end()
    await env.bench.until(first + us(34_200))
    env.check("P104-END-08", "hold 34.2 ms after the first end", env.bench.level("hold"), 0)
    rise = await env.bench.edge("hold", 1, us(35_000))
    env.window("P104-END-08", "second end to hold", rise - second, us(34_000), us(34_100))
    edge0 = await env.go(0x42, poll=False)
    await env.pulse(1)
    fell = env.bench.falls("hold")[-1]
    env.window("P104-OPR-01", "hold falls at the next start", fell - edge0, 2, C_EVENT_LATEST + 2)
