"""Black-box acceptance checks AC-45 to AC-60: stimulus and values as in the acceptance table."""

from __future__ import annotations

from itertools import repeat

from cocotb_tests.harness import BUSY, COMMAND, D16, F11, IBF, directed

from .env import Lab
from .expected_timing import INIT_A, INIT_B, differences

A_DATA = (9, 4, 4)


@directed("AC-45", "P104-SW-01", "P104-SW-03", "P104-SW-04", "P104-SW-05", "P104-SW-06", "P104-SW-07")
async def p104_ac_45_chopping(dut):
    """With S = 1, the chopper follows the parameters and vsel; a step switches to the full pattern
    (AC-45).
    """
    lab = await Lab.start(dut, (0x2A, *A_DATA))
    on, off = 0b00011, 0b00000
    await lab.bench.clocks(9000)
    times = lab.stretches(lab.bench.now - 8900)
    lab.check("AC-45", "default phases", set(times), {(on, 1040), (off, 1740)})
    await lab.host.run("c 84 d 10 d 20")
    await lab.bench.clocks(4000)
    since = lab.bench.now
    await lab.bench.clocks(9000)
    lab.check("AC-45", "phases, vsel = 1", set(lab.stretches(since)), {(on, 1200), (off, 2064)})
    lab.bench.set(vsel=0)
    await lab.bench.clocks(4000)
    since = lab.bench.now
    for _ in range(8):
        lab.check("AC-45", "0x82", await lab.host.run("c 82 r"), [0xC4])
        await lab.bench.clocks(1100)
    lab.check("AC-45", "phases, vsel = 0", set(lab.stretches(since)), {(on, 1168), (off, 1996)})
    await lab.go(0x42)
    pulse = await lab.pulse(1)
    started = lab.bench.falls("hold", lab.since)[0]
    lab.window("AC-45", "full pattern before the pulse", pulse - started, 80, 82)
    lab.check("AC-45", "s from the start on", lab.bench.level_at("s", started), on)
    await lab.ended()
    lab.check("AC-45", "edges of s in the step", lab.bench.edges("s", started + 1), [(pulse, 0b00110)])
    lab.check("AC-45", "0x82 after the step", await lab.host.run("c 82 r"), [0x60])


@directed("AC-46", "P104-SW-02", "P104-SW-04")
async def p104_ac_46_chopper_starts_with_on(dut):
    """With S = 1, the first OFF phase begins 1040 cycles after the end of a single step (AC-46)."""
    lab = await Lab.start(dut, (0x2A, *A_DATA))
    await lab.go(0x42)
    end = await lab.ended()
    off = await lab.bench.edge("s", 0)
    lab.window("AC-46", "INT to the first OFF phase", off - end, 1034, 1046)


@directed("AC-47", "P104-INI-08")
async def p104_ac_47_chopping_ends(dut):
    """A re-initialisation with S = 0 ends the chopping at its completion, with the pattern on (AC-47)."""
    lab = await Lab.start(dut, (0x2A, *A_DATA))
    await lab.bench.edge("s", 0)
    await lab.init(*INIT_A)
    await lab.bench.clocks(2)
    since = lab.bench.now
    lab.check("AC-47", "s", lab.bench.level("s"), 0b00011)
    await lab.bench.clocks(8000)
    lab.check("AC-47", "edges of s", lab.bench.edges("s", since), [])


@directed("AC-48", "P104-END-08")
async def p104_ac_48_hold(dut):
    """Of two single steps 20 ms apart, hold rises 34 ms after the second (AC-48)."""
    lab = await Lab.start(dut, INIT_A)
    await lab.move(0x42)
    first = lab.pulses[0]
    fell = lab.bench.falls("hold")[0]
    lab.window("AC-48", "hold falls before the pulse", first - fell, 80, 82)
    await lab.bench.until(first + 320_000)
    await lab.move(0x42)
    second = lab.pulses[0]
    rise = await lab.bench.edge("hold", 1)
    lab.window("AC-48", "pulse to hold", rise - second, 544_000, 545_600)
    lab.check("AC-48", "edges of hold", [value for _, value in lab.bench.edges("hold")], [0, 1])


