"""Acceptance checks AC-45 to AC-63 at the pins: RUN, two axes, phases, switching, waiting codes.

D = N - 1 is the number that a host sends for an operation of N pulses.
"""

from __future__ import annotations

from itertools import repeat
from typing import Any

from cocotb_tests.harness import IBF, OBF, directed
from cocotb_tests.harness.axis_driver import NO_PULSES_DONE, steps
from cocotb_tests.harness.checks import check_intervals

from .env import Env
from .expected_timing import BUSY1, CMND1, INIT_B, STEP_CODES
from .tb_acceptance_moves import AC_09, B1

US = 16


@directed("AC-45", "P2104-OPR-02", "P2104-TIM-02", "P2104-STA-04", "P2104-BAD-21")
async def p2104_ac_45_run(dut: Any) -> None:
    """With run low, an accepted move waits. When run rises, the move starts; later changes of run have no
    effect (AC-45).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    axis.set(run=0)
    await env.bench.clocks(4)
    status = await axis.go(0x43, 25)
    await env.bench.clocks(4)
    env.check("AC-45", "status, hold, dir", (status, axis.level("hold"), axis.level("dir")), (BUSY1, 0, 0))
    await env.bench.clocks(1000 * US)
    env.check("AC-45", "pulses in 1 ms", axis.pulses, [])
    rise = axis.set(run=1)
    first = await axis.pulse(1, 100)
    env.window("AC-45", "run to pulse 1", first - rise, 80, 86)
    axis.set(run=0)
    await axis.idle()
    env.check("AC-45", "intervals", axis.intervals, AC_09)


@directed("AC-46", "P2104-STP-01", "P2104-END-07", "P2104-FSM-01")
async def p2104_ac_46_stop_in_run_wait(dut: Any) -> None:
    """In RUN wait, code 40 ends the move without a pulse: the end status is C3, the remaining value is D, and
    hold rises after 3.2 ms (AC-46).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    axis.set(run=0)
    await axis.go(0x43, 25)
    end0 = await axis.command(0x40, poll=False)
    end = await axis.wait_end()
    env.check("AC-46", "int_n", env.bench.level("int_n"), 0)
    env.window("AC-46", "stop to int_n", end - end0, 2, 18)
    await axis.result("AC-46", 0, 0xC3)
    env.check("AC-46", "83", await env.run("c 83 rrr"), [0x18, 0, 0])
    hold = await env.bench.edge("hold[1]", 1)
    env.window("AC-46", "end to hold", hold - end, 51_200 - 4, 51_216 + 4)


@directed("AC-47", "P2104-LIM-03", "P2104-LIM-07")
async def p2104_ac_47_limit_in_run_wait(dut: Any) -> None:
    """An origin search in RUN wait ignores ORG; BL ends the search (AC-47)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    axis.set(run=0)
    await axis.go(0x4F, rate=0x31)
    axis.set(org_n=0)
    await env.bench.clocks(200)
    env.check("AC-47", "status after ORG", await env.host.status(), BUSY1)
    axis.set(bl_n=0)
    await axis.result("AC-47", 0, 0x97, NO_PULSES_DONE - 1)


@directed("AC-48", "P2104-LIM-07")
async def p2104_ac_48_origin_when_run_rises(dut: Any) -> None:
    """If an origin search waits for run while ORG is active, it ends without a pulse when run rises
    (AC-48).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    axis.set(run=0)
    await axis.go(0x47, rate=0x31)
    axis.set(org_n=0)
    await env.bench.clocks(20)
    axis.set(run=1)
    await axis.result("AC-48", 0, 0x87, NO_PULSES_DONE - 1)


