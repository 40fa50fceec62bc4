"""Black-box acceptance checks AC-01 to AC-24: stimulus and values as in the acceptance table."""

from __future__ import annotations

from cocotb_tests.harness import BUSY, IBF, OBF, STATUS, directed

from .env import Lab
from .expected_timing import INIT_A, INIT_B

A_DATA = "d 09 d 04 d 04 d 00"
A_INTERVALS = [320, 256, 192, 192, *[160] * 5, 192, 192, 256, 320]


def kind_of(code: int) -> str:
    """Return the kind of a command code; it follows from the code map alone (P104-CMD-01)."""
    low = code & 7
    if code < 0x40:
        return "init" if code & 3 else "undefined"
    if code < 0x80:
        return "stop" if low < 2 else "operation"
    if code < 0xC0:
        names = {0x80: "read", 0x81: "read", 0x82: "read", 0x83: "read", 0x85: "read"}
        return names.get(code, {0x84: "switching", 0x86: "aux"}.get(code, "undefined"))
    return {0: "off", 1: "on", 2: "off", 3: "operation", 6: "operation"}.get(low, "undefined")


async def stopped_after_ten(lab: Lab) -> None:
    """Run the stimulus of AC-20: 1000 pulses at rate 99, stopped 400 cycles after the tenth."""
    await lab.go(0x44, 1000, rate=0x63)
    await lab.pulse(10, 400)
    await lab.host.run("c 40")
    await lab.idle()


@directed("AC-01", "P104-PORT-01", "P104-PORT-03", "P104-STA-07")
async def p104_ac_01_reset_levels(dut):
    """After reset, all outputs, the status and the data register have their reset values (AC-01)."""
    lab = await Lab.start(dut, None)
    expected = {"int_n": 1, "pout_n": 1, "hold": 1, "dir": 0, "aux_n": 1, "auxo": 0xF, "s": 0x1F}
    lab.check("AC-01", "outputs", lab.outputs(), expected)
    lab.check("AC-01", "d_oe", lab.bench.level("d_oe"), 0)
    lab.check("AC-01", "status", await lab.host.status(), 0x00)
    lab.check("AC-01", "data register", await lab.host.read(0), 0x00)


@directed("AC-02", "P104-BUS-05")
async def p104_ac_02_read_strobe(dut):
    """During a status read of 6 cycles, d_oe and d_o change within their windows (AC-02)."""
    lab = await Lab.start(dut, None)
    bench = lab.bench
    first = bench.set(a0=STATUS, cs_n=0, rd_n=0)
    await bench.clocks(6)
    after = bench.set(cs_n=1, rd_n=1)
    await bench.clocks(8)
    (on, _), (off, _) = bench.edges("d_oe", first)
    lab.window("AC-02", "d_oe rise after edge 0", on - first, 0, 2)
    lab.window("AC-02", "d_oe fall after edge 0'", off - after, 0, 2)
    lab.check("AC-02", "d_o changes in the strobe", bench.edges("d_o", first + 3), [])


@directed("AC-03", "P104-ERR-01", "P104-FSM-01")
async def p104_ac_03_not_initialised(dut):
    """Before initialisation, operations return error 2 and stops error 0, and nothing moves (AC-03)."""
    lab = await Lab.start(dut, None)
    got = await lab.statuses("c 42 c 40 c 41 c 46 c C3 d 00")
    lab.check("AC-03", "statuses", got, [0xA0, 0x80, 0x80, 0xA0, 0xA0, 0xB0])
    await lab.bench.clocks(500)
    lab.check("AC-03", "pulses", lab.bench.pulses(), [])
    lab.check("AC-03", "hold edges", lab.bench.edges("hold"), [])


@directed("AC-04", "P104-CMD-01", "P104-CMD-03", "P104-STA-06")
async def p104_ac_04_all_codes(dut):
    """Each of the 256 codes, sent after a reset, sets the status of its kind (AC-04)."""
    lab = await Lab.start(dut, None)
    status = {"undefined": 0x80, "stop": 0x80, "operation": 0xA0, "init": 0x40, "switching": 0x20}
    status |= {"aux": 0x10, "read": 0x01, "on": 0x00, "off": 0x00}
    count = 0
    for code in range(256):
        await lab.bench.reset()
        await lab.bench.clocks(6)
        kind = kind_of(code)
        count += kind == "undefined"
        lab.check("AC-04", f"status after {code:#04x}", await lab.host.command(code), status[kind])
    lab.check("AC-04", "number of undefined codes", count, 97)


