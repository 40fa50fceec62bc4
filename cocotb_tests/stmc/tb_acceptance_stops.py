"""Black-box acceptance checks AC-21 to AC-34: stops, limits, reference point, motor switch."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed

from .figures import MOST
from .lab import Lab
from .tb_acceptance_moves import W1, W2

W14 = [20, 12, 9, 8, 9, 12, 20]


async def asked_in(lab: Lab, gap: int, n: int = 100, code: int = 0x41, plus: int = 30) -> int:
    """Command 3 with n steps, a stop command in that gap; the status after it."""
    await lab.go(0x43, n)
    await lab.in_gap(gap, plus)
    return await lab.command(code)


@directed("AC-21", "STMC-STP-03", "STMC-DEC-04", "STMC-REM-01")
async def stmc_ac_21_the_rest_of_a_stopped_move(dut: Any) -> None:
    """Given 100 steps, when 41 comes in gap 3, then W14, and the remaining value finishes the move."""
    lab = await Lab.start(dut)
    await asked_in(lab, 3)
    await lab.outcome("AC-21", 8, 0xC3, 0x5B, W14)
    lab.since = lab.bench.now
    await lab.host.run("c 43 d 5B d 00 d 00")
    await lab.outcome("AC-21", 92, 0x83, 0)


@directed("AC-22", "STMC-DEC-03", "STMC-DEC-04")
async def stmc_ac_22_requests_at_other_speeds(dut: Any) -> None:
    """Given 100 steps, when 41 comes in gap 10, 1 or 0, then W15, W16, W17."""
    lab = await Lab.start(dut)
    for gap, ticks, rest in ((10, W1, 79), (1, [20, 12, 20], 95), (0, [], 98)):
        await asked_in(lab, gap)
        await lab.outcome("AC-22", len(ticks) + 1, 0xC3, rest, ticks)


@directed("AC-23", "STMC-DEC-01", "STMC-STP-04", "STMC-FIN-02")
async def stmc_ac_23_around_the_turn(dut: Any) -> None:
    """Given 12 steps, when 41 comes in gap 5 or 6, then accepted or error 7, and the move is complete."""
    lab = await Lab.start(dut)
    for gap, status in ((5, 0x04), (6, 0xF4)):
        lab.check("AC-23", f"status in gap {gap}", await asked_in(lab, gap, 12), status)
        await lab.outcome("AC-23", 12, 0x83, 0, W2)


@directed("AC-24", "STMC-STP-01")
async def stmc_ac_24_emergency_stop(dut: Any) -> None:
    """Given 100 steps, when 40 comes in gap 10, then no further step."""
    lab = await Lab.start(dut)
    await asked_in(lab, 10, code=0x40)
    await lab.outcome("AC-24", 11, 0xC3, 0x58)


@directed("AC-25", "STMC-STP-02")
async def stmc_ac_25_command_1_at_constant_speed(dut: Any) -> None:
    """Given constant speed, when 41 or 40 comes in gap 2, then it stops at once."""
    lab = await Lab.start(dut)
    for code in (0x41, 0x40):
        await lab.go(0x44, 256, 0x14)
        await lab.in_gap(2)
        await lab.command(code)
        await lab.outcome("AC-25", 3, 0xC4, 0xFC, [20, 20])


@directed("AC-26", "STMC-IN-01", "STMC-DEC-05")
async def stmc_ac_26_deceleration_limit(dut: Any) -> None:
    """Given 100 steps cw, when l3_n is low for 4 clk in gap 10, then the ramp down of W15."""
    lab = await Lab.start(dut)
    await lab.go(0x43, 100)
    await lab.in_gap(10)
    await lab.blip("l3_n")
    await lab.outcome("AC-26", 20, 0x8B, 0x4F, W1)


@directed("AC-27", "STMC-IN-03")
async def stmc_ac_27_limits_behind(dut: Any) -> None:
    """Given l4_n and l2_n low all the time, when a cw move runs, then they are ignored."""
    lab = await Lab.start(dut, l4_n=0, l2_n=0)
    await lab.go(0x43, 100)
    await lab.outcome("AC-27", 100, 0x83, 0)


@directed("AC-28", "STMC-DEC-06", "STMC-FIN-02")
async def stmc_ac_28_stop_limit_in_the_ramp_down(dut: Any) -> None:
    """Given command 6, when l3_n falls in gap 30 and l1_n soon after, then FIN 9E, at once."""
    lab = await Lab.start(dut)
    await lab.go(0x46)
    await lab.in_gap(30)
    lab.set(l3_n=0)
    await lab.in_gap(33)
    stamp = lab.set(l1_n=0)
    fell = await lab.ended()
    lab.window("AC-28", "pin to the interrupt", fell - stamp, 0, 8)
    await lab.outcome("AC-28", 34, 0x9E, MOST - 34)


@directed("AC-29", "STMC-IN-03")
async def stmc_ac_29_to_the_limit_ccw(dut: Any) -> None:
    """Given command 6 ccw, when l4_n falls in gap 12, then 22 steps."""
    lab = await Lab.start(dut)
    await lab.go(0x4E)
    await lab.in_gap(12)
    lab.set(l4_n=0)
    await lab.outcome("AC-29", 22, 0x8E, 0xFFFFE9)


@directed("AC-30", "STMC-IN-03", "STMC-MOT-07")
async def stmc_ac_30_constant_speed_to_the_limit(dut: Any) -> None:
    """Given command 5, when l3_n and then l1_n fall, then only l1_n ends it, after 50 steps."""
    lab = await Lab.start(dut)
    await lab.go(0x45, rate=10)
    await lab.in_gap(20)
    lab.set(l3_n=0)
    await lab.in_gap(49)
    lab.set(l1_n=0)
    await lab.outcome("AC-30", 50, 0x95, 0xFFFFCD, [10] * 49)


@directed("AC-31", "STMC-MOT-05", "STMC-SGL-02", "STMC-MOT-10")
async def stmc_ac_31_start_against_the_limit(dut: Any) -> None:
    """Given l1_n low, when 42 and 43 come, then no step and an interrupt at once; 4A steps."""
    lab = await Lab.start(dut)
    await lab.pins(l1_n=0)
    for script, steps, finish, rest in (
        ("c 42", 0, 0x92, 0),
        ("c 43 d 05 d 00 d 00", 0, 0x93, 5),
        ("c 4A", 1, 0x82, 0),
    ):
        lab.since = lab.bench.now
        words = script.rsplit(" ", 2)
        if words[0] and len(words) == 3:
            await lab.host.run(words[0])
        edge0 = await lab.host.write(int(words[-2] == "c"), int(words[-1], 16))
        await lab.bench.clocks(24 if not steps else 200)
        lab.window("AC-31", "int_n", lab.bench.falls("int_n", lab.since)[0] - edge0, 0, 24 + 90 * steps)
        lab.check("AC-31", "status", await lab.host.status(), 0)
        await lab.result("AC-31", steps, finish, rest)
        lab.check("AC-31", "int_n", lab.bench.level("int_n"), 1)


@directed("AC-32", "STMC-RUN-03")
async def stmc_ac_32_reference_point(dut: Any) -> None:
    """Given command 7, when cnp_n falls in gap 19, then 20 steps; again with it low, then none."""
    lab = await Lab.start(dut)
    await lab.go(0x47, rate=10)
    await lab.in_gap(19)
    lab.set(cnp_n=0)
    await lab.outcome("AC-32", 20, 0x87, 0xFFFFEB, [10] * 19)
    await lab.go(0x47, rate=10)
    await lab.result("AC-32", 0, 0x87, MOST)


@directed("AC-33", "STMC-IN-04")
async def stmc_ac_33_deceleration_limit_of_command_7(dut: Any) -> None:
    """Given command 7 cw, when l3_n falls in gap 5, then it stops at once."""
    lab = await Lab.start(dut)
    await lab.go(0x47, rate=10)
    await lab.in_gap(5)
    lab.set(l3_n=0)
    await lab.outcome("AC-33", 6, 0x8F, MOST - 6, [10] * 5)


@directed("AC-34", "STMC-IN-05", "STMC-INP-01")
async def stmc_ac_34_motor_off(dut: Any) -> None:
    """Given a move, when mon falls in gap 9, then 10 steps; while it is low, no step at all."""
    lab = await Lab.start(dut)
    await lab.go(0x44, 100, 10)
    await lab.in_gap(9)
    lab.set(mon=0)
    await lab.outcome("AC-34", 10, 0xA4, 89)
    pattern = lab.bench.level("s")
    await lab.go(0x42)
    await lab.result("AC-34", 0, 0xA2, 0)
    lab.check("AC-34", "inputs", await lab.inputs(), 0x8F)
    lab.check("AC-34", "phases", lab.bench.level("s"), pattern)
