"""Acceptance checks AC-22 to AC-44 at the pins: errors, stops, limits.

I(j) is the interval that follows pulse j.
"""

from __future__ import annotations

from itertools import repeat
from typing import Any

from cocotb_tests.harness import OBF, directed

from .env import Axis, Env
from .expected_timing import BUSY1, INIT_B
from .tb_acceptance_moves import AC_09, B1

E7 = "d E7 d 03 d 00"
EX_03 = {5: [99, 53, 41, 34, 30, 34, 41, 53, 99], 2: [99, 53, 99], 1: []}


def clk(rates: list[int]) -> list[int]:
    """Return the intervals in cycles for rates of the 500 kHz base clock."""
    return [32 * (rate + 1) for rate in rates]


async def stop_after_pulse(axis: Axis, j: int, code: int = 0x41, n: int = 1000) -> int:
    """Start a move of n pulses and send a stop code 100 cycles after pulse j.

    Return the status after the stop code.
    """
    await axis.go(0x43, n)
    await axis.pulse(j, 100)
    return await axis.command(code)


@directed("AC-22", "P2104-ERR-06", "P2104-STA-06")
async def p2104_ac_22_error_bit(dut: Any) -> None:
    """If both axes have an error, two Error code reads are necessary to clear ERROR: one for each axis
    (AC-22).
    """
    env = await Env.start(dut)
    got = await env.run("c 87 c A7 s e1 s e2 s e2")
    env.check("AC-22", "status, e1, status, e2, status, e2", got, [0x80, 1, 0x80, 1, 0x00, 0])


@directed("AC-23", "P2104-ERR-01", "P2104-ERR-02")
async def p2104_ac_23_data_without_need(dut: Any) -> None:
    """An unexpected data byte sets error 2 on axis 1 (AC-23)."""
    env = await Env.start(dut)
    env.check("AC-23", "e2, e1", await env.run("d 55 e2 e1"), [0, 2])


@directed("AC-24", "P2104-ERR-02", "P2104-BAD-04")
async def p2104_ac_24_code_in_a_data_wait(dut: Any) -> None:
    """If a step of axis 2 is sent during an incomplete operation of axis 1, error 3 is set on axis 2, and
    both instructions are dropped (AC-24).
    """
    env = await Env.start(dut)
    first, second = await env.both(INIT_B)
    since = env.bench.now
    env.check("AC-24", "status, e1, e2", await env.run("c 43 d 05 c 62 s e1 e2"), [0x80, 0, 3])
    await env.bench.clocks(200)
    env.quiet("AC-24", since)
    await second.move(0x42)
    env.check("AC-24", "pulses", (len(env.bench.pulses(since, first.pout)), len(second.pulses)), (0, 1))


@directed("AC-25", "P2104-ERR-01")
async def p2104_ac_25_axisless_code_in_a_data_wait(dut: Any) -> None:
    """During an incomplete operation, code C2 sets error 3 on axis 1 and returns no answer (AC-25)."""
    env = await Env.start(dut)
    await env.run(B1)
    await env.x1.ready()
    (status,) = await env.run("c 43 c C2 s")
    env.check("AC-25", "OBF", status & OBF, 0)
    env.check("AC-25", "e1", await env.run("e1"), [3])
    env.check(
        "AC-25", "e1, e2 after F1, which has no axis bit either", await env.run("c 43 c F1 e1 e2"), [3, 0]
    )
    env.check("AC-25", "auxo", env.bench.level("auxo"), 0b11)


@directed("AC-26", "P2104-BAD-06")
async def p2104_ac_26_not_set_up(dut: Any) -> None:
    """If axis 2 has no setting, code 63 sets error 4 on axis 2, and its data byte sets error 2 on axis 1
    (AC-26).
    """
    env = await Env.start(dut)
    env.check("AC-26", "e2, e1", await env.run("c 63 d 01 e2 e1"), [4, 2])