@directed("AC-05", "P104-INI-02", "P104-STA-05")
async def p104_ac_05_init_counts_down(dut):
    """NUM counts 4, 3, 2, 1, 0 during the bytes of initialisation A (AC-05)."""
    lab = await Lab.start(dut, None)
    got = await lab.statuses(f"c 0A {A_DATA}")
    lab.check("AC-05", "statuses", got, [0x40, 0x30, 0x20, 0x10, 0x00])


@directed("AC-06", "P104-INI-05", "P104-RD-06")
async def p104_ac_06_first_pattern(dut):
    """When initialisation A is accepted, s has pattern 0, and 0x82 returns it (AC-06)."""
    lab = await Lab.start(dut, None)
    await lab.host.run(f"c 0A {A_DATA}")
    lab.check("AC-06", "s", lab.bench.level("s"), 0b00011)
    lab.check("AC-06", "0x82", await lab.host.run("c 82 r"), [0xC4])


@directed("AC-07", "P104-PHS-01")
async def p104_ac_07_negative_logic(dut):
    """With negative logic, s is inverted, and 0x82 returns the pin levels (AC-07)."""
    lab = await Lab.start(dut, None)
    await lab.host.run(f"c 02 {A_DATA}")
    lab.check("AC-07", "s", lab.bench.level("s"), 0b11100)
    lab.check("AC-07", "0x82", await lab.host.run("c 82 r"), [0x3C])


@directed("AC-08", "P104-RD-06", "P104-PHS-02", "P104-RD-05")
async def p104_ac_08_reads_after_reset(dut):
    """After reset, the registers return 0xFC, 0xCF and 0x00 (AC-08)."""
    lab = await Lab.start(dut, None)
    lab.check("AC-08", "reads", await lab.host.run("c 82 r c 81 r c 80 r"), [0xFC, 0xCF, 0x00])


@directed("AC-09", "P104-EX-01", "P104-PRO-02")
async def p104_ac_09_trapezoid(dut):
    """With initialisation A, 14 pulses have the trapezoidal profile of EX-01 (AC-09)."""
    lab = await Lab.start(dut, None)
    await lab.host.run(f"c 0A {A_DATA} c 43 d 0D d 00 d 00")
    await lab.idle()
    lab.check("AC-09", "intervals", lab.bench.intervals(), A_INTERVALS)
    lab.check("AC-09", "s at the end", lab.bench.level("s"), 0b01100)


@directed("AC-10", "P104-EX-02", "P104-PRO-03")
async def p104_ac_10_triangles(dut):
    """With initialisation A and D = 0 to 9, pulse counts and rates are those of EX-02 (AC-10)."""
    lab = await Lab.start(dut, INIT_A)
    table = [[], [9], [9, 9], [9, 7, 9], [9, 7, 7, 9], [9, 7, 5, 7, 9], [9, 7, 5, 5, 7, 9]]
    table += [[9, 7, 5, 5, 5, 7, 9], [9, 7, 5, 5, 5, 5, 7, 9], [9, 7, 5, 5, 4, 5, 5, 7, 9]]
    for d, rates in enumerate(table):
        await lab.go(0x43, d + 1)
        await lab.result("AC-10", d + 1, 0x83, 0)
        lab.check("AC-10", f"intervals for D = {d}", lab.intervals, [32 * (r + 1) for r in rates])


@directed("AC-11", "P104-EX-03")
async def p104_ac_11_long_move(dut):
    """With a ramp of 100 steps, 1000 pulses last 1 795 008 cycles (AC-11)."""
    lab = await Lab.start(dut, None)
    await lab.host.run("c 0A d C7 d 31 d 64 d 00 c 43 d E7 d 03 d 00")
    await lab.bench.edge("int_n", 0, 2_000_000)
    pulses = lab.bench.pulses()
    lab.check("AC-11", "pulses", len(pulses), 1000)
    lab.check("AC-11", "first to last edge", pulses[-1] - pulses[0], 1_795_008)
    first = [6400, 5984, 5600, 5312, 5056, 4832, 4640, 4480]
    lab.check("AC-11", "first intervals", lab.bench.intervals()[:8], first)


@directed("AC-12", "P104-RMP-03")
async def p104_ac_12_half_rounds_up(dut):
    """With RL 4, RH 0, PA 8, the exact half at index 1 is rounded up (AC-12)."""
    lab = await Lab.start(dut, None)
    await lab.host.run("c 0A d 04 d 00 d 08 d 00 c 43 d 13 d 00 d 00")
    await lab.idle()
    expected = [160, 96, 64, 64, *[32] * 11, 64, 64, 96, 160]
    lab.check("AC-12", "intervals", lab.bench.intervals(), expected)


