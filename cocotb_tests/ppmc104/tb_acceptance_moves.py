"""Acceptance checks AC-01 to AC-24 and AC-40 at the pins; stimulus and values are those of the acceptance
table.

D = N - 1 is the number that a host sends for an operation of N pulses.
"""

from __future__ import annotations

from cocotb_tests.harness import BUSY, IBF, OBF, STATUS, directed

from .env import Env
from .expected_timing import INIT_A, INIT_B

A_DATA = "d 09 d 04 d 04 d 00"
A_INTERVALS = [320, 256, 192, 192, *[160] * 5, 192, 192, 256, 320]


def kind_of(code: int) -> str:
    """Return the kind of a command code, derived from the code map only (P104-CMD-01)."""
    low = code & 7
    if code < 0x40:
        return "init" if code & 3 else "undefined"
    if code < 0x80:
        return "stop" if low < 2 else "operation"
    if code < 0xC0:
        names = {0x80: "read", 0x81: "read", 0x82: "read", 0x83: "read", 0x85: "read"}
        return names.get(code, {0x84: "switching", 0x86: "aux"}.get(code, "undefined"))
    return {0: "off", 1: "on", 2: "off", 3: "operation", 6: "operation"}.get(low, "undefined")


async def stopped_after_ten(env: Env) -> None:
    """Run the stimulus of AC-20: 1000 pulses at rate 99, stopped 400 cycles after the tenth pulse."""
    await env.go(0x44, 1000, rate=0x63)
    await env.pulse(10, 400)
    await env.host.run("c 40")
    await env.idle()


@directed("AC-01", "P104-PORT-01", "P104-PORT-03", "P104-STA-07")
async def p104_ac_01_reset_levels(dut):
    """After reset, all outputs, the status and the data register have their reset values (AC-01)."""
    env = await Env.start(dut, None)
    expected = {"int_n": 1, "pout_n": 1, "hold": 1, "dir": 0, "aux_n": 1, "auxo": 0xF, "s": 0x1F}
    env.check("AC-01", "outputs", env.outputs(), expected)
    env.check("AC-01", "d_oe", env.bench.level("d_oe"), 0)
    env.check("AC-01", "status", await env.host.status(), 0x00)
    env.check("AC-01", "data register", await env.host.read(0), 0x00)


@directed("AC-02", "P104-BUS-05")
async def p104_ac_02_read_strobe(dut):
    """During a status read of 6 cycles, d_oe and d_o change within their windows (AC-02)."""
    env = await Env.start(dut, None)
    bench = env.bench
    first = bench.set(a0=STATUS, cs_n=0, rd_n=0)
    await bench.clocks(6)
    after = bench.set(cs_n=1, rd_n=1)
    await bench.clocks(8)
    (on, _), (off, _) = bench.edges("d_oe", first)
    env.window("AC-02", "d_oe rise after edge 0", on - first, 0, 2)
    env.window("AC-02", "d_oe fall after edge 0'", off - after, 0, 2)
    env.check("AC-02", "d_o changes in the strobe", bench.edges("d_o", first + 3), [])


@directed("AC-03", "P104-ERR-01", "P104-FSM-01")
async def p104_ac_03_not_initialised(dut):
    """Before initialisation, operations return error 2, stops return error 0, and no output moves (AC-03)."""
    env = await Env.start(dut, None)
    got = await env.statuses("c 42 c 40 c 41 c 46 c C3 d 00")
    env.check("AC-03", "statuses", got, [0xA0, 0x80, 0x80, 0xA0, 0xA0, 0xB0])
    await env.bench.clocks(500)
    env.check("AC-03", "pulses", env.bench.pulses(), [])
    env.check("AC-03", "hold edges", env.bench.edges("hold"), [])


@directed("AC-04", "P104-CMD-01", "P104-CMD-03", "P104-STA-06")
async def p104_ac_04_all_codes(dut):
    """Each of the 256 codes, sent after a reset, sets the status of its kind (AC-04)."""
    env = await Env.start(dut, None)
    status = {"undefined": 0x80, "stop": 0x80, "operation": 0xA0, "init": 0x40, "switching": 0x20}
    status |= {"aux": 0x10, "read": 0x01, "on": 0x00, "off": 0x00}
    count = 0
    for code in range(256):
        await env.bench.reset()
        await env.bench.clocks(6)
        kind = kind_of(code)
        count += kind == "undefined"
        env.check("AC-04", f"status after {code:#04x}", await env.host.command(code), status[kind])
    env.check("AC-04", "number of undefined codes", count, 97)