@directed("AC-27", "P2104-FSM-01", "P2104-AUX-02", "P2104-AUX-03", "P2104-RD-08")
async def p2104_ac_27_busy(dut: Any) -> None:
    """During an operation, instructions that are not allowed set error 5, and the motion continues
    (AC-27).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x44, 256, 0xFF)
    for code in ("02", "42", "80", "81", "82", "83", "84", "85", "C0"):
        (status,) = await env.run(f"c {code} s")
        env.check("AC-27", f"OBF after {code}", status & OBF, 0)
        env.check("AC-27", f"error of {code}", await env.run("e1"), [5])
    env.check("AC-27", "C2", await env.run("c C2 r c D1 s"), [0x00, BUSY1])
    env.check("AC-27", "auxo", env.bench.level("auxo"), 0b10)
    await axis.pulse(5)
    env.check("AC-27", "intervals", axis.intervals, [8192] * 4)
    await axis.halt()
    env.check("AC-27", "e1", await env.run("e1"), [0])


@directed("AC-28", "P2104-STP-04")
async def p2104_ac_28_stops_at_rest(dut: Any) -> None:
    """Stops set error 6 on axis 1 at standstill, and error 4 on axis 2 without a setting (AC-28)."""
    env = await Env.start(dut)
    await env.ready(1, INIT_B)
    env.check("AC-28", "errors", await env.run("c 40 e1 c 41 e1 c 60 e2"), [6, 6, 4])


@directed("AC-29", "P2104-LIM-06", "P2104-ERR-05")
async def p2104_ac_29_limit_refuses(dut: Any) -> None:
    """While the CW limit is active, CW operations set error 7, and CCW operations move (AC-29)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    axis.set(fl_n=0)
    await env.bench.clocks(4)
    since = env.bench.now
    env.check("AC-29", "42", await env.run("c 42 e1"), [7])
    got = await env.run("c 43 s d 09 s d 00 s d 00 s e1")
    env.check("AC-29", "43 and its bytes, e1", got, [0x10, 0x10, 0x10, 0x80, 7])
    env.check("AC-29", "83", await env.run("c 83 rrr"), [0, 0, 0])
    env.quiet("AC-29", since)
    await axis.move(0x4A)
    env.check("AC-29", "pulses CCW, dir", (len(axis.pulses), axis.level("dir")), (1, 1))


@directed("AC-30", "P2104-LIM-06", "P2104-LIM-02")
async def p2104_ac_30_what_refuses(dut: Any) -> None:
    """A CW start of axis 1 is rejected while ALM of the axis is active, and with code 47 also while ORG is
    active. BL and FHL of the axis, FL of the other axis, and ORG with another code do not reject the start
    (AC-30).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for pin, code, n, rate, error in (
        ("alm_n[1]", 0x42, None, None, 7),
        ("org_n[1]", 0x47, None, 0x31, 7),
        ("org_n[1]", 0x44, 1, 0x31, 0),
        ("bl_n[1]", 0x42, None, None, 0),
        ("fhl_n[1]", 0x42, None, None, 0),
        ("fl_n[2]", 0x42, None, None, 0),
    ):
        env.bench.set(**{pin: 0})
        await env.bench.clocks(4)
        await axis.move(code, n, rate)
        env.check("AC-30", f"error of {code:#x} with {pin}", await axis.error(), error)
        env.check("AC-30", f"pulses of {code:#x} with {pin}", len(axis.pulses), 0 if error else 1)
        env.bench.set(**{pin: 1})
        await env.bench.clocks(4)


@directed("AC-31", "P2104-STP-03", "P2104-PRO-05")
async def p2104_ac_31_deceleration_stop_refused(dut: Any) -> None:
    """Code 41 during constant speed, RUN wait or natural deceleration sets error 8 and has no effect
    (AC-31).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.running()
    await axis.refused("AC-31", "41 in 45", 8, 0x41)
    await axis.pulse(5)
    env.check("AC-31", "intervals of 45", axis.intervals, [1600] * 4)
    await axis.halt()
    axis.set(run=0)
    await axis.go(0x42)
    await axis.refused("AC-31", "41 in RUN wait", 8, 0x41)
    axis.set(run=1)
    await axis.result("AC-31", 1, 0x82, 0)
    await stop_after_pulse(axis, 17, n=25)
    env.check("AC-31", "41 in deceleration", await axis.error(), 8)
    await axis.result("AC-31", 25, 0x83, 0)
    env.check("AC-31", "intervals of 43", axis.intervals, AC_09)


@directed("AC-32", "P2104-INI-02", "P2104-INI-03", "P2104-BAD-16")
async def p2104_ac_32_setting_values(dut: Any) -> None:
    """Setting values at their limits and beyond set error 9, error 10 or no error, as documented (AC-32)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    bad = ((5, 4, 100, 9), (5, 6, 100, 9), (5, 0, 100, 9), (9, 4, 3, 9), (5, 4, 3, 9))
    for rl, rh, pa, error in (*bad, (9, 4, 0x2BD5, 10), (5, 4, 0x2BD5, 9)):
        await axis.init(0x02, rl, rh, pa)
        env.check("AC-32", f"error of {rl}, {rh}, {pa}", await axis.error(), error)
    await axis.move(0x43, 25)
    env.check("AC-32", "intervals", axis.intervals, AC_09)
    for rl, rh, pa in ((6, 4, 4), (255, 1, 0x2BD4)):
        await axis.init(0x02, rl, rh, pa)
        env.check("AC-32", f"error of {rl}, {rh}, {pa}", await axis.error(), 0)


@directed("AC-33", "P2104-OPR-07", "P2104-INI-01")
async def p2104_ac_33_rate_zero(dut: Any) -> None:
    """Rate 00 sets error 9 with the internal base clock, and is accepted with the external one (AC-33)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.refused("AC-33", "45 00", 9, 0x45, 0)
    await env.run("c C0 c 0A d 63 d 13 d 0A d 00")
    await axis.ready()
    clock = env.bench.external_clock(repeat(20), axis.clock, high=10)
    await axis.go(0x45, rate=0)
    await axis.pulse(10)
    await axis.halt()
    env.check("AC-33", "error", await axis.error(), 0)
    clock.cancel()