@directed("AC-13", "P104-TIM-02", "P104-TIM-04")
async def p104_ac_13_first_pulse_and_phases(dut):
    """In the move of AC-09, pulse 1 occurs 80 to 82 cycles after hold falls, and s changes with each
    pulse (AC-13).
    """
    lab = await Lab.start(dut, INIT_A)
    pulses = await lab.move(0x43, 14)
    lab.window("AC-13", "hold fall to pulse 1", pulses[0] - lab.bench.falls("hold")[0], 80, 82)
    lab.check("AC-13", "edges of s", [t for t, _ in lab.bench.edges("s", lab.since)], pulses)


@directed("AC-14", "P104-TIM-05")
async def p104_ac_14_low_times(dut):
    """Low times are 80 cycles in the move of AC-09, and 16 cycles at rate 0 (AC-14)."""
    lab = await Lab.start(dut, INIT_A)
    await lab.move(0x43, 14)
    lab.check("AC-14", "low times", lab.bench.low_times(lab.since), [80] * 14)
    await lab.move(0x44, 10, rate=0)
    lab.check("AC-14", "intervals at rate 0", lab.intervals, [32] * 9)
    lab.check("AC-14", "low times at rate 0", lab.bench.low_times(lab.since), [16] * 9 + [80])


@directed("AC-15", "P104-EX-06", "P104-BCK-02")
async def p104_ac_15_csel_vsel(dut):
    """At rate 99, csel and vsel 11, 01, 10 and 00 produce the four intervals of EX-06 (AC-15)."""
    lab = await Lab.start(dut, INIT_A)
    for csel, vsel, interval in ((1, 1, 3200), (0, 1, 12800), (1, 0, 3320), (0, 0, 12920)):
        lab.bench.set(csel=csel, vsel=vsel)
        await lab.bench.clocks(4)
        await lab.move(0x44, 5, rate=0x63)
        lab.check("AC-15", f"intervals at csel {csel}, vsel {vsel}", lab.intervals, [interval] * 4)


@directed("AC-16", "P104-BCK-02", "P104-BAD-16")
async def p104_ac_16_latched_at_start(dut):
    """The intervals of a move do not change when csel and vsel fall after pulse 2 (AC-16)."""
    lab = await Lab.start(dut, INIT_A)
    await lab.go(0x44, 5, rate=0x63)
    await lab.pulse(2, 10)
    lab.bench.set(csel=0, vsel=0)
    await lab.idle()
    lab.check("AC-16", "intervals", lab.intervals, [3200] * 4)


@directed("AC-17", "P104-END-01", "P104-RD-03", "P104-RD-04")
async def p104_ac_17_int_and_finish(dut):
    """At the end of a move of two pulses, INT falls with BUSY, and 0x80 releases it (AC-17)."""
    lab = await Lab.start(dut, INIT_A)
    await lab.go(0x43, 2)
    await lab.busy_until(lambda: lab.bench.level("int_n") == 0, "AC-17")
    lab.check("AC-17", "BUSY after INT", await lab.host.status() & BUSY, 0)
    late = lab.bench.falls("int_n")[0] - lab.bench.rises("pout_n")[-1]
    lab.window("AC-17", "int_n after the last pout_n rise", late, 0, 4)
    lab.check("AC-17", "first finish status", await lab.host.run("c 80 r"), [0x83])
    lab.check("AC-17", "int_n after 0x80", lab.bench.level("int_n"), 1)
    lab.check("AC-17", "second finish status", await lab.host.run("c 80 r"), [0x03])


@directed("AC-18", "P104-CMD-02")
async def p104_ac_18_masked_interrupt(dut):
    """With I = 1, int_n stays 1 at the end of a move, and the finish status is still marked as new
    (AC-18).
    """
    lab = await Lab.start(dut, INIT_A)
    await lab.move(0x53, 2)
    lab.check("AC-18", "int_n edges", lab.bench.edges("int_n"), [])
    await lab.result("AC-18", 2, 0x83, 0)