@directed("AC-05", "P104-INI-02", "P104-STA-05")
async def p104_ac_05_init_counts_down(dut):
    """NUM returns 4, 3, 2, 1, 0 during the bytes of initialisation A (AC-05)."""
    env = await Env.start(dut, None)
    got = await env.statuses(f"c 0A {A_DATA}")
    env.check("AC-05", "statuses", got, [0x40, 0x30, 0x20, 0x10, 0x00])


@directed("AC-06", "P104-INI-05", "P104-RD-06")
async def p104_ac_06_first_pattern(dut):
    """When initialisation A has been accepted, s has pattern 0, and command 0x82 returns it (AC-06)."""
    env = await Env.start(dut, None)
    await env.host.run(f"c 0A {A_DATA}")
    env.check("AC-06", "s", env.bench.level("s"), 0b00011)
    env.check("AC-06", "0x82", await env.host.run("c 82 r"), [0xC4])


@directed("AC-07", "P104-PHS-01")
async def p104_ac_07_negative_logic(dut):
    """With negative logic, s is inverted, and command 0x82 returns the pin levels (AC-07)."""
    env = await Env.start(dut, None)
    await env.host.run(f"c 02 {A_DATA}")
    env.check("AC-07", "s", env.bench.level("s"), 0b11100)
    env.check("AC-07", "0x82", await env.host.run("c 82 r"), [0x3C])


@directed("AC-08", "P104-RD-06", "P104-PHS-02", "P104-RD-05")
async def p104_ac_08_reads_after_reset(dut):
    """After reset, the registers return 0xFC, 0xCF and 0x00 (AC-08)."""
    env = await Env.start(dut, None)
    env.check("AC-08", "reads", await env.host.run("c 82 r c 81 r c 80 r"), [0xFC, 0xCF, 0x00])


@directed("AC-09", "P104-EX-01", "P104-PRO-02")
async def p104_ac_09_trapezoid(dut):
    """With initialisation A, 14 pulses have the trapezoidal profile of EX-01 (AC-09)."""
    env = await Env.start(dut, None)
    await env.host.run(f"c 0A {A_DATA} c 43 d 0D d 00 d 00")
    await env.idle()
    env.check("AC-09", "intervals", env.bench.intervals(), A_INTERVALS)
    env.check("AC-09", "s at the end", env.bench.level("s"), 0b01100)


@directed("AC-10", "P104-EX-02", "P104-PRO-03")
async def p104_ac_10_triangles(dut):
    """With initialisation A and D = 0 to 9, pulse counts and rates are those of EX-02 (AC-10)."""
    env = await Env.start(dut, INIT_A)
    table = [[], [9], [9, 9], [9, 7, 9], [9, 7, 7, 9], [9, 7, 5, 7, 9], [9, 7, 5, 5, 7, 9]]
    table += [[9, 7, 5, 5, 5, 7, 9], [9, 7, 5, 5, 5, 5, 7, 9], [9, 7, 5, 5, 4, 5, 5, 7, 9]]
    for d, rates in enumerate(table):
        await env.go(0x43, d + 1)
        await env.result("AC-10", d + 1, 0x83, 0)
        env.check("AC-10", f"intervals for D = {d}", env.intervals, [32 * (r + 1) for r in rates])


@directed("AC-11", "P104-EX-03")
async def p104_ac_11_long_move(dut):
    """With a ramp of 100 steps, 1000 pulses last 1 795 008 cycles (AC-11)."""
    env = await Env.start(dut, None)
    await env.host.run("c 0A d C7 d 31 d 64 d 00 c 43 d E7 d 03 d 00")
    await env.bench.edge("int_n", 0, 2_000_000)
    pulses = env.bench.pulses()
    env.check("AC-11", "pulses", len(pulses), 1000)
    env.check("AC-11", "first to last edge", pulses[-1] - pulses[0], 1_795_008)
    first = [6400, 5984, 5600, 5312, 5056, 4832, 4640, 4480]
    env.check("AC-11", "first intervals", env.bench.intervals()[:8], first)