@directed("AC-49", "P2104-LIM-05", "P2104-FDC-01", "P2104-FDC-04")
async def p2104_ac_49_slow_down_limit_in_run_wait(dut: Any) -> None:
    """If FHL is low for 10 cycles in RUN wait, the next rise of run starts a motion of only one pulse
    (AC-49).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    axis.set(run=0)
    await axis.go(0x43, 1000)
    await axis.blip("fhl_n", 10)
    await env.bench.clocks(20)
    axis.set(run=1)
    await axis.result("AC-49", 1, 0x8B)
    env.check("AC-49", "83", await env.run("c 83 rrr"), [0xE6, 3, 0])


@directed("AC-50", "P2104-TIM-02", "P2104-OPR-10", "P2104-BCK-05")
async def p2104_ac_50_both_axes_together(dut: Any) -> None:
    """When run rises for two waiting axes, they output pulse 1 on the same edge (AC-50)."""
    env = await Env.start(dut)
    first, second = await env.both(INIT_B)
    env.bench.set(run=0)
    await first.go(0x43, 25)
    await second.go(0x4C, 5, 0x31)
    env.bench.set(run=0b11)
    await first.idle()
    await second.idle()
    env.check("AC-50", "first falls", first.pulses[0], second.pulses[0])
    env.check("AC-50", "intervals of axis 1", first.intervals, AC_09)
    env.check("AC-50", "intervals of axis 2", second.intervals, [1600] * 4)
    env.check("AC-50", "dir", env.bench.level("dir"), 0b10)


@directed("AC-51", "P2104-LIM-07", "P2104-OPR-06", "P2104-END-05")
async def p2104_ac_51_origin(dut: Any) -> None:
    """ORG ends an origin search without a cause bit (AC-51)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x47, rate=0x31)
    await axis.pulse(7, 400)
    axis.set(org_n=0)
    await axis.result("AC-51", 7, 0x87)
    env.check("AC-51", "83", await env.run("c 83 rrr"), [0xF8, 0xFF, 0xFF])


@directed("AC-52", "P2104-OPR-08", "P2104-CMD-02")
async def p2104_ac_52_pout_mode(dut: Any) -> None:
    """In POUT mode, codes C3 and C6 output the usual pulses, and s1_n does not change (AC-52)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.move(0xC3, 25)
    env.check("AC-52", "intervals", axis.intervals, AC_09)
    await axis.go(0xC6)
    await axis.pulse(5, 100)
    await env.run("c 40")
    await axis.result("AC-52", 5, 0xC6)
    env.check("AC-52", "levels of s1_n", [v for _, v in env.bench.edges("s1_n")], [0b11100])


@directed("AC-53", "P2104-PHS-01", "P2104-PHS-04", "P2104-PHS-05", "P2104-EX-11", "P2104-INI-01")
async def p2104_ac_53_step_lists(dut: Any) -> None:
    """The steps of each motor type follow its step list, CW and CCW (AC-53, P2104-PHS-05)."""
    env = await Env.start(dut)
    for axis in env.axes:
        for name, code in STEP_CODES.items():
            await axis.send(0xC0)
            await axis.init(code, *INIT_B[1:])
            patterns = steps(name, positive=False)
            env.check("AC-53", f"{name}: index 0", axis.phases_now, patterns[0])
            count = 2 * len(patterns)
            for op, direction in ((0x52, 1), (0x5A, -1)):
                got = []
                for _ in range(count):
                    await axis.move(op)
                    got.append(axis.phases_now)
                want = [patterns[direction * i % len(patterns)] for i in range(1, count + 1)]
                env.check("AC-53", f"{name} by {op:#x}, axis {axis.n}", got, want)


@directed("AC-54", "P2104-SW-02", "P2104-SW-03", "P2104-SW-04", "P2104-SW-05", "P2104-INI-07")
async def p2104_ac_54_switching(dut: Any) -> None:
    """With S = 1, the axis chops at standstill with the documented times, and moves with the full pattern
    (AC-54).
    """
    env = await Env.start(dut)
    axis = env.x1
    await axis.init(0x12, *INIT_B[1:])
    await env.bench.clocks(10_000)
    spans = axis.stretches(env.bench.now - 9_000)
    for pattern, span in spans:
        nominal = {0b11100: 664, 0b11111: 1328}[pattern]
        env.window("AC-54", f"cycles of {pattern:05b}", span, nominal - 5, nominal + 5)
    env.window("AC-54", "number of phases", len(spans), 7, 10)
    await axis.send(0x84, [0x40, 0x80])
    await env.bench.clocks(3_000)
    reads = []
    since = env.bench.now
    for _ in range(20):
        reads += await axis.fetch(0x82)
        await env.bench.clocks(137)
    env.check("AC-54", "82", set(reads), {0x3C})
    for pattern, span in axis.stretches(since):
        nominal = {0b11100: 512, 0b11111: 1024}[pattern]
        env.window("AC-54", f"new cycles of {pattern:05b}", span, nominal - 5, nominal + 5)
    await env.bench.edge("s1_n", 0b11111)
    await axis.go(0x42)
    (pulse,) = [await axis.pulse(1)]
    full = [t for t, _ in env.bench.edges("s1_n", axis.since) if t < pulse]
    env.window("AC-54", "full pattern before the pulse", pulse - full[-1], 80, 10_000)
    env.check("AC-54", "pattern before the pulse", env.bench.level_at("s1_n", pulse - 1), 0b11100)
    env.check("AC-54", "edges from the pulse on", env.bench.edges("s1_n", pulse), [(pulse, 0b11001)])
    end = await axis.wait_end()
    off = await env.bench.edge("s1_n", 0b11111)
    env.window("AC-54", "end to OFF", off - end, 502, 522)
    env.check("AC-54", "cycles of OFF", await env.bench.edge("s1_n", 0b11001) - off, 1024)


@directed("AC-55", "P2104-END-07", "P2104-AUX-05", "P2104-HLD-01")
async def p2104_ac_55_hold_delay(dut: Any) -> None:
    """With hold delays n = 18h, 00 and FF, hold rises 3.2, 0.128 and 32.768 ms after a step (AC-55)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for n, clocks in ((None, 51_200), (0x00, 2_048), (0xFF, 524_288)):
        if n is not None:
            await axis.send(0x85, [n])
        await axis.move(0x42)
        rise = env.bench.rises("pout_n[1]", axis.since)[-1]
        hold = await env.bench.edge("hold[1]", 1)
        env.window("AC-55", f"pout_n to hold, n = {n}", hold - rise, clocks, clocks + 24)
    await axis.send(0x85, [0x00])
    since = env.bench.now
    await axis.move(0x42)
    await env.bench.clocks(1_500)
    await axis.move(0x42)
    await env.bench.clocks(1_500)
    env.check("AC-55", "hold levels", [v for _, v in env.bench.edges("hold[1]", since)], [0])