@directed("AC-19", "P104-END-07")
async def p104_ac_19_pending_interrupt(dut):
    """A pending INT stays pending through a masked step until 0x80 (AC-19)."""
    lab = await Lab.start(dut, INIT_A)
    await lab.move(0x42)
    await lab.move(0x52)
    lab.check("AC-19", "int_n levels so far", [v for _, v in lab.bench.edges("int_n")], [0])
    lab.check("AC-19", "finish status", await lab.host.run("c 80 r"), [0x82])
    lab.check("AC-19", "int_n after 0x80", lab.bench.level("int_n"), 1)


@directed("AC-20", "P104-EX-10", "P104-END-06")
async def p104_ac_20_immediate_stop(dut):
    """In a move of 1000 pulses, 0x40 after pulse 10 ends it there, and the remaining pulses read as 989
    (AC-20).
    """
    lab = await Lab.start(dut, INIT_A)
    await stopped_after_ten(lab)
    lab.check("AC-20", "pulses", len(lab.pulses), 10)
    lab.check("AC-20", "finish status", await lab.host.run("c 80 r"), [0xC4])
    lab.check("AC-20", "remaining", await lab.host.run("c 83 rrr"), [0xDD, 0x03, 0x00])


@directed("AC-40", "P104-HSK-08", "P104-HSK-06")
async def p104_ac_40_queue_replaced(dut):
    """When 0x80 is executed with two unread bytes after AC-20, its byte replaces them (AC-40)."""
    lab = await Lab.start(dut, INIT_A)
    await stopped_after_ten(lab)
    await lab.host.run("c 80 r c 83 rrr")
    lab.check("AC-40", "first byte, then 0x80", await lab.host.run("c 83 r c 80 r"), [0xDD, 0x44])
    lab.check("AC-40", "OBF", await lab.host.status() & OBF, 0)
    lab.check("AC-40", "stale byte", await lab.host.read(0), 0x44)
    lab.check("AC-40", "status after the stale read", await lab.host.status() & (OBF | IBF), 0)


@directed("AC-21", "P104-END-06")
async def p104_ac_21_one_left(dut):
    """In a move of 2 pulses, 0x40 after pulse 1 leaves one pulse, and the remaining pulses read as 0
    (AC-21).
    """
    lab = await Lab.start(dut, INIT_A)
    await lab.go(0x44, 2, rate=0x63)
    await lab.pulse(1, 400)
    await lab.host.run("c 40")
    await lab.result("AC-21", 1, 0xC4, 0)


@directed("AC-22", "P104-FDC-02", "P104-EX-04")
async def p104_ac_22_forced_in_acceleration(dut):
    """With initialisation B, 0x41 after pulse 4 or 1 mirrors the ramp to 8 or 2 pulses (AC-22)."""
    lab = await Lab.start(dut, INIT_B)
    for pulse, intervals in ((4, [640, 576, 512, 480, 512, 576, 640]), (1, [640])):
        await lab.go(0x43, 1000)
        await lab.pulse(pulse, 100)
        await lab.host.run("c 41")
        await lab.result("AC-22", 2 * pulse, 0xC3, 999 - 2 * pulse)
        lab.check("AC-22", "intervals", lab.intervals, intervals)


@directed("AC-23", "P104-EX-04", "P104-STP-04")
async def p104_ac_23_forced_from_plateau(dut):
    """With initialisation B, 0x41 after pulse 29 leads to 40 pulses; 0x41 again after pulse 33 returns
    error 7 (AC-23).
    """
    lab = await Lab.start(dut, INIT_B)
    await lab.go(0x43, 1000)
    await lab.pulse(29, 50)
    lab.check("AC-23", "status of the first 0x41", await lab.host.command(0x41), 0x04)
    await lab.pulse(33)
    lab.check("AC-23", "status of the second 0x41", await lab.host.command(0x41), 0xF4)
    await lab.result("AC-23", 40, 0xC3, 0x0003BF)
    tail = [32 * (r + 1) for r in (9, 10, 10, 11, 12, 12, 14, 15, 17, 19)]
    lab.check("AC-23", "tail after I(29)", lab.intervals[29:], tail)


@directed("AC-24", "P104-PRO-05", "P104-STP-04")
async def p104_ac_24_natural_deceleration(dut):
    """With initialisation A and N = 14, 0x41 after pulse 11 returns error 7, and the move is complete
    (AC-24).
    """
    lab = await Lab.start(dut, INIT_A)
    await lab.go(0x43, 14)
    await lab.pulse(11, 50)
    lab.check("AC-24", "status", await lab.host.command(0x41), 0xF4)
    await lab.result("AC-24", 14, 0x83, 0)
    lab.check("AC-24", "intervals", lab.intervals, A_INTERVALS)