@directed("AC-12", "P104-RMP-03")
async def p104_ac_12_half_rounds_up(dut):
    """With RL 4, RH 0, PA 8, the rate at index 1, whose exact value is n + 1/2, is rounded up (AC-12)."""
    env = await Env.start(dut, None)
    await env.host.run("c 0A d 04 d 00 d 08 d 00 c 43 d 13 d 00 d 00")
    await env.idle()
    expected = [160, 96, 64, 64, *[32] * 11, 64, 64, 96, 160]
    env.check("AC-12", "intervals", env.bench.intervals(), expected)


@directed("AC-13", "P104-TIM-02", "P104-TIM-04")
async def p104_ac_13_first_pulse_and_phases(dut):
    """In the move of AC-09, pulse 1 occurs 80 to 82 cycles after hold falls, and s changes with each
    pulse (AC-13).
    """
    env = await Env.start(dut, INIT_A)
    pulses = await env.move(0x43, 14)
    env.window("AC-13", "hold fall to pulse 1", pulses[0] - env.bench.falls("hold")[0], 80, 82)
    env.check("AC-13", "edges of s", [t for t, _ in env.bench.edges("s", env.since)], pulses)


@directed("AC-14", "P104-TIM-05")
async def p104_ac_14_low_times(dut):
    """Low times are 80 cycles in the move of AC-09, and 16 cycles at rate 0 (AC-14)."""
    env = await Env.start(dut, INIT_A)
    await env.move(0x43, 14)
    env.check("AC-14", "low times", env.bench.low_times(env.since), [80] * 14)
    await env.move(0x44, 10, rate=0)
    env.check("AC-14", "intervals at rate 0", env.intervals, [32] * 9)
    env.check("AC-14", "low times at rate 0", env.bench.low_times(env.since), [16] * 9 + [80])


@directed("AC-15", "P104-EX-06", "P104-BCK-02")
async def p104_ac_15_csel_vsel(dut):
    """At rate 99, csel and vsel 11, 01, 10 and 00 produce the four intervals of EX-06 (AC-15)."""
    env = await Env.start(dut, INIT_A)
    for csel, vsel, interval in ((1, 1, 3200), (0, 1, 12800), (1, 0, 3320), (0, 0, 12920)):
        env.bench.set(csel=csel, vsel=vsel)
        await env.bench.clocks(4)
        await env.move(0x44, 5, rate=0x63)
        env.check("AC-15", f"intervals at csel {csel}, vsel {vsel}", env.intervals, [interval] * 4)


@directed("AC-16", "P104-BCK-02", "P104-BAD-16")
async def p104_ac_16_latched_at_start(dut):
    """If csel and vsel fall after pulse 2, the intervals of the move do not change (AC-16)."""
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 5, rate=0x63)
    await env.pulse(2, 10)
    env.bench.set(csel=0, vsel=0)
    await env.idle()
    env.check("AC-16", "intervals", env.intervals, [3200] * 4)


@directed("AC-17", "P104-END-01", "P104-RD-03", "P104-RD-04")
async def p104_ac_17_int_and_finish(dut):
    """At the end of a move of two pulses, INT falls with BUSY, and command 0x80 releases it (AC-17)."""
    env = await Env.start(dut, INIT_A)
    await env.go(0x43, 2)
    await env.busy_until(lambda: env.bench.level("int_n") == 0, "AC-17")
    env.check("AC-17", "BUSY after INT", await env.host.status() & BUSY, 0)
    late = env.bench.falls("int_n")[0] - env.bench.rises("pout_n")[-1]
    env.window("AC-17", "int_n after the last pout_n rise", late, 0, 4)
    env.check("AC-17", "first finish status", await env.host.run("c 80 r"), [0x83])
    env.check("AC-17", "int_n after 0x80", env.bench.level("int_n"), 1)
    env.check("AC-17", "second finish status", await env.host.run("c 80 r"), [0x03])


@directed("AC-18", "P104-CMD-02")
async def p104_ac_18_masked_interrupt(dut):
    """With I = 1, int_n stays 1 at the end of a move; the finish status is nevertheless marked as new
    (AC-18).
    """
    env = await Env.start(dut, INIT_A)
    await env.move(0x53, 2)
    env.check("AC-18", "int_n edges", env.bench.edges("int_n"), [])
    await env.result("AC-18", 2, 0x83, 0)


