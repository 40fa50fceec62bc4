"""Acceptance checks AC-01 to AC-21 at the pins; stimulus and values are those of the acceptance table.

D = N - 1 is the number that a host sends for an operation of N pulses.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import F8, IBF, directed, rtl_only
from cocotb_tests.harness.axis_driver import indices, rates

from .env import Env
from .expected_timing import (
    BUILD_LATEST,
    CMND1,
    DATA_BYTES,
    ERROR,
    INIT_B,
    OPERATIONS,
    axis_of,
    kind_of,
)
from .nanoseconds import PHASES, SlowBus

B1 = "c 02 d 63 d 13 d 0A d 00"
AC_09 = [3200, 1728, 1344, 1120, 992, 896, 800, 768, 704, 672]
AC_09 = [*AC_09, *[640] * 4, *AC_09[::-1]]
EX_02 = {2: 3200, 3: 6400, 4: 8128, 10: 15_776, 11: 16_768, 20: 23_776, 21: 24_448, 22: 25_088}


@directed("AC-01", "P2104-PORT-01", "P2104-PORT-03", "P2104-STA-07", "P2104-GEN-01", "P2104-GEN-02")
async def p2104_ac_01_reset_levels(dut: Any) -> None:
    """After reset, all outputs, the status and the data register have their reset values (AC-01)."""
    env = await Env.start(dut)
    expected = {"int_n": 1, "pout_n": 3, "dir": 0, "hold": 3, "s1_n": 0x1F, "s2_n": 0x1F, "auxo": 3}
    env.check("AC-01", "outputs", env.outputs(), expected)
    env.check("AC-01", "d_oe", env.bench.level("d_oe"), 0)
    env.check("AC-01", "status", await env.host.status(), 0x00)
    env.check("AC-01", "data register", await env.host.read(0), 0x00)


@directed("AC-02", "P2104-RD-01", "P2104-RD-04", "P2104-RD-05", "P2104-RD-06", "P2104-RD-07", "P2104-PHS-02")
async def p2104_ac_02_reads_after_reset(dut: Any) -> None:
    """After reset, reads of both axes return the reset values (AC-02)."""
    env = await Env.start(dut)
    for axis in env.axes:
        reads = [await axis.fetch(code) for code in (0x80, 0x81, 0x82)]
        reads += [await axis.fetch(0x83, 3), await axis.fetch(0x86)]
        env.check("AC-02", f"reads of axis {axis.n}", reads, [[0], [0xCF], [0xFC], [0, 0, 0], [0]])


@rtl_only("nanoseconds of the bus, which the model counts in cycles")
@directed(
    "AC-03",
    "P2104-BUS-05",
    "P2104-BUS-20",
    "P2104-BUS-21",
    "P2104-BUS-01",
    "P2104-BUS-02",
    exact="it sweeps the phase of strobes that are shorter than two cycles",
)
async def p2104_ac_03_write_times_of_the_data_sheet(dut: Any) -> None:
    """Writes with strobes of 120 ns and data valid for 80 ns are accepted at any phase, in both styles
    (AC-03).
    """
    env = await Env.start(dut)
    bus = SlowBus(env)
    for busc in (0, 1):
        await env.style(busc)
        for phase in PHASES:
            for code, auxo in ((0xC1, 3), (0xD1, 2), (0xE1, 1), (0xF1, 0)):
                await bus.phase(phase)
                end = await bus.write(1, code)
                await env.bench.until(end + 12)
                what = f"auxo after {code:#x}, busc {busc}, phase {phase}/16"
                env.check("AC-03", what, env.bench.level("auxo"), auxo)


@rtl_only("nanoseconds of the bus, which the model counts in cycles")
@directed("AC-04", "P2104-BUS-06", "P2104-BUS-20", "P2104-BUS-21")
async def p2104_ac_04_read_times_of_the_data_sheet(dut: Any) -> None:
    """In read strobes of 120 ns, the status is valid from 100 ns to the end (AC-04)."""
    env = await Env.start(dut)
    bus = SlowBus(env)
    await env.host.command(0x87)
    for busc in (0, 1):
        await env.style(busc)
        for phase in PHASES:
            await bus.phase(phase)
            samples = await bus.read(1, rest=200)
            env.check("AC-04", f"busc {busc}, phase {phase}/16", samples, [(1, 0x80)] * 2)


@rtl_only("nanoseconds of the bus, which the model counts in cycles")
@directed("AC-05", "P2104-BUS-07", "P2104-STA-03")
async def p2104_ac_05_no_invisible_write(dut: Any) -> None:
    """If the status is read 75 ns after an unexpected data byte, IBF or ERROR is 1 (AC-05)."""
    env = await Env.start(dut)
    bus = SlowBus(env)
    for busc in (0, 1):
        await env.style(busc)
        for phase in PHASES:
            await env.reset()
            await bus.phase(phase)
            await bus.write(0, 0x55, rest=75 - 10 - 20)
            (_, (_, status)) = await bus.read(1, rest=400)
            env.check("AC-05", f"status {status:#x} tells", bool(status & (IBF | ERROR)), True)


@directed("AC-06", "P2104-CMD-01", "P2104-CMD-03", "P2104-ERR-04", "P2104-ERR-01", "P2104-BAD-01")
async def p2104_ac_06_all_codes(dut: Any) -> None:
    """Each of the 256 codes, sent after a reset in both styles, sets the documented errors (AC-06)."""
    env = await Env.start(dut)
    counts = {"undefined": 0, "initial": 0, "data": 0, "free": 0}
    for number in range(512):
        busc, code = divmod(number, 256)
        await env.style(busc)
        await env.reset()
        kind, axis = kind_of(code), axis_of(code)
        status = await env.host.command(code)
        if kind == "undefined":
            group, error = "undefined", 1
        elif kind in OPERATIONS or kind == "stop":
            group, error = "initial", 4
        else:
            group, error = ("data" if kind in DATA_BYTES else "free"), 0
        counts[group] += 1
        if group == "data":
            env.check("AC-06", f"status after {code:#04x}", status, CMND1 << axis - 1)
            continue
        env.check("AC-06", f"ERROR after {code:#04x}", status & 0xBC, ERROR if error else 0)
        want = (error, 0) if axis == 1 else (0, error)
        env.check("AC-06", f"errors after {code:#04x}", await env.errors(), want)
    wanted_counts = {"undefined": 107, "initial": 80, "data": 52, "free": 17}
    env.check("AC-06", "codes", {group: count // 2 for group, count in counts.items()}, wanted_counts)


@directed("AC-07", "P2104-STA-05", "P2104-HSK-05")
async def p2104_ac_07_cmnd(dut: Any) -> None:
    """From the first byte of a setting until its table is built, CMND of its axis is 1 (AC-07)."""
    env = await Env.start(dut)
    for code, cmnd in (("02", 0x10), ("22", 0x20)):
        got = await env.statuses(f"c {code} d 63 d 13 d 0A d 00")
        env.check("AC-07", f"statuses of {code}", got, [cmnd] * 5)
        begin = env.bench.now
        await env.host.poll(0xFF, 0x00)
        env.window("AC-07", "cycles until the table is ready", env.bench.now - begin, 1, BUILD_LATEST)


@directed("AC-08", "P2104-INI-04", "P2104-RD-05")
async def p2104_ac_08_first_pattern(dut: Any) -> None:
    """When the setting of axis 1 is accepted, s1_n changes to pattern 0, and s2_n stays off (AC-08)."""
    env = await Env.start(dut)
    await env.run(B1)
    env.check("AC-08", "s1_n, s2_n", [axis.phases_now for axis in env.axes], [0b11100, 0b11111])
    await env.x1.ready()
    env.check("AC-08", "0x82", await env.run("c 82 r"), [0x3C])


@directed("AC-09", "P2104-EX-01", "P2104-PRO-02", "P2104-GEN-05")
async def p2104_ac_09_trapezoid(dut: Any) -> None:
    """With ramp B, 25 pulses have the trapezoidal profile of EX-01 (AC-09)."""
    env = await Env.start(dut)
    await env.ready(1, INIT_B)
    await env.run("c 43 d 18 d 00 d 00")
    await env.x1.idle()
    pulses = env.x1.pulses
    env.check("AC-09", "intervals", env.x1.intervals, AC_09)
    env.check("AC-09", "first to last", pulses[-1] - pulses[0], 27_008)
    env.check("AC-09", "s1_n at the end", env.x1.phases_now, 0b11001)
    env.check("AC-09", "pulses of axis 2", env.x2.pulses, [])
    env.check("AC-09", "edges of s2_n", env.bench.edges("s2_n"), [])


@directed("AC-10", "P2104-EX-02", "P2104-PRO-03", "P2104-PRO-01")
async def p2104_ac_10_triangles(dut: Any) -> None:
    """With ramp B and D = 0 to 21, pulse counts, intervals and sums are those of EX-02 (AC-10)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for d in (0, 1, 2, 3, 9, 10, 19, 20, 21):
        pulses = await axis.move(0x43, d + 1)
        env.check("AC-10", f"pulses for D = {d}", len(pulses), d + 1)
        expected = [32 * (r + 1) for r in rates(INIT_B[1:], indices(d + 1, 10))]
        env.check("AC-10", f"intervals for D = {d}", axis.intervals, expected)
        env.check("AC-10", f"sum for D = {d}", pulses[-1] - pulses[0], EX_02.get(d + 1, 0))