@directed("AC-56", "P2104-AUX-02", "P2104-AUX-03")
async def p2104_ac_56_auxiliary(dut: Any) -> None:
    """In all states, codes C1, D1, E1 and F1 set the auxiliary output pins, and C2 reads the input pins
    (AC-56).
    """
    env = await Env.start(dut)
    for state in ("initial", "moving"):
        for code, level in ((0xC1, 3), (0xD1, 2), (0xE1, 1), (0xF1, 0)):
            await env.host.command(code)
            await env.bench.clocks(2)
            env.check("AC-56", f"auxo after {code:#x}, {state}", env.bench.level("auxo"), level)
        for level in (0b01, 0b10):
            env.bench.set(auxi=level)
            await env.bench.clocks(4)
            env.check("AC-56", f"C2, {state}", await env.run("c C2 r"), [level])
            await env.bench.clocks(8)
            env.check("AC-56", "OBF: one byte only", await env.host.status() & OBF, 0)
        if state == "initial":
            axis = await env.ready(1, INIT_B)
            await axis.running()
    env.check("AC-56", "e1, e2", await env.errors(), (0, 0))


@directed("AC-57", "P2104-AUX-01", "P2104-PHS-02", "P2104-PHS-03")
async def p2104_ac_57_excitation_off(dut: Any) -> None:
    """After code C0 the phases are off and operations set error 4; the next setting begins with index 0
    (AC-57).
    """
    env = await Env.start(dut)
    await env.run(B1)
    axis = env.x1
    await axis.ready()
    await axis.move(0x42)
    got = [axis.phases_now]
    await env.run("c C0")
    await env.bench.clocks(2)
    got.append(axis.phases_now)
    env.check("AC-57", "error of 42", await env.run("c 42 e1"), [4])
    await axis.init(0x03, *INIT_B[1:])
    got.append(axis.phases_now)
    await axis.move(0x42)
    got.append(axis.phases_now)
    env.check("AC-57", "s1_n", got, [0b11001, 0b11111, 0b11100, 0b11001])
    await axis.move(0x42)
    await axis.move(0x42)
    env.check("AC-57", "s1_n of a 5-phase motor", axis.phases_now, 0b00111)