@directed("AC-34", "P2104-AUX-04", "P2104-BAD-16")
async def p2104_ac_34_switching_values(dut: Any) -> None:
    """Switching values below 40 set error 11 (AC-34)."""
    env = await Env.start(dut)
    got = await env.run("c 84 d 3F d 80 e1 c 84 d 80 d 3F e1 c 84 d 40 d FF e1")
    env.check("AC-34", "errors", got, [11, 11, 0])


@directed("AC-35", "P2104-EX-03", "P2104-STP-02", "P2104-FDC-02", "P2104-FDC-03", "P2104-END-03")
async def p2104_ac_35_deceleration_stop(dut: Any) -> None:
    """With ramp B, code 41 in I(5), I(2) or I(1) results in 10, 4 or 1 pulses and the documented remaining
    pulses (AC-35).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for j, pulses, low in ((5, 10, 0xDD), (2, 4, 0xE3), (1, 1, 0xE6)):
        await stop_after_pulse(axis, j)
        await axis.result("AC-35", pulses, 0xC3, 0x300 | low)
        env.check("AC-35", f"intervals, requested in I({j})", axis.intervals, clk(EX_03[j]))
        env.check("AC-35", "83", await env.run("c 83 rrr"), [low, 3, 0])


@directed("AC-36", "P2104-EX-05", "P2104-FDC-05", "P2104-PRO-04", "P2104-END-06")
async def p2104_ac_36_around_the_peak(dut: Any) -> None:
    """In triangular profiles of 10 and 11 pulses, code 41 near the peak has the effect in EX-05 (AC-36)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for n, j, pulses, finish, left, error in (
        (11, 4, 8, 0xC3, 2, 0),
        (11, 5, 10, 0xC3, 0, 0),
        (11, 6, 11, 0x83, 0, 8),
        (10, 4, 8, 0xC3, 1, 0),
        (10, 5, 10, 0x83, 0, 0),
        (10, 6, 10, 0x83, 0, 8),
        (25, 13, 24, 0xC3, 0, 0),
        (25, 14, 25, 0x83, 0, 0),
        (25, 15, 25, 0x83, 0, 8),
    ):
        await stop_after_pulse(axis, j, n=n)
        env.check("AC-36", f"error, N = {n}, I({j})", await axis.error(), error)
        await axis.result(f"AC-36, N = {n}, I({j})", pulses, finish, left)
        if (n, j) == (11, 5):
            env.check("AC-36", "intervals", axis.intervals, clk(EX_03[5]))


@directed("AC-37", "P2104-EX-06", "P2104-FDC-02")
async def p2104_ac_37_flat_start_of_the_ramp(dut: Any) -> None:
    """If the ramp begins with a flat part, code 41 on this part stops the axis immediately (AC-37)."""
    env = await Env.start(dut)
    axis = await env.ready(1, (0x02, 14, 12, 16))
    for j, pulses, left in ((3, 3, [0xE4, 3, 0]), (5, 10, [0xDD, 3, 0])):
        await stop_after_pulse(axis, j)
        await axis.result("AC-37", pulses, 0xC3)
        env.check("AC-37", "83", await env.run("c 83 rrr"), left)
    env.check("AC-37", "intervals", axis.intervals, clk([14, 14, 14, 14, 13, 14, 14, 14, 14]))
    pulses = await axis.move(0x43, 100)
    env.check("AC-37", "N = 100, first to last", pulses[-1] - pulses[0], 42_208)