@directed("AC-11", "P2104-RMP-03", "P2104-EX-07")
async def p2104_ac_11_half_rounds_up(dut: Any) -> None:
    """With RL 3, RH 1, PA 25, the rate at index 13, whose exact value is n + 1/2, is rounded up (AC-11)."""
    env = await Env.start(dut)
    await env.run("c 02 d 03 d 01 d 19 d 00 c 43 d 3B d 00 d 00")
    await env.x1.idle()
    expected = [*[128] * 3, *[96] * 11, *[64] * 31, *[96] * 11, *[128] * 3]
    env.check("AC-11", "intervals", env.x1.intervals, expected)
    env.check("AC-11", "sum", sum(env.x1.intervals), 4864)


@directed("AC-12", "P2104-EX-15", "P2104-RMP-04", builds=(F8,))
async def p2104_ac_12_largest_ramp(dut: Any) -> None:
    """With RL 255, RH 18 and PA 11220, 30 000 pulses last 30 002 080 periods of 16 MHz (AC-12).

    The test runs at 8 MHz, where one cycle is two of these periods: the values are the same in half the
    number of cycles.
    """
    env = await Env.start(dut)
    await env.run("c 02 d FF d 12 d D4 d 2B c 43 d 2F d 75 d 00")
    await env.bench.edge("int_n", 0, 16_000_000)
    pulses = env.x1.pulses
    env.check("AC-12", "pulses", len(pulses), 30_000)
    env.check("AC-12", "first intervals", [2 * i for i in env.x1.intervals[:4]], [8192, 8128, 8064, 8000])
    env.check("AC-12", "first to last", 2 * (pulses[-1] - pulses[0]), 30_002_080)


