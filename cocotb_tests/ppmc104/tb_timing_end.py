"""Start, pulse shape and end of a motion (P104-TIM, P104-END)."""

from __future__ import annotations

from cocotb_tests.harness import BUSY, F8, F11, F16, F25, F50, F100, IBF, directed

from .env import C_EVENT_LATEST, PINS_LATEST, Lab
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
    """At the CCW start of every operation, hold and dir change together; pulse 1 and s follow W..W+2
    cycles later (P104-TIM-02).
    """
    lab = await Lab.start(dut, INIT_A)
    w = lab.cfg.w
    for code, n, rate in OPERATIONS:
        await lab.bench.reset()
        await lab.bench.clocks(6)
        await lab.init(*INIT_A)
        since = lab.bench.now
        edge0 = await lab.go(code | 8, n, rate, poll=False)
        status = await lab.host.poll(IBF, 0)
        lab.check("P104-OPR-01", "status at the start", status, BUSY)
        first = await lab.pulse(1)
        fell = lab.bench.falls("hold", since)[0]
        lab.check("P104-OPR-01", "dir moves with hold", lab.bench.edges("dir", since), [(fell, 1)])
        lab.window("P104-TIM-01", "edge 0 to hold", fell - edge0, 2, PINS_LATEST)
        lab.window("P104-TIM-02", f"hold to pulse 1 of {code:#x}", first - fell, w, w + 2)
        moves = [t for t, _ in lab.bench.edges("s", fell)]
        lab.check("P104-TIM-04", "edges of s", moves, [] if code >= 0xC0 else [first])