@directed("AC-48", "P104-END-08")
async def p104_ac_48_hold_after_one_step(dut):
    """hold rises 34 ms after one single step (AC-48)."""
    lab = await Lab.start(dut, INIT_A)
    await lab.move(0x42)
    rise = await lab.bench.edge("hold", 1)
    lab.window("AC-48", "pulse to hold", rise - lab.pulses[0], 544_000, 545_600)


@directed("AC-49", "P104-EX-08", "P104-INT-03", "P104-INT-04")
async def p104_ac_49_external_clock(dut):
    """With external clocks and rate 9, intervals are 640, 760, 1600 or 1400 cycles, depending on period
    and vsel (AC-49).
    """
    lab = await Lab.start(dut, (0x1A, *A_DATA))
    cases = ((64, 1, 640), (64, 0, 760), (160, 0, 1600), (160, 1, 1600), (128, 0, 1400))
    for period, vsel, expected in cases:
        lab.bench.set(vsel=vsel)
        clock = lab.bench.external_clock(repeat(period), high=period // 2)
        await lab.move(0x44, 10, rate=9)
        clock.cancel()
        await lab.bench.align()
        lab.bench.set(clock=0)
        await lab.bench.clocks(4)
        lab.check("AC-49", "pulses", len(lab.pulses), 10)
        for interval in lab.intervals:
            lab.window(
                "AC-49", f"interval at {period} clk, vsel {vsel}", interval, expected - 2, expected + 2
            )
        lab.check("AC-49", "sum of intervals", sum(lab.intervals), 9 * expected)
        lab.check("AC-49", "low times", lab.low_times, [80] * 10)
        await lab.result("AC-49", 10, 0x84, 0)


@directed("AC-50", "P104-TIM-03", "P104-BAD-13")
async def p104_ac_50_external_clock_missing(dut):
    """If the external clock is stopped, a move waits with BUSY = 1 until 0x40 ends it (AC-50)."""
    lab = await Lab.start(dut, (0x1A, *A_DATA))
    await lab.go(0x44, 10, rate=9)
    await lab.bench.clocks(16_000)
    lab.check("AC-50", "BUSY", await lab.host.status(), BUSY)
    await lab.host.run("c 40")
    await lab.result("AC-50", 0, 0xC4, 9)


@directed("AC-51", "P104-BCK-03", "P104-EX-12", builds=(F11,))
async def p104_ac_51_no_drift(dut):
    """With CLK_HZ = 11 059 200, each of 1001 pulses at rate 0 is on the edge that the formula states
    (AC-51).
    """
    lab = await Lab.start(dut, INIT_A)
    pulses = await lab.move(0x44, 1001, rate=0)
    got = [t - pulses[0] for t in pulses]
    expected = [-(-221184 * n // 10000) for n in range(1001)]
    lab.check("AC-51", "falls 1, 2, 3, 1000", [expected[n] for n in (1, 2, 3, 1000)], [23, 45, 67, 22119])
    lab.check("AC-51", "all pulses", got, expected)


@directed("AC-52", "P104-HSK-01", "P104-HSK-02", "P104-DS-02", builds=(D16,))
async def p104_ac_52_init_time(dut):
    """In DATASHEET, if C1 and C2 are written while the mailbox is closed, only C2 is accepted, 16.5 ms
    after the initialisation (AC-52).
    """
    lab = await Lab.start(dut, None)
    await lab.host.run("c 0A d 09 d 04 d 04")
    event = await lab.host.data(0x00, poll=False) + 2
    # The status is read directly after the byte: the byte is accepted immediately, and the mailbox closes
    # after it.
    await lab.host.poll(IBF, 0)
    await lab.host.command(0xC1, poll=False)
    await lab.host.command(0xC2, poll=False)
    while (at := lab.bench.now) < event + 263_990:
        lab.check("AC-52", f"status at edge {at}", await lab.host.status(), IBF)
        await lab.bench.clocks(min(8000, max(1, event + 263_980 - lab.bench.now)))
    await lab.host.poll(IBF, 0, dense=1000)
    lab.window("AC-52", "IBF cleared after the write event", lab.bench.now - event, 264_000, 264_030)
    await lab.bench.clocks(400)
    lab.check("AC-52", "edges of aux_n", lab.bench.edges("aux_n"), [])


@directed("AC-53", "P104-DS-03", "P104-DS-04", "P104-DS-07", builds=(D16,))
async def p104_ac_53_constant_speed_times(dut):
    """In DATASHEET, BUSY, pulse 1, INT and the next command of a 0x44 with 3 pulses occur at their
    documented times (AC-53).
    """
    lab = await Lab.start(dut, INIT_A)
    lab.since = lab.bench.now
    await lab.host.run("c 44 d 63 d 02 d 00")
    event = await lab.host.data(0x00, poll=False) + 2
    last_idle = event
    while True:
        at = lab.bench.now
        if await lab.host.status() & BUSY:
            break
        last_idle = at
    lab.window("AC-53", "last status with BUSY = 0 after the write event", last_idle - event, 0, 448)
    lab.window("AC-53", "first status with BUSY = 1 after the write event", at + 2 - event, 432, 456)
    lab.window("AC-53", "hold fall", lab.bench.falls("hold")[0] - event, 432, 448)
    lab.window("AC-53", "pulse 1", await lab.pulse(1) - event, 3104, 3120)
    last = await lab.pulse(3)
    await lab.bench.until(last + 10)
    await lab.host.command(0x80, poll=False)
    lab.window("AC-53", "INT after the last fall", await lab.ended() - last, 416, 432)
    taken = await lab.bench.edge("int_n", 1)
    lab.window("AC-53", "0x80 taken after the last fall", taken - last, 2496, 2514)


@directed("AC-54", "P104-DS-06", builds=(D16,))
async def p104_ac_54_single_step_times(dut):
    """In DATASHEET, the pulse of 0x42 occurs after 86 us and INT after 112 us (AC-54)."""
    lab = await Lab.start(dut, INIT_A)
    event = await lab.go(0x42, poll=False) + 2
    lab.window("AC-54", "pulse", await lab.pulse(1) - event, 1376, 1392)
    lab.window("AC-54", "INT", await lab.ended() - event, 1792, 1808)


@directed("AC-55", "P104-DS-05", builds=(D16,))
async def p104_ac_55_ramp_times(dut):
    """In DATASHEET, pulse 1 of trapezoidal and triangular profiles occurs at its documented time
    (AC-55).
    """
    lab = await Lab.start(dut, INIT_B)
    for n, low in ((1000, 3200), (10, 3276), (20, 3353), (21, 3200)):
        event = await lab.go(0x43, n, poll=False) + 2
        lab.window("AC-55", f"pulse 1 of N = {n}", await lab.pulse(1) - event, low, low + 16)
        await lab.host.run("c 40")
        await lab.idle()
        await lab.host.run("c 80 r")


@directed("AC-56", "P104-DS-12", builds=(D16,))
async def p104_ac_56_too_fast_for_commands(dut):
    """In DATASHEET with 20 us intervals, C1 waits for the end of the move; 0x40 does not wait (AC-56)."""
    lab = await Lab.start(dut, INIT_A)
    await lab.go(0x44, 100, rate=9)
    await lab.pulse(20, 10)
    await lab.host.command(0xC1, poll=False)
    last = await lab.pulse(100)
    await lab.bench.until(last + 2480)
    lab.check("AC-56", "IBF before 156 us", await lab.host.status() & IBF, IBF)
    lab.check("AC-56", "aux_n before 156 us", lab.bench.level("aux_n"), 1)
    on = await lab.bench.edge("aux_n", 0)
    lab.window("AC-56", "aux_n after the last fall", on - last, 2720, 2738)
    await lab.result("AC-56", 100, 0x84, 0)
    await lab.go(0x44, 100, rate=9)
    await lab.pulse(20, 100)
    await lab.host.command(0x40, poll=False)
    await lab.result("AC-56", 20, 0xC4, 0x4F)


@directed("AC-57", "P104-BAD-19")
async def p104_ac_57_reset_in_motion(dut):
    """When rst_n falls between two edges during a move, all outputs take their reset levels (AC-57)."""
    lab = await Lab.start(dut, INIT_A)
    bench = lab.bench
    await lab.host.run("c C1 c 86 d 0F")
    await lab.go(0x4C, 20, rate=0x13)
    await lab.pulse(3, 20)
    reset = await bench.set_between(rst_n=0)
    expected = {"int_n": 1, "pout_n": 1, "hold": 1, "dir": 0, "aux_n": 1, "auxo": 0xF, "s": 0x1F}
    lab.check("AC-57", "outputs", lab.outputs(), expected)
    await bench.align()
    await bench.clocks(4)
    bench.set(rst_n=1)
    await bench.clocks(6)
    lab.check("AC-57", "status", await lab.host.status(), 0x00)
    lab.check("AC-57", "status of 0x42", await lab.host.command(0x42), 0xA0)
    await bench.clocks(10_000)
    lab.check("AC-57", "pulses after the reset", bench.pulses(reset + 1), [])


@directed("AC-58", "P104-BUS-02")
async def p104_ac_58_both_strobes(dut):
    """If both strobes are low together and end together, no access takes place (AC-58)."""
    lab = await Lab.start(dut, None)
    before = await lab.host.command(0x86)
    await lab.bench.clocks(4)
    since = lab.bench.set(a0=COMMAND, d_i=0xC1, cs_n=0, rd_n=0, wr_n=0)
    await lab.bench.clocks(10)
    lab.bench.set(cs_n=1, rd_n=1, wr_n=1)
    await lab.bench.clocks(12)
    lab.check("AC-58", "edges of d_oe", lab.bench.edges("d_oe", since), [])
    lab.check("AC-58", "status", await lab.host.status(), before)
    lab.check("AC-58", "edges of aux_n", lab.bench.edges("aux_n"), [])


@directed("AC-59", "P104-OPR-06", "P104-TIM-02")
async def p104_ac_59_single_step_needs_no_clock(dut):
    """The pulse of 0x42 occurs even if the external clock is stopped (AC-59)."""
    lab = await Lab.start(dut, (0x1A, *A_DATA))
    await lab.move(0x42)
    lab.window("AC-59", "hold fall to pulse", lab.pulses[0] - lab.bench.falls("hold")[0], 80, 82)
    lab.check("AC-59", "low time", lab.bench.low_times(lab.since), [80])
    lab.check("AC-59", "s", lab.bench.level("s"), 0b00110)
    await lab.result("AC-59", 1, 0x82)


@directed("AC-60", "P104-TIM-05", "P104-END-02")
async def p104_ac_60_limit_in_short_low_time(dut):
    """If L1 falls 2 cycles after pulse 10 at rate 0, this pulse keeps its 16 cycles and is the last one
    (AC-60).
    """
    lab = await Lab.start(dut, INIT_A)
    await lab.go(0x44, 100, rate=0)
    await lab.pulse(10, 2)
    lab.bench.set(l1_n=0)
    await lab.result("AC-60", 10, 0x94, 0x59)
    lab.check("AC-60", "low times", lab.bench.low_times(lab.since), [16] * 10)
    lab.check("AC-60", "intervals", differences(lab.pulses), [32] * 9)