@directed("AC-13", "P2104-TIM-01", "P2104-TIM-04", "P2104-TIM-05")
async def p2104_ac_13_first_pulse_and_phases(dut: Any) -> None:
    """In the move of AC-09, pulse 1 occurs 80 to 82 cycles after hold falls, and s1_n changes with each pulse
    (AC-13).
    """
    env = await Env.start(dut)
    for axis in await env.both(INIT_B):
        pulses = await axis.move(0x43, 25)
        (fall, _), *_ = axis.edges("hold")
        env.window("AC-13", "hold fall to pulse 1", pulses[0] - fall, 80, 82)
        env.check("AC-13", "dir edges", axis.edges("dir"), [])
        steps = [t for t, _ in env.bench.edges(axis.phases, axis.since)]
        env.check("AC-13", f"edges of {axis.phases}", steps, pulses)
        env.check("AC-13", "low times", axis.low_times, [80] * 25)


@directed("AC-14", "P2104-EX-13", "P2104-TIM-05")
async def p2104_ac_14_low_times(dut: Any) -> None:
    """At rates 1 and 2, whose intervals are short, the low time is half the interval; at rate 3 it is 80
    cycles (AC-14).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for rate, interval, low in ((1, 64, 32), (2, 96, 48), (3, 128, 80)):
        await axis.move(0x44, 4, rate)
        env.check("AC-14", f"intervals at rate {rate}", axis.intervals, [interval] * 3)
        env.check("AC-14", f"low times at rate {rate}", axis.low_times, [low] * 3 + [80])


@directed("AC-15", "P2104-EX-08", "P2104-BCK-01", "P2104-BCK-02", "P2104-INTV-01")
async def p2104_ac_15_csel(dut: Any) -> None:
    """At rate 49, intervals are 1600 cycles with csel = 1 and 6400 cycles with csel = 0. If csel falls during
    the motion, they stay 1600 cycles (AC-15).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for csel, later, interval in ((1, 1, 1600), (0, 0, 6400), (1, 0, 1600)):
        axis.set(csel=csel)
        await env.bench.clocks(4)
        await axis.go(0x44, 5, 0x31)
        await axis.pulse(2)
        axis.set(csel=later)
        await axis.idle()
        env.check("AC-15", f"intervals at csel {csel}, {later}", axis.intervals, [interval] * 4)


@directed("AC-16", "P2104-END-01", "P2104-RD-03", "P2104-INT-05")
async def p2104_ac_16_end_interrupt(dut: Any) -> None:
    """At the end of a step int_n falls. Code 80 returns 82 and releases int_n; a second read returns 02
    (AC-16).
    """
    env = await Env.start(dut)
    await env.ready(1, INIT_B)
    await env.run("c 42")
    await env.x1.idle()
    late = env.bench.falls("int_n")[0] - env.bench.rises("pout_n[1]")[-1]
    env.window("AC-16", "int_n after the rise of pout_n", late, 0, 4)
    env.check("AC-16", "first end status", await env.run("c 80 r"), [0x82])
    env.check("AC-16", "int_n", env.bench.level("int_n"), 1)
    env.check("AC-16", "second end status", await env.run("c 80 r"), [0x02])