@directed("P104-TIM-05", "P104-TIM-04", builds=(F16, F25))
async def p104_tim_05_external_low_times(dut):
    """With external clocks and vsel = H, low times at rates 0..9 are W or end at their clock edge
    (P104-TIM-05).
    """
    lab = await Lab.start(dut, (0x1A, 9, 4, 4))
    w, us = lab.cfg.w, lab.cfg.us
    for period in (us(1), us(2), us(4), us(7.5), us(8.5), us(20)):
        for high in (period // 4, period // 2, 3 * period // 4):
            for rate in (0, 1, 2, 3, 6, 9):
                clock = lab.bench.external_clock([period] * 300, high=high)
                await lab.move(0x44, 5, rate)
                clock.cancel()
                await lab.bench.align()
                lab.bench.set(clock=0)
                cut = (rate + 1) // 2 * period if rate else (high if period < us(8) else w)
                expected = [min(w, cut)] * 4 + [w]
                what = f"low times at {period}/{high} clk, rate {rate}"
                lab.check("P104-TIM-05", what, lab.bench.low_times(lab.since), expected)
                await lab.bench.clocks(8)


@directed("P104-TIM-05", "P104-INT-03", builds=(F16, F25))
async def p104_tim_05_vsel_low(dut):
    """With vsel = L, every low time is W, for any rate and clock (P104-TIM-05)."""
    lab = await Lab.start(dut, (0x1A, 9, 4, 4), vsel=0)
    for period in (lab.cfg.us(1), lab.cfg.us(4), lab.cfg.us(12)):
        for rate in (0, 1, 3):
            clock = lab.bench.external_clock([period] * 300, high=period // 2)
            await lab.move(0x44, 5, rate)
            clock.cancel()
            await lab.bench.align()
            lab.bench.set(clock=0)
            lab.check(
                "P104-TIM-05", "low times", lab.bench.low_times(lab.since), [lab.cfg.w] * len(lab.pulses)
            )
            await lab.bench.clocks(8)
    await lab.init(*INIT_A)
    for rate in (0, 1, 2, 3):
        await lab.move(0x44, 5, rate)
        lab.check("P104-TIM-05", "low times, internal", lab.bench.low_times(lab.since), [lab.cfg.w] * 5)


@directed("P104-TIM-05", "P104-END-02", "P104-LIM-03", builds=(F16, F11))
async def p104_tim_05_end_in_the_low_time(dut):
    """A limit in any cycle of a low time, short or long, does not change its length (P104-TIM-05)."""
    lab = await Lab.start(dut, INIT_A)
    for rate in (0, 1, 2, 9):
        expected = lab.cfg.cyc(16 * (rate + 1)) if rate <= 2 else lab.cfg.w
        step = 1 if rate == 0 else 7
        for delay in range(1, expected, step):
            await lab.go(0x44, 30, rate)
            await lab.pulse(3, delay)
            hit = lab.bench.set(l1_n=0)
            end = await lab.ended()
            await lab.idle()
            rise = lab.bench.rises("pout_n", lab.since)[-1]
            count = len(lab.pulses)
            lab.window("P104-END-02", "end after the rise or the limit", end - max(rise, hit), 0, 8)
            lows = lab.bench.low_times(lab.since)
            lab.check("P104-TIM-05", f"low times at rate {rate}, limit at +{delay}", lows, [expected] * count)
            lab.window("P104-END-02", "pulses", count, 3, 3 if delay < expected - 8 else 4)
            lab.bench.set(l1_n=1)
            await lab.result("P104-END-02", count, 0x94, 30 - count - 1)


@directed("P104-TIM-05", "P104-END-03", "P104-FDC-02")
async def p104_tim_05_last_pulse_of_a_deceleration(dut):
    """With high rates at both ends of the ramp, the last low time of a forced deceleration is W
    (P104-TIM-05).
    """
    lab = await Lab.start(dut, (0x0A, 1, 0, 6))
    for j in (2, 5, 9):
        await lab.go(0x43, 200)
        await lab.pulse(j)
        await lab.host.command(0x41)
        end = await lab.ended()
        await lab.idle()
        lows = lab.bench.low_times(lab.since)
        lab.check("P104-TIM-05", "last low time", lows[-1], lab.cfg.w)
        lab.check("P104-TIM-05", "longest of the others", max(lows[:-1]) <= 32, True)
        lab.window("P104-END-03", "end after the last rise", end - lab.bench.rises("pout_n")[-1], 0, 4)
        await lab.result("P104-END-03", len(lows), 0xC3, 200 - len(lows) - 1)


@directed("P104-TIM-06", "P104-PHS-07", "P104-STP-01")
async def p104_tim_06_dir(dut):
    """Only the start of a move changes dir: tried with moves CW and CCW, stops and rejected commands
    (P104-TIM-06).
    """
    lab = await Lab.start(dut, INIT_B)
    levels, starts = [], []
    for bit in (1, 0, 1, 1, 0):
        for base, n, rate in ((0x43, 40, None), (0x45, None, 9)):
            since = lab.bench.now
            await lab.go(base | bit << 3, n, rate)
            await lab.pulse(4, 100)
            await lab.statuses("c 42 c 4A c 0A")
            await lab.host.command(0x41)
            await lab.idle()
            starts += lab.bench.falls("hold", since)
            levels.append(lab.bench.level("dir"))
            await lab.bench.clocks(300)
    lab.check("P104-TIM-06", "levels", levels, [1, 1, 0, 0, 1, 1, 1, 1, 0, 0])
    lab.check("P104-PHS-07", "edges of dir", [v for _, v in lab.bench.edges("dir")], [1, 0, 1, 0])
    lab.check("P104-PHS-07", "first edge is at a start", lab.bench.edges("dir")[0][0], starts[0])


@directed("P104-END-01", "P104-TIM-05", "P104-RD-07", builds=(F16, F25, F100))
async def p104_end_01_normal_end(dut):
    """At the end of each counted move, BUSY, INT, finish status and remaining count follow the last
    rise by at most 4 cycles (P104-END-01).
    """
    lab = await Lab.start(dut, INIT_A)
    for code, n, rate in ((0x42, None, None), (0x43, 9, None), (0x44, 3, 0), (0x44, 3, 30), (0xC3, 9, None)):
        await lab.go(code, n, rate)
        end = await lab.ended()
        status = await lab.host.status()
        lab.check("P104-END-01", "BUSY after INT", status & BUSY, 0)
        lows = lab.bench.low_times(lab.since)
        lab.check("P104-END-01", "pulses at the end", len(lows), n or 1)
        lab.check("P104-TIM-05", "last low time", lows[-1], lab.cfg.w)
        lab.window("P104-END-01", "end after the rise", end - lab.bench.rises("pout_n")[-1], 0, 4)
        await lab.result("P104-END-01", n or 1, 0x80 | code & 7, 0)


@directed("P104-END-01", "P104-END-05", "P104-LIM-01", "P104-LIM-09")
async def p104_end_05_too_late(dut):
    """Causes that occur after pulse event N have no effect (P104-END-05)."""
    lab = await Lab.start(dut, INIT_A)
    for pin in ("l1_n", "l3_n", "alm_n", "cnp_n"):
        for delay in (2, 30, 76):
            for code, n, rate in ((0x43, 3, None), (0x44, 3, 4), (0x42, None, None)):
                await lab.go(code, n, rate)
                await lab.pulse(n or 1, delay)
                lab.bench.set(**{pin: 0})
                await lab.idle()
                lab.bench.set(**{pin: 1})
                await lab.result("P104-END-05", n or 1, 0x80 | code & 7, 0)


@directed("P104-END-02", "P104-LIM-01", "P104-LIM-03", "P104-LIM-05", "P104-LIM-06", builds=(F16, F100))
async def p104_end_02_reaction_time(dut):
    """A cause ends the motion within 8 cycles if pout_n is high, else within 4 cycles of its rise
    (P104-END-02).
    """
    lab = await Lab.start(dut, INIT_A)
    w = lab.cfg.w
    for pin, bits in (("l1_n", 0x97), ("alm_n", 0xA7), ("cnp_n", 0x87)):
        for delay in (5, w - 10, w + 30):
            await lab.go(0x47, None, 9)
            await lab.pulse(2, delay)
            hit = lab.bench.set(**{pin: 0})
            end = await lab.ended()
            rise = lab.bench.rises("pout_n")[-1]
            if delay > w:
                lab.window("P104-END-02", f"{pin} to the end", end - hit, 0, 8)
            else:
                lab.window("P104-END-02", "rise to the end", end - rise, 0, 4)
            lab.check("P104-END-02", "BUSY", await lab.host.status() & BUSY, 0)
            lab.bench.set(**{pin: 1})
            await lab.result("P104-END-02", 2, bits, ALL - 3)


@directed("P104-END-04", "P104-LIM-09", "P104-BAD-15")
async def p104_end_04_cause_bits(dut):
    """With combinations of causes at the decision and before, exactly their bits are set (P104-END-04)."""
    lab = await Lab.start(dut, INIT_B)
    for pins, bits in (
        ({"l1_n": 0, "alm_n": 0}, 0x30),
        ({"l1_n": 0, "l2_n": 0}, 0x10),
        ({"alm_n": 0, "l2_n": 0, "l4_n": 0}, 0x20),
        ({"l1_n": 0, "alm_n": 0, "cnp_n": 0, "l2_n": 0}, 0x30),
    ):
        await lab.go(0x43, 100)
        await lab.pulse(3, 100)
        lab.bench.set(**pins)
        await lab.idle()
        lab.bench.set(**dict.fromkeys(pins, 1))
        await lab.result("P104-END-04", 3, 0x83 | bits, 96)
    # The hard limit acts while the motor decelerates for L3: bits 3 and 4. ALM acts while it decelerates for
    # 0x41: bits 6 and 5.
    await lab.go(0x43, 100)
    await lab.pulse(5, 100)
    lab.bench.set(l3_n=0)
    await lab.pulse(7, 100)
    lab.bench.set(l1_n=0)
    await lab.idle()
    lab.bench.set(l3_n=1, l1_n=1)
    await lab.result("P104-END-04", 7, 0x9B, 92)
    await lab.go(0x43, 100)
    await lab.pulse(5, 100)
    await lab.host.command(0x41)
    await lab.pulse(7, 100)
    lab.bench.set(alm_n=0)
    await lab.idle()
    lab.bench.set(alm_n=1)
    await lab.result("P104-END-04", 7, 0xE3, 92)
    # A slow-down limit that was released has set bit 3; 0x40 on the flagged move adds bit 6.
    await lab.go(0x43, 100)
    await lab.pulse(5, 100)
    await lab.bench.pulse_pin("l3_n", 0, 5)
    await lab.pulse(7, 100)
    await lab.host.command(0x40)
    await lab.result("P104-END-04", 7, 0xCB, 92)


@directed("P104-END-06", "P104-END-05", "P104-RD-07")
async def p104_end_06_one_left_or_none(dut):
    """The cause bits distinguish a move that ended one pulse early from a complete one; both have a
    remaining count of 0 (P104-END-06).
    """
    lab = await Lab.start(dut, INIT_A)
    await lab.go(0x44, 4, rate=9)
    await lab.pulse(3, 200)
    lab.bench.set(alm_n=0)
    await lab.idle()
    lab.bench.set(alm_n=1)
    await lab.result("P104-END-06", 3, 0xA4, 0)
    await lab.go(0x44, 1, rate=9)
    await lab.result("P104-END-06", 1, 0x84, 0)
    lab.bench.set(l1_n=0)
    await lab.go(0x42)
    await lab.result("P104-END-06", 0, 0x92, 0)


@directed("P104-END-07", "P104-CMD-02")
async def p104_end_07_int(dut):
    """With I = 0 and 1 in any order, only 0x80 or reset releases a pending INT (P104-END-07)."""
    lab = await Lab.start(dut, INIT_A)
    expected = 1
    for code in (0x52, 0x52, 0x42, 0x52, 0x42, 0x42):
        await lab.go(code)
        lab.check("P104-END-07", "int_n at the start", lab.bench.level("int_n"), expected)
        await lab.idle()
        expected = 0 if code == 0x42 else expected
        lab.check("P104-END-07", f"int_n after {code:#x}", lab.bench.level("int_n"), expected)
    lab.bench.set(l1_n=0)
    await lab.move(0x53, 5)
    lab.bench.set(l1_n=1)
    await lab.host.command(0xC0)
    await lab.init(*INIT_A)
    lab.check("P104-END-07", "int_n after 0xC0 and init", lab.bench.level("int_n"), 0)
    lab.check("P104-END-07", "finish status of the newest", await lab.finish(), 0x93)
    lab.check("P104-END-07", "int_n after 0x80", lab.bench.level("int_n"), 1)
    await lab.move(0x42)
    await lab.bench.reset()
    lab.check("P104-END-07", "int_n after reset", lab.bench.level("int_n"), 1)


@directed("P104-END-08", "P104-DS-09", "P104-LIM-07", builds=(F8, F11))
async def p104_end_08_hold(dut):
    """hold rises 34.0 ms after BUSY falls: after a masked move without a pulse, and after a normal one
    (P104-END-08).
    """
    lab = await Lab.start(dut, INIT_A)
    us = lab.cfg.us
    for alarm in (0, 1):
        lab.bench.set(alm_n=alarm)
        await lab.bench.clocks(4)
        await lab.go(0x42)
        end = await lab.ended()
        await lab.finish()
        await lab.host.command(0x81)
        rise = await lab.bench.edge("hold", 1, us(35_000))
        lab.window("P104-END-08", f"BUSY fall to hold, alm_n = {alarm}", rise - end, us(34_000), us(34_100))
        await lab.bench.clocks(100)


@directed("P104-END-08", "P104-OPR-01", builds=(F8,))
async def p104_end_08_hold_restarts(dut):
    """If a second operation starts within 34 ms, hold is timed from the second end (P104-END-08)."""
    lab = await Lab.start(dut, INIT_A)
    us = lab.cfg.us
    await lab.go(0x42)
    first = await lab.ended()
    await lab.finish()
    await lab.bench.until(first + us(33_900))
    await lab.go(0x42)
    second = await lab.ended()
    await lab.bench.until(first + us(34_200))
    lab.check("P104-END-08", "hold 34.2 ms after the first end", lab.bench.level("hold"), 0)
    rise = await lab.bench.edge("hold", 1, us(35_000))
    lab.window("P104-END-08", "second end to hold", rise - second, us(34_000), us(34_100))
    edge0 = await lab.go(0x42, poll=False)
    await lab.pulse(1)
    fell = lab.bench.falls("hold")[-1]
    lab.window("P104-OPR-01", "hold falls at the next start", fell - edge0, 2, C_EVENT_LATEST + 2)