@directed("AC-19", "P104-END-07")
async def p104_ac_19_pending_interrupt(dut):
    """A pending INT stays pending until command 0x80 is executed, also during a single step with I = 1
    (AC-19).
    """
    env = await Env.start(dut, INIT_A)
    await env.move(0x42)
    await env.move(0x52)
    env.check("AC-19", "int_n levels so far", [v for _, v in env.bench.edges("int_n")], [0])
    env.check("AC-19", "finish status", await env.host.run("c 80 r"), [0x82])
    env.check("AC-19", "int_n after 0x80", env.bench.level("int_n"), 1)


@directed("AC-20", "P104-EX-10", "P104-END-06")
async def p104_ac_20_immediate_stop(dut):
    """In a move of 1000 pulses, command 0x40 after pulse 10 ends the move, and the remaining pulses read as
    989 (AC-20).
    """
    env = await Env.start(dut, INIT_A)
    await stopped_after_ten(env)
    env.check("AC-20", "pulses", len(env.pulses), 10)
    env.check("AC-20", "finish status", await env.host.run("c 80 r"), [0xC4])
    env.check("AC-20", "remaining", await env.host.run("c 83 rrr"), [0xDD, 0x03, 0x00])


@directed("AC-40", "P104-HSK-08", "P104-HSK-06")
async def p104_ac_40_queue_replaced(dut):
    """After the stimulus of AC-20, while two bytes of an answer are unread, the answer to command 0x80
    replaces them (AC-40).
    """
    env = await Env.start(dut, INIT_A)
    await stopped_after_ten(env)
    await env.host.run("c 80 r c 83 rrr")
    env.check("AC-40", "first byte, then 0x80", await env.host.run("c 83 r c 80 r"), [0xDD, 0x44])
    env.check("AC-40", "OBF", await env.host.status() & OBF, 0)
    env.check("AC-40", "stale byte", await env.host.read(0), 0x44)
    env.check("AC-40", "status after the stale read", await env.host.status() & (OBF | IBF), 0)


@directed("AC-21", "P104-END-06")
async def p104_ac_21_one_left(dut):
    """In a move of 2 pulses, command 0x40 after pulse 1 ends the move. One pulse is left, for which the
    remaining count is 0 (AC-21).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 2, rate=0x63)
    await env.pulse(1, 400)
    await env.host.run("c 40")
    await env.result("AC-21", 1, 0xC4, 0)


@directed("AC-22", "P104-FDC-02", "P104-EX-04")
async def p104_ac_22_forced_in_acceleration(dut):
    """With initialisation B, command 0x41 after pulse 4 or 1 mirrors the ramp, which results in 8 or 2 pulses
    (AC-22).
    """
    env = await Env.start(dut, INIT_B)
    for pulse, intervals in ((4, [640, 576, 512, 480, 512, 576, 640]), (1, [640])):
        await env.go(0x43, 1000)
        await env.pulse(pulse, 100)
        await env.host.run("c 41")
        await env.result("AC-22", 2 * pulse, 0xC3, 999 - 2 * pulse)
        env.check("AC-22", "intervals", env.intervals, intervals)


@directed("AC-23", "P104-EX-04", "P104-STP-04")
async def p104_ac_23_forced_from_plateau(dut):
    """With initialisation B, command 0x41 after pulse 29 results in 40 pulses; another one after pulse 33
    returns error 7 (AC-23).
    """
    env = await Env.start(dut, INIT_B)
    await env.go(0x43, 1000)
    await env.pulse(29, 50)
    env.check("AC-23", "status of the first 0x41", await env.host.command(0x41), 0x04)
    await env.pulse(33)
    env.check("AC-23", "status of the second 0x41", await env.host.command(0x41), 0xF4)
    await env.result("AC-23", 40, 0xC3, 0x0003BF)
    tail = [32 * (r + 1) for r in (9, 10, 10, 11, 12, 12, 14, 15, 17, 19)]
    env.check("AC-23", "tail after I(29)", env.intervals[29:], tail)


@directed("AC-24", "P104-PRO-05", "P104-STP-04")
async def p104_ac_24_natural_deceleration(dut):
    """With initialisation A and N = 14, command 0x41 after pulse 11 returns error 7, and the move outputs all
    pulses (AC-24).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x43, 14)
    await env.pulse(11, 50)
    env.check("AC-24", "status", await env.host.command(0x41), 0xF4)
    await env.result("AC-24", 14, 0x83, 0)
    env.check("AC-24", "intervals", env.intervals, A_INTERVALS)
