"""Acceptance checks AC-35 to AC-45 and AC-48 to AC-52 at the pins: registers, chopper, clock, bad input."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, D16, DATA, IBF, OBF, directed

from .env import WRITE_EVENT, Env
from .expected_timing import INTERNAL, MOST, SHEET, STANDARD


@directed("AC-35", "STMC-MOT-09", "STMC-MOT-10", "STMC-FIN-05")
async def stmc_ac_35_interrupt(dut: Any) -> None:
    """A motion asserts int_n only if bit 4 of its code is 0, and only code 80 releases int_n (AC-35)."""
    env = await Env.start(dut)
    await env.move(0x53, 1)
    env.check("AC-35", "edges of int_n", env.bench.edges("int_n"), [])
    await env.move(0x43, 1)
    env.check("AC-35", "int_n", env.bench.level("int_n"), 0)
    await env.move(0x42)
    await env.host.status()
    env.check("AC-35", "edges of int_n", [v for _, v in env.bench.edges("int_n")], [0])
    await env.host.command(0x80)
    env.check("AC-35", "int_n before the byte is read", env.bench.level("int_n"), 1)
    env.check("AC-35", "FIN", await env.host.read_data(), 0x82)


@directed("AC-36", "STMC-FSM-01", "STMC-FSM-02", "STMC-RD-01", "STMC-BAD-17", "STMC-INI-03")
async def stmc_ac_36_bytes_during_a_move(dut: Any) -> None:
    """During a move, codes 80, 0A, C0 and 42 and a data byte return errors 1, 1, 0, 1 and 6 (AC-36)."""
    env = await Env.start(dut)
    await env.go(0x43, 100)
    got = await env.statuses("c 80 c 0A c C0 c 42 d 00")
    env.check("AC-36", "statuses", got, [0x94, 0x94, 0x84, 0x94, 0xE4])
    await env.result("AC-36", 100, 0x83, 0)


@directed("AC-37", "STMC-BUS-21", "STMC-BUS-22", "STMC-BAD-10", "STMC-BAD-11")
async def stmc_ac_37_answer_replaced(dut: Any) -> None:
    """When code 81 is accepted, its byte replaces an answer of which some bytes are unread (AC-37)."""
    env = await Env.start(dut)
    env.check("AC-37", "bytes", await env.host.run("c 83 r c 81 r"), [0, 0xCF])
    env.check("AC-37", "OBF", await env.host.status() & OBF, 0)
    env.check("AC-37", "data register", await env.host.read(DATA), 0xCF)
    env.check("AC-37", "status", await env.host.status(), 0)


@directed("AC-38", "STMC-CMD-01", "STMC-BAD-02", "STMC-BAD-04")
async def stmc_ac_38_command_instead_of_data(dut: Any) -> None:
    """Code 42 cancels an incomplete command 3 and makes one step; a later data byte returns error 3
    (AC-38).
    """
    env = await Env.start(dut)
    env.since = env.bench.now
    await env.host.run("c 43 d 05 c 42")
    await env.idle()
    env.check("AC-38", "steps", len(env.pulses), 1)
    env.check("AC-38", "status", await env.statuses("d 00"), [0xB0])


@directed("AC-39", "STMC-INI-02", "STMC-BAD-05")
async def stmc_ac_39_refused_initialisation(dut: Any) -> None:
    """Illegal divisors (5/20/8 and others) return error 5. Before an initialisation no value is set;
    afterwards the old values stay (AC-39).
    """
    env = await Env.start(dut, None)
    refused = ((5, 20), (0, 0), (20, 0), (0, 5), (254, 255))
    for d1, d2 in refused:
        env.check("AC-39", f"status of {d1}, {d2}", await env.host.init(0x1A, d1, d2, 8), 0xD0)
    env.check("AC-39", "42, s", (await env.statuses("c 42"), env.bench.level("s")), ([0xA0], 0))
    await env.init(*STANDARD)
    for d1, d2 in refused:
        env.check("AC-39", f"status of {d1}, {d2}", await env.host.init(0x1A, d1, d2, 8), 0xD0)
        await env.move(0x43, 4)
        env.train("AC-39", [20, 12, 20])


@directed("AC-40", "STMC-INI-07", "STMC-BUS-14", "STMC-BAD-09", "STMC-FSM-03")
async def stmc_ac_40_bytes_during_the_build(dut: Any) -> None:
    """If codes 40 and then 80 are written during a table build, only 80 is executed, without an error
    (AC-40).
    """
    env = await Env.start(dut)
    await env.host.init(0x1A, 255, 5, 400)
    edge0 = await env.host.write(1, 0x40)
    await env.bench.until(edge0 + 12)
    await env.host.write(1, 0x80)
    env.check("AC-40", "status", await env.host.poll(IBF, 0), OBF)
    env.check("AC-40", "FIN", await env.host.read_data(), 0x80)
    await env.move(0x43, 4)
    env.check("AC-40", "first gap", env.intervals[0], 255 * 16)


@directed("AC-41", "STMC-CHP-01", "STMC-CHP-02", "STMC-HLD-01", "STMC-OUT-02", builds=(SHEET,))
async def stmc_ac_41_chopper(dut: Any) -> None:
    """With bit 5 of the initialisation code = 1, the pattern is chopped at standstill and full during a step
    (AC-41).
    """
    env = await Env.start(dut, None)
    await env.host.init(0x3A, 20, 5, 8)
    await env.bench.level_is("s", 0b00000, 60_000)
    off = env.bench.now
    for _ in range(8):
        env.check("AC-41", "outputs", await env.out(), 0xC4)
        await env.bench.clocks(400)
    env.check("AC-41", "hold", env.bench.edges("hold"), [])
    env.check("AC-41", "phases", set(env.stretches(off - 1)), {(0b00011, 1040), (0, 1740)})
    while env.bench.level("s"):
        await env.bench.edge("s")
    await env.go(0x42)
    begin = env.bench.falls("hold")[0]
    end = await env.wait_end()
    env.check("AC-41", "full pattern with hold", env.bench.level_at("s", begin), 0b00011)
    step = next(t for t, level in env.bench.edges("s", begin) if level == 0b00110)
    env.window("AC-41", "hold to the step", step - begin, 80, 82)
    first_off = await env.bench.edge("s", 0)
    env.window("AC-41", "first on-time", first_off - end, 1032, 1048)
    rise = await env.bench.edge("hold", 1)
    env.window("AC-41", "hold", rise - step, 1600, 1624)


@directed("AC-42", "STMC-CLK-05")
async def stmc_ac_42_no_ticks(dut: Any) -> None:
    """Without an external clock, a started move waits. Code 40 ends it without a step; after code 41, it
    makes one step when the clock runs (AC-42).
    """
    env = await Env.start(dut, clock=0)
    await env.go(0x43, 6)
    await env.bench.clocks(5_000)
    env.check("AC-42", "BUSY", await env.host.status(), BUSY)
    await env.command(0x40)
    await env.result("AC-42", 0, 0xC3, 5)
    await env.go(0x43, 6)
    env.check("AC-42", "status after 41", await env.command(0x41), BUSY)
    await env.bench.clocks(500)
    env.check("AC-42", "steps without ticks", env.pulses, [])
    await env.ticks(3)
    await env.result("AC-42", 1, 0xC3, 4)


@directed("AC-43", "STMC-RUN-01")
async def stmc_ac_43_bit_5_of_a_motion(dut: Any) -> None:
    """Code 63 has the effect of code 43 (AC-43)."""
    env = await Env.start(dut)
    await env.go(0x63, 1)
    await env.result("AC-43", 1, 0x83, 0)
    env.check("AC-43", "pattern", env.patterns, [0b00110])


@directed("AC-44", "STMC-RD-01", "STMC-BAD-01")
async def stmc_ac_44_family_codes(dut: Any) -> None:
    """By default, codes 81, 82 and 83 return inputs, outputs and three bytes; code 84 returns error 0 (AC-44,
    R-01).
    """
    env = await Env.start(dut)
    got = await env.host.run("c 81 r c 82 r c 83 rrr c 84 s")
    env.check("AC-44", "answers", got, [0xCF, 0xC4, 0, 0, 0, 0x80])


@directed("AC-45", "STMC-RD-01", "STMC-BAD-01", builds=(SHEET,))
async def stmc_ac_45_data_sheet_codes(dut: Any) -> None:
    """With READ_MAP "SHEET", code 81 returns error 0, and code 84 returns three bytes (AC-45)."""
    env = await Env.start(dut)
    env.check("AC-45", "answers", await env.host.run("c 81 s c 84 rrr"), [0x80, 0, 0, 0])


@directed("AC-48", "STMC-DS-01", "STMC-DS-05", "STMC-DS-07", "STMC-DS-08", builds=(D16,))
async def stmc_ac_48_datasheet_times(dut: Any) -> None:
    """In DATASHEET, start, steps, end and answer of a motion of two steps occur at their documented times
    (AC-48).
    """
    env = await Env.start(dut, INTERNAL, clock=0)
    bench = env.bench
    edge0 = await env.go(0x44, 2, 10, poll=False)
    hold = await bench.edge("hold", 0)
    env.window("AC-48", "hold", hold - edge0, 432, 432 + 24)
    first = await env.pulse(1)
    env.window("AC-48", "first step", first - edge0, 3104, 3104 + 24)
    last = await env.pulse(2)
    env.check("AC-48", "gap", last - first, 12_800)
    end = await env.wait_end()
    env.window("AC-48", "int_n", end - last, 416, 416 + 16)
    await env.host.write(1, 0x80)
    await bench.until(last + 2_400)
    while bench.now < last + 2_490:
        env.check("AC-48", "IBF", await env.host.status(), IBF)
    status = await env.host.poll(IBF, 0, dense=100)
    env.window("AC-48", "taken", bench.now - last, 2_496, 2_496 + 16 + 12)
    env.check("AC-48", "status and byte", (status, await env.host.read_data()), (OBF, 0x84))


@directed("AC-49", "STMC-BAD-16")
async def stmc_ac_49_reset_in_motion(dut: Any) -> None:
    """If rst_n falls during a move, all outputs take their reset levels immediately, and all state is cleared
    (AC-49).
    """
    env = await Env.start(dut)
    await env.go(0x43, 100)
    await env.in_gap(5)
    env.set(rst_n=0)
    await env.bench.clocks(1)
    env.check("AC-49", "outputs", env.outputs(), {"int_n": 1, "s": 0, "hold": 1})
    await env.bench.clocks(5)
    env.set(rst_n=1)
    await env.bench.clocks(5)
    env.check("AC-49", "status", await env.host.status(), 0)
    env.check("AC-49", "42", await env.statuses("c 42"), [0xA0])
    env.check("AC-49", "registers", await env.host.run("c 80 r c 83 rrr c 82 r"), [0x80, 0, 0, 0, 4])


@directed("AC-50", "STMC-DEC-03", "STMC-IN-04")
async def stmc_ac_50_start_at_the_deceleration_limit(dut: Any) -> None:
    """With l3_n low, command 3, command 6, command 3 with N = 1, and command 7 make 1, 1, 1 and 0 steps; with
    l1_n low, they make no step (AC-50).
    """
    env = await Env.start(dut)
    await env.pins(l3_n=0)
    for code, n, rate, steps, finish, rest in (
        (0x43, 100, None, 1, 0x8B, 98),
        (0x46, None, None, 1, 0x8E, MOST - 1),
        (0x43, 1, None, 1, 0x83, 0),
        (0x47, None, 10, 0, 0x8F, MOST),
    ):
        await env.go(code, n, rate)
        await env.result("AC-50", steps, finish, rest)
    await env.pins(l1_n=0)
    await env.go(0x43, 100)
    await env.result("AC-50", 0, 0x93, 99)


@directed("AC-51", "STMC-CMD-01", "STMC-BAD-11")
async def stmc_ac_51_answer_outlives_a_step(dut: Any) -> None:
    """If a step is made while one byte of the remaining value has been read, the other two bytes stay
    available (AC-51).
    """
    env = await Env.start(dut)
    await env.go(0x43, 100)
    await env.in_gap(10)
    await env.command(0x40)
    await env.idle()
    env.check("AC-51", "first byte", await env.host.run("c 83 r"), [0x58])
    await env.host.command(0x42)
    await env.idle()
    env.check("AC-51", "other bytes", await env.host.run("rr"), [0, 0])
    env.check("AC-51", "OBF", await env.host.status() & OBF, 0)


@directed("AC-52", "STMC-BUS-06", "STMC-BAD-12")
async def stmc_ac_52_both_strobes(dut: Any) -> None:
    """If both strobes are low together and rise together, nothing is driven and nothing is written
    (AC-52).
    """
    env = await Env.start(dut)
    before = await env.host.status()
    since = env.bench.now
    await env.host.raw(10, cs_n=0, rd_n=0, wr_n=0, a0=1, d_i=0x42)
    await env.host.raw(20 + WRITE_EVENT, cs_n=1, rd_n=1, wr_n=1)
    env.check("AC-52", "d_oe", env.bench.edges("d_oe", since), [])
    env.check("AC-52", "d_o", env.bench.edges("d_o", since), [])
    env.check("AC-52", "status", await env.host.status(), before)
    env.quiet("AC-52", since)
