"""Acceptance checks AC-45 to AC-60 at the pins; stimulus and values are those of the acceptance table."""

from __future__ import annotations

from itertools import repeat

from cocotb_tests.harness import BUSY, COMMAND, D16, F11, IBF, directed

from .env import Env
from .expected_timing import INIT_A, INIT_B, differences

A_DATA = (9, 4, 4)


@directed("AC-45", "P104-SW-01", "P104-SW-03", "P104-SW-04", "P104-SW-05", "P104-SW-06", "P104-SW-07")
async def p104_ac_45_chopping(dut):
    """With S = 1, the chopper uses the parameters and vsel, and a step energises the full pattern (AC-45)."""
    env = await Env.start(dut, (0x2A, *A_DATA))
    on, off = 0b00011, 0b00000
    await env.bench.clocks(9000)
    times = env.stretches(env.bench.now - 8900)
    env.check("AC-45", "default phases", set(times), {(on, 1040), (off, 1740)})
    await env.host.run("c 84 d 10 d 20")
    await env.bench.clocks(4000)
    since = env.bench.now
    await env.bench.clocks(9000)
    env.check("AC-45", "phases, vsel = 1", set(env.stretches(since)), {(on, 1200), (off, 2064)})
    env.bench.set(vsel=0)
    await env.bench.clocks(4000)
    since = env.bench.now
    for _ in range(8):
        env.check("AC-45", "0x82", await env.host.run("c 82 r"), [0xC4])
        await env.bench.clocks(1100)
    env.check("AC-45", "phases, vsel = 0", set(env.stretches(since)), {(on, 1168), (off, 1996)})
    await env.go(0x42)
    pulse = await env.pulse(1)
    started = env.bench.falls("hold", env.since)[0]
    env.window("AC-45", "full pattern before the pulse", pulse - started, 80, 82)
    env.check("AC-45", "s from the start on", env.bench.level_at("s", started), on)
    await env.wait_end()
    env.check("AC-45", "edges of s in the step", env.bench.edges("s", started + 1), [(pulse, 0b00110)])
    env.check("AC-45", "0x82 after the step", await env.host.run("c 82 r"), [0x60])


@directed("AC-46", "P104-SW-02", "P104-SW-04")
async def p104_ac_46_chopper_starts_with_on(dut):
    """With S = 1, the first OFF phase begins 1040 cycles after the end of a single step (AC-46)."""
    env = await Env.start(dut, (0x2A, *A_DATA))
    await env.go(0x42)
    end = await env.wait_end()
    off = await env.bench.edge("s", 0)
    env.window("AC-46", "INT to the first OFF phase", off - end, 1034, 1046)


@directed("AC-47", "P104-INI-08")
async def p104_ac_47_chopping_ends(dut):
    """When a re-initialisation with S = 0 completes, chopping ends with the pattern on (AC-47)."""
    env = await Env.start(dut, (0x2A, *A_DATA))
    await env.bench.edge("s", 0)
    await env.init(*INIT_A)
    await env.bench.clocks(2)
    since = env.bench.now
    env.check("AC-47", "s", env.bench.level("s"), 0b00011)
    await env.bench.clocks(8000)
    env.check("AC-47", "edges of s", env.bench.edges("s", since), [])


@directed("AC-48", "P104-END-08")
async def p104_ac_48_hold(dut):
    """If a second single step follows 20 ms after the first, hold rises 34 ms after the second (AC-48)."""
    env = await Env.start(dut, INIT_A)
    await env.move(0x42)
    first = env.pulses[0]
    fell = env.bench.falls("hold")[0]
    env.window("AC-48", "hold falls before the pulse", first - fell, 80, 82)
    await env.bench.until(first + 320_000)
    await env.move(0x42)
    second = env.pulses[0]
    rise = await env.bench.edge("hold", 1)
    env.window("AC-48", "pulse to hold", rise - second, 544_000, 545_600)
    env.check("AC-48", "edges of hold", [value for _, value in env.bench.edges("hold")], [0, 1])


@directed("AC-48", "P104-END-08")
async def p104_ac_48_hold_after_one_step(dut):
    """hold rises 34 ms after one single step (AC-48)."""
    env = await Env.start(dut, INIT_A)
    await env.move(0x42)
    rise = await env.bench.edge("hold", 1)
    env.window("AC-48", "pulse to hold", rise - env.pulses[0], 544_000, 545_600)