@directed("AC-17", "P2104-CMD-02")
async def p2104_ac_17_no_interrupt(dut: Any) -> None:
    """With I = 1, int_n stays high at the end of a step; the end status is nevertheless marked as new
    (AC-17).
    """
    env = await Env.start(dut)
    await env.ready(1, INIT_B)
    await env.run("c 52")
    await env.x1.idle()
    env.check("AC-17", "end status", await env.run("c 80 r"), [0x82])
    env.check("AC-17", "int_n edges", env.bench.edges("int_n"), [])


@directed("AC-18", "P2104-INT-01", "P2104-INT-02", "P2104-INT-03")
async def p2104_ac_18_two_causes(dut: Any) -> None:
    """If an end of each axis is pending, int_n is high for 5 us after the first end-status read, then low
    until the second (AC-18).
    """
    env = await Env.start(dut)
    first, second = await env.both(INIT_B)
    await env.run("c 42 c 62")
    await first.idle()
    await second.idle()
    env.check("AC-18", "int_n", env.bench.level("int_n"), 0)
    since = env.bench.now
    await env.run("c 80 r")
    await env.bench.clocks(200)
    (up, _), (down, _) = env.bench.edges("int_n", since)
    env.window("AC-18", "int_n H after 80", down - up, 80, 82)
    env.check("AC-18", "A0", await env.run("c A0 r"), [0x82])
    await env.bench.clocks(400)
    env.check("AC-18", "edges of int_n", [v for _, v in env.bench.edges("int_n", since)], [1, 0, 1])


@directed("AC-19", "P2104-INT-01", "P2104-INT-02", "P2104-INT-03")
async def p2104_ac_19_four_causes(dut: Any) -> None:
    """If both axes have an end and an error, each of four reads releases int_n once (AC-19)."""
    env = await Env.start(dut, errint_n=0)
    first, second = await env.both(INIT_B)
    await env.run("c 42 c 62")
    await first.idle()
    await second.idle()
    await env.run("c 87 c A7")
    since, answers = env.bench.now, []
    for code in ("80", "86", "A6", "A0"):
        answers += await env.run(f"c {code} r")
        await env.bench.clocks(200)
    edges = env.bench.edges("int_n", since)
    env.check("AC-19", "levels of int_n", [v for _, v in edges], [1, 0, 1, 0, 1, 0, 1])
    for (up, _), (down, _) in zip(edges[0:6:2], edges[1:6:2], strict=True):
        env.window("AC-19", "release", down - up, 80, 82)
    env.check("AC-19", "answers", answers, [0x82, 0x01, 0x01, 0x82])


@directed("AC-20", "P2104-INT-04")
async def p2104_ac_20_only_its_own_read(dut: Any) -> None:
    """While only an error of axis 1 is pending, reads of other registers do not change int_n (AC-20)."""
    env = await Env.start(dut, errint_n=0)
    await env.run("c 87")
    since = env.bench.now
    await env.run("c 80 r c A0 r c A6 r")
    await env.bench.clocks(200)
    env.check("AC-20", "edges of int_n", env.bench.edges("int_n", since), [])
    env.check("AC-20", "int_n", env.bench.level("int_n"), 0)
    env.check("AC-20", "86", await env.run("c 86 r"), [0x01])
    await env.bench.clocks(200)
    env.check("AC-20", "levels of int_n", [v for _, v in env.bench.edges("int_n", since)], [1])


@directed("AC-21", "P2104-INT-01", "P2104-INT-02", "P2104-LIM-08")
async def p2104_ac_21_errint(dut: Any) -> None:
    """An error that occurs while errint_n is high never asserts int_n, also not when errint_n falls later. An
    error that occurs while errint_n is low asserts int_n, which stays low when errint_n rises (AC-21).
    """
    env = await Env.start(dut)
    await env.run("c 87")
    env.bench.set(errint_n=0)
    await env.bench.clocks(20)
    env.check("AC-21", "status", await env.run("s"), [0x80])
    env.check("AC-21", "edges of int_n", env.bench.edges("int_n"), [])
    await env.run("c 87")
    env.bench.set(errint_n=1)
    await env.bench.clocks(400)
    env.check("AC-21", "levels of int_n", [v for _, v in env.bench.edges("int_n")], [0])