@directed("AC-38", "P2104-EX-04", "P2104-FDC-01", "P2104-LIM-05", "P2104-LIM-02", "P2104-BAD-22")
async def p2104_ac_38_slow_down_limit(dut: Any) -> None:
    """If FHL is low twice for 10 cycles on the plateau, 31 pulses are output; BHL has no effect (AC-38)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for code, finish, left in ((0x43, 0x8B, [0xC8, 3, 0]), (0x46, 0x8E, [0xE0, 0xFF, 0xFF])):
        await axis.go(code, 1000 if code == 0x43 else None)
        for j in (20, 25):
            await axis.pulse(j, 200)
            await axis.blip("fhl_n", 10)
        await axis.result("AC-38", 31, finish)
        env.check("AC-38", "83", await env.run("c 83 rrr"), left)
        tail = [20, 21, 23, 24, 27, 30, 34, 41, 53, 99]
        env.check("AC-38", "tail", axis.intervals[20:], clk(tail))
        env.check("AC-38", "first to last", sum(axis.intervals), 30_848)
    await axis.go(0x43, 1000)
    await axis.pulse(20, 200)
    await axis.blip("bhl_n", 10)
    await axis.result("AC-38", 1000, 0x83, 0)
    env.check("AC-38", "P2104-EX-02 sum", sum(axis.intervals), 651_008)


@directed("AC-39", "P2104-FDC-04", "P2104-LIM-05", "P2104-OPR-05", "P2104-OPR-09")
async def p2104_ac_39_started_on_the_slow_down_limit(dut: Any) -> None:
    """With FHL active, codes 43, C3 and 46 output one pulse each (AC-39)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    axis.set(fhl_n=0)
    for script, finish, left in (
        (f"c 43 {E7}", 0x8B, [0xE6, 3, 0]),
        (f"c C3 {E7}", 0x8B, [0xE6, 3, 0]),
        ("c 46", 0x8E, [0xFE, 0xFF, 0xFF]),
    ):
        axis.since = env.bench.now
        await env.run(script)
        await axis.result("AC-39", 1, finish)
        env.check("AC-39", "83", await env.run("c 83 rrr"), left)


@directed("AC-40", "P2104-FDC-04", "P2104-FDC-05", "P2104-END-05")
async def p2104_ac_40_complete_all_the_same(dut: Any) -> None:
    """With FHL active, an operation of one pulse is complete and has no cause bit (AC-40)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    axis.set(fhl_n=0)
    await axis.go(0x43, 1)
    await axis.result("AC-40", 1, 0x83, 0)


@directed("AC-41", "P2104-EX-09", "P2104-END-06", "P2104-STP-01")
async def p2104_ac_41_immediate_stop(dut: Any) -> None:
    """With N = 1000, code 40 in I(7) results in 7 pulses; a move of the remaining pulses completes the count
    (AC-41).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await stop_after_pulse(axis, 7, 0x40)
    await axis.result("AC-41", 7, 0xC3)
    env.check("AC-41", "83", await env.run("c 83 rrr"), [0xE0, 3, 0])
    env.check("AC-41", "intervals", axis.intervals, AC_09[:6])
    axis.since = env.bench.now
    await env.run("c 43 d E0 d 03 d 00")
    await axis.result("AC-41", 993, 0x83, 0)


@directed("AC-42", "P2104-LIM-03", "P2104-END-02", "P2104-OPR-06")
async def p2104_ac_42_limit(dut: Any) -> None:
    """At constant speed CW, FL ends the motion within 8 cycles; BL has no effect (AC-42)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x45, rate=0x31)
    await axis.pulse(2, 400)
    axis.set(bl_n=0)
    await axis.pulse(5, 400)
    pin = axis.set(fl_n=0)
    await env.bench.until(pin + 8)
    env.check("AC-42", "BUSY 8 cycles after the pin", await env.host.status() & BUSY1, 0)
    await axis.result("AC-42", 5, 0x95)
    env.check("AC-42", "83", await env.run("c 83 rrr"), [0xFA, 0xFF, 0xFF])


@directed("AC-43", "P2104-END-04", "P2104-LIM-04", exact="the switches must be sampled at the same edge")
async def p2104_ac_43_several_causes(dut: Any) -> None:
    """If a limit and an alarm occur during a forced deceleration or on a plateau, all their bits are set
    (AC-43).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for slow, pins, finish in (
        (True, ("fl_n",), 0x9B),
        (True, ("alm_n",), 0xAB),
        (False, ("alm_n", "fl_n"), 0xB3),
    ):
        await axis.go(0x43, 1000)
        await axis.pulse(20, 200)
        if slow:
            await axis.blip("fhl_n", 10)
            await axis.pulse(24, 200)
        axis.set(**dict.fromkeys(pins, 0))
        await axis.result("AC-43", 24 if slow else 20, finish)
        axis.set(**dict.fromkeys(pins, 1))


@directed("AC-44", "P2104-END-05", "P2104-LIM-09")
async def p2104_ac_44_alarm_after_the_last_pulse(dut: Any) -> None:
    """If ALM falls while pout_n of a step is low, the step counts as complete (AC-44)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x42)
    await axis.pulse(1, 20)
    axis.set(alm_n=0)
    await axis.result("AC-44", 1, 0x82, 0)