@directed("AC-58", "P2104-INI-05")
async def p2104_ac_58_setting_again(dut: Any) -> None:
    """A second setting of axis 1, with code 1F, changes only the ramp (AC-58)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.init(0x1F, 9, 4, 4)
    await axis.move(0x42)
    await env.bench.clocks(4_000)
    env.check("AC-58", "levels of s1_n", [v for _, v in env.bench.edges("s1_n")], [0b11100, 0b11001])
    await axis.move(0x43, 14)
    expected = [320, 256, 192, 192, *[160] * 5, 192, 192, 256, 320]
    env.check("AC-58", "intervals", axis.intervals, expected)


@directed("AC-59", "P2104-BCK-04", "P2104-TIM-03", "P2104-BAD-18")
async def p2104_ac_59_external_clock(dut: Any) -> None:
    """With 250 kHz on extck, rate 9 results in intervals of 640 cycles; without edges the axis waits until
    code 40 (AC-59).
    """
    env = await Env.start(dut)
    axis = env.x1
    await axis.init(0x0A, *INIT_B[1:])
    clock = env.bench.external_clock(repeat(64), axis.clock, high=32)
    await axis.move(0x44, 10, 9)
    for interval in axis.intervals:
        env.window("AC-59", "interval", interval, 638, 642)
    check_intervals(env.bench, "AC-59", [sum(axis.intervals)], [9 * 640])
    await axis.finish()
    clock.cancel()
    await axis.go(0x44, 10, 9)
    await env.bench.clocks(1000 * US)
    env.check("AC-59", "status, pulses", (await env.host.status(), axis.pulses), (BUSY1, []))
    await axis.command(0x40)
    await axis.result("AC-59", 0, 0xC4, 9)


@directed("AC-60", "P2104-EX-14", "P2104-TIM-05")
async def p2104_ac_60_external_clock_of_1_mhz(dut: Any) -> None:
    """With 1 MHz on extck, rate 0 results in intervals of 16 cycles, and low times of 8 cycles (the last one:
    80) (AC-60).
    """
    env = await Env.start(dut)
    axis = env.x1
    await axis.init(0x0A, *INIT_B[1:])
    env.bench.external_clock(repeat(16), axis.clock, high=8)
    await env.bench.clocks(200)
    await axis.move(0x44, 10, 0)
    check_intervals(axis.bench, "AC-60", axis.intervals, [16] * 9)
    for low in axis.low_times[:-1]:
        env.window("AC-60", "low time", low, 7, 9)
    env.check("AC-60", "last low time", axis.low_times[-1], 80)


@directed("AC-61", "P2104-HSK-07", "P2104-BAD-10", "P2104-BAD-25")
async def p2104_ac_61_unread_answer(dut: Any) -> None:
    """Two unread bytes stay in the queue during a step; code 80 replaces them (AC-61)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x43, 1000)
    await axis.pulse(7, 100)
    await env.run("c 40")
    await axis.idle()
    got = await env.run("c 83 r c 42")
    await axis.idle()
    got += await env.run("r")
    got += await env.run("c 83 c 80 r")
    env.check("AC-61", "bytes", got, [0xE0, 0x03, 0x82])
    env.check("AC-61", "OBF", await env.host.status() & OBF, 0)


@directed("AC-62", "P2104-HSK-04", "P2104-HSK-05", "P2104-STA-05")
async def p2104_ac_62_what_waits(dut: Any) -> None:
    """While the table of axis 1 is built, codes F1 and 72 are accepted, and only code 42 waits (AC-62)."""
    env = await Env.start(dut)
    first, second = env.axes
    await env.ready(2, INIT_B)
    await env.run("c 02 d 63 d 13 d 0A")
    edge0 = await env.host.data(0x00, poll=False)
    await second.go(0x52)
    await env.run("c F1")
    await env.bench.clocks(2)
    env.check("AC-62", "auxo", env.bench.level("auxo"), 0)
    pulse = await second.pulse(1)
    env.window("AC-62", "72 to its pulse", pulse - second.since, 80, 200)
    await first.go(0x42, poll=False)
    while (status := await env.host.status()) & CMND1:
        env.check("AC-62", "IBF while it waits", status & IBF, IBF)
    env.window("AC-62", "table", env.bench.now - edge0, 2_000, 40_020)
    await first.pulse(1)
    await first.result("AC-62", 1, 0x82)


@directed("AC-63", "P2104-HSK-02", "P2104-BAD-08")
async def p2104_ac_63_written_over(dut: Any) -> None:
    """If code 52 replaces a waiting code 42, one pulse follows, and no interrupt occurs (AC-63)."""
    env = await Env.start(dut)
    axis = env.x1
    await env.run(B1)
    await axis.go(0x42, poll=False)
    await env.bench.clocks(100)
    await axis.command(0x52)
    await axis.idle()
    await env.bench.clocks(400)
    env.check("AC-63", "pulses", len(axis.pulses), 1)
    env.check("AC-63", "edges of int_n", env.bench.edges("int_n"), [])