@directed("AC-49", "P104-EX-08", "P104-INT-03", "P104-INT-04")
async def p104_ac_49_external_clock(dut):
    """With external clocks and rate 9, intervals are 640, 760, 1600 or 1400 cycles, depending on clock period
    and vsel (AC-49).
    """
    env = await Env.start(dut, (0x1A, *A_DATA))
    cases = ((64, 1, 640), (64, 0, 760), (160, 0, 1600), (160, 1, 1600), (128, 0, 1400))
    for period, vsel, expected in cases:
        env.bench.set(vsel=vsel)
        clock = env.bench.external_clock(repeat(period), high=period // 2)
        await env.move(0x44, 10, rate=9)
        clock.cancel()
        await env.bench.align()
        env.bench.set(clock=0)
        await env.bench.clocks(4)
        env.check("AC-49", "pulses", len(env.pulses), 10)
        for interval in env.intervals:
            env.window(
                "AC-49", f"interval at {period} cycles, vsel {vsel}", interval, expected - 2, expected + 2
            )
        slack = 2 * env.bench.slack
        env.window(
            "AC-49", "sum of intervals", sum(env.intervals), 9 * expected - slack, 9 * expected + slack
        )
        env.check("AC-49", "low times", env.low_times, [80] * 10)
        await env.result("AC-49", 10, 0x84, 0)


@directed("AC-50", "P104-TIM-03", "P104-BAD-13")
async def p104_ac_50_external_clock_missing(dut):
    """If the external clock is stopped, a move waits with BUSY = 1 until 0x40 ends it (AC-50)."""
    env = await Env.start(dut, (0x1A, *A_DATA))
    await env.go(0x44, 10, rate=9)
    await env.bench.clocks(16_000)
    env.check("AC-50", "BUSY", await env.host.status(), BUSY)
    await env.host.run("c 40")
    await env.result("AC-50", 0, 0xC4, 9)


@directed("AC-51", "P104-BCK-03", "P104-EX-12", builds=(F11,))
async def p104_ac_51_no_drift(dut):
    """With CLK_HZ = 11 059 200, each of 1001 pulses at rate 0 occurs on the edge that the formula states
    (AC-51).
    """
    env = await Env.start(dut, INIT_A)
    pulses = await env.move(0x44, 1001, rate=0)
    got = [t - pulses[0] for t in pulses]
    expected = [-(-221184 * n // 10000) for n in range(1001)]
    env.check("AC-51", "falls 1, 2, 3, 1000", [expected[n] for n in (1, 2, 3, 1000)], [23, 45, 67, 22119])
    env.check("AC-51", "all pulses", got, expected)


@directed("AC-52", "P104-HSK-01", "P104-HSK-02", "P104-DS-02", builds=(D16,))
async def p104_ac_52_init_time(dut):
    """In DATASHEET, if commands 0xC1 and 0xC2 are written while the mailbox is closed, only command 0xC2 is
    accepted, 16.5 ms after the initialisation (AC-52).
    """
    env = await Env.start(dut, None)
    await env.host.run("c 0A d 09 d 04 d 04")
    event = await env.host.data(0x00, poll=False) + 2
    # The status is read directly after the byte, which is accepted immediately; the mailbox closes after it.
    await env.host.poll(IBF, 0)
    await env.host.command(0xC1, poll=False)
    await env.host.command(0xC2, poll=False)
    while (at := env.bench.now) < event + 263_990:
        env.check("AC-52", f"status at edge {at}", await env.host.status(), IBF)
        await env.bench.clocks(min(8000, max(1, event + 263_980 - env.bench.now)))
    await env.host.poll(IBF, 0, dense=1000)
    env.window("AC-52", "IBF cleared after the write event", env.bench.now - event, 264_000, 264_030)
    await env.bench.clocks(400)
    env.check("AC-52", "edges of aux_n", env.bench.edges("aux_n"), [])


@directed("AC-53", "P104-DS-03", "P104-DS-04", "P104-DS-07", builds=(D16,))
async def p104_ac_53_constant_speed_times(dut):
    """In DATASHEET, after command 0x44 with 3 pulses, BUSY, pulse 1, INT and the acceptance of the next
    command occur at their documented times (AC-53).
    """
    env = await Env.start(dut, INIT_A)
    env.since = env.bench.now
    await env.host.run("c 44 d 63 d 02 d 00")
    event = await env.host.data(0x00, poll=False) + 2
    last_idle = event
    while True:
        at = env.bench.now
        if await env.host.status() & BUSY:
            break
        last_idle = at
    env.window("AC-53", "last status with BUSY = 0 after the write event", last_idle - event, 0, 448)
    env.window("AC-53", "first status with BUSY = 1 after the write event", at + 2 - event, 432, 456)
    env.window("AC-53", "hold fall", env.bench.falls("hold")[0] - event, 432, 448)
    env.window("AC-53", "pulse 1", await env.pulse(1) - event, 3104, 3120)
    last = await env.pulse(3)
    await env.bench.until(last + 10)
    await env.host.command(0x80, poll=False)
    env.window("AC-53", "INT after the last fall", await env.wait_end() - last, 416, 432)
    taken = await env.bench.edge("int_n", 1)
    env.window("AC-53", "0x80 taken after the last fall", taken - last, 2496, 2514)


@directed("AC-54", "P104-DS-06", builds=(D16,))
async def p104_ac_54_single_step_times(dut):
    """In DATASHEET, command 0x42 outputs its pulse after 86 us and asserts INT after 112 us (AC-54)."""
    env = await Env.start(dut, INIT_A)
    event = await env.go(0x42, poll=False) + 2
    env.window("AC-54", "pulse", await env.pulse(1) - event, 1376, 1392)
    env.window("AC-54", "INT", await env.wait_end() - event, 1792, 1808)


@directed("AC-55", "P104-DS-05", builds=(D16,))
async def p104_ac_55_ramp_times(dut):
    """In DATASHEET, pulse 1 of trapezoidal and of triangular profiles occurs at its documented time
    (AC-55).
    """
    env = await Env.start(dut, INIT_B)
    for n, low in ((1000, 3200), (10, 3276), (20, 3353), (21, 3200)):
        event = await env.go(0x43, n, poll=False) + 2
        env.window("AC-55", f"pulse 1 of N = {n}", await env.pulse(1) - event, low, low + 16)
        await env.host.run("c 40")
        await env.idle()
        await env.host.run("c 80 r")


@directed("AC-56", "P104-DS-12", builds=(D16,))
async def p104_ac_56_too_fast_for_commands(dut):
    """In DATASHEET with intervals of 20 us, command 0xC1 waits for the end of the move; command 0x40 does not
    wait (AC-56).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 100, rate=9)
    await env.pulse(20, 10)
    await env.host.command(0xC1, poll=False)
    last = await env.pulse(100)
    await env.bench.until(last + 2480)
    env.check("AC-56", "IBF before 156 us", await env.host.status() & IBF, IBF)
    env.check("AC-56", "aux_n before 156 us", env.bench.level("aux_n"), 1)
    on = await env.bench.edge("aux_n", 0)
    env.window("AC-56", "aux_n after the last fall", on - last, 2720, 2738)
    await env.result("AC-56", 100, 0x84, 0)
    await env.go(0x44, 100, rate=9)
    await env.pulse(20, 100)
    await env.host.command(0x40, poll=False)
    await env.result("AC-56", 20, 0xC4, 0x4F)


@directed("AC-57", "P104-BAD-19")
async def p104_ac_57_reset_in_motion(dut):
    """If rst_n falls between two clock edges during a move, all outputs take their reset levels (AC-57)."""
    env = await Env.start(dut, INIT_A)
    bench = env.bench
    await env.host.run("c C1 c 86 d 0F")
    await env.go(0x4C, 20, rate=0x13)
    await env.pulse(3, 20)
    reset = await bench.set_between(rst_n=0)
    expected = {"int_n": 1, "pout_n": 1, "hold": 1, "dir": 0, "aux_n": 1, "auxo": 0xF, "s": 0x1F}
    env.check("AC-57", "outputs", env.outputs(), expected)
    await bench.align()
    await bench.clocks(4)
    bench.set(rst_n=1)
    await bench.clocks(6)
    env.check("AC-57", "status", await env.host.status(), 0x00)
    env.check("AC-57", "status of 0x42", await env.host.command(0x42), 0xA0)
    await bench.clocks(10_000)
    env.check("AC-57", "pulses after the reset", bench.pulses(reset + 1), [])


@directed("AC-58", "P104-BUS-02")
async def p104_ac_58_both_strobes(dut):
    """If both strobes fall together and rise together, no access occurs (AC-58)."""
    env = await Env.start(dut, None)
    before = await env.host.command(0x86)
    await env.bench.clocks(4)
    since = env.bench.set(a0=COMMAND, d_i=0xC1, cs_n=0, rd_n=0, wr_n=0)
    await env.bench.clocks(10)
    env.bench.set(cs_n=1, rd_n=1, wr_n=1)
    await env.bench.clocks(12)
    env.check("AC-58", "edges of d_oe", env.bench.edges("d_oe", since), [])
    env.check("AC-58", "status", await env.host.status(), before)
    env.check("AC-58", "edges of aux_n", env.bench.edges("aux_n"), [])


@directed("AC-59", "P104-OPR-06", "P104-TIM-02")
async def p104_ac_59_single_step_needs_no_clock(dut):
    """Command 0x42 outputs its pulse even if the external clock is stopped (AC-59)."""
    env = await Env.start(dut, (0x1A, *A_DATA))
    await env.move(0x42)
    env.window("AC-59", "hold fall to pulse", env.pulses[0] - env.bench.falls("hold")[0], 80, 82)
    env.check("AC-59", "low time", env.bench.low_times(env.since), [80])
    env.check("AC-59", "s", env.bench.level("s"), 0b00110)
    await env.result("AC-59", 1, 0x82)


@directed("AC-60", "P104-TIM-05", "P104-END-02")
async def p104_ac_60_limit_in_short_low_time(dut):
    """If L1 falls 2 cycles after pulse 10 at rate 0, this pulse still lasts 16 cycles and is the last one
    (AC-60).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 100, rate=0)
    await env.pulse(10, 2)
    env.bench.set(l1_n=0)
    await env.result("AC-60", 10, 0x94, 0x59)
    env.check("AC-60", "low times", env.bench.low_times(env.since), [16] * 10)
    env.check("AC-60", "intervals", differences(env.pulses), [32] * 9)
