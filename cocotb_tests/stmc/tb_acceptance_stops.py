"""Acceptance checks AC-21 to AC-34 at the pins: stops, limits, reference point, motor switch.

Gap i is the time from step i to step i + 1. W1 to W23 are the worked moves of the manual.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import directed

from .env import Env
from .expected_timing import MOST
from .tb_acceptance_moves import W1, W2

W14 = [20, 12, 9, 8, 9, 12, 20]


async def stop_in_gap(env: Env, gap: int, n: int = 100, code: int = 0x41, plus: int = 30) -> int:
    """Start command 3 with n steps and send a stop code in this gap; return the status after the code."""
    await env.go(0x43, n)
    await env.in_gap(gap, plus)
    return await env.command(code)


@directed("AC-21", "STMC-STP-03", "STMC-DEC-04", "STMC-REM-01")
async def stmc_ac_21_the_rest_of_a_stopped_move(dut: Any) -> None:
    """In a move of 100 steps, code 41 in gap 3 results in W14; a move with the remaining value makes the
    missing steps (AC-21).
    """
    env = await Env.start(dut)
    await stop_in_gap(env, 3)
    await env.outcome("AC-21", 8, 0xC3, 0x5B, W14)
    env.since = env.bench.now
    await env.host.run("c 43 d 5B d 00 d 00")
    await env.outcome("AC-21", 92, 0x83, 0)


@directed("AC-22", "STMC-DEC-03", "STMC-DEC-04")
async def stmc_ac_22_requests_at_other_speeds(dut: Any) -> None:
    """In a move of 100 steps, code 41 in gap 10, 1 or 0 results in W15, W16 or W17 (AC-22)."""
    env = await Env.start(dut)
    for gap, ticks, rest in ((10, W1, 79), (1, [20, 12, 20], 95), (0, [], 98)):
        await stop_in_gap(env, gap)
        await env.outcome("AC-22", len(ticks) + 1, 0xC3, rest, ticks)


@directed("AC-23", "STMC-DEC-01", "STMC-STP-04", "STMC-FIN-02")
async def stmc_ac_23_around_the_turn(dut: Any) -> None:
    """In a move of 12 steps, code 41 is accepted in gap 5 and returns error 7 in gap 6; both moves are
    complete (AC-23).
    """
    env = await Env.start(dut)
    for gap, status in ((5, 0x04), (6, 0xF4)):
        env.check("AC-23", f"status in gap {gap}", await stop_in_gap(env, gap, 12), status)
        await env.outcome("AC-23", 12, 0x83, 0, W2)


@directed("AC-24", "STMC-STP-01")
async def stmc_ac_24_emergency_stop(dut: Any) -> None:
    """In a move of 100 steps, no step follows code 40 in gap 10 (AC-24)."""
    env = await Env.start(dut)
    await stop_in_gap(env, 10, code=0x40)
    await env.outcome("AC-24", 11, 0xC3, 0x58)


@directed("AC-25", "STMC-STP-02")
async def stmc_ac_25_command_1_at_constant_speed(dut: Any) -> None:
    """At constant speed, code 41 or 40 in gap 2 stops the motion immediately (AC-25)."""
    env = await Env.start(dut)
    for code in (0x41, 0x40):
        await env.go(0x44, 256, 0x14)
        await env.in_gap(2)
        await env.command(code)
        await env.outcome("AC-25", 3, 0xC4, 0xFC, [20, 20])


@directed("AC-26", "STMC-IN-01", "STMC-DEC-05")
async def stmc_ac_26_deceleration_limit(dut: Any) -> None:
    """In a cw move of 100 steps, l3_n low for 4 cycles in gap 10 causes the deceleration of W15 (AC-26)."""
    env = await Env.start(dut)
    await env.go(0x43, 100)
    await env.in_gap(10)
    await env.blip("l3_n")
    await env.outcome("AC-26", 20, 0x8B, 0x4F, W1)


@directed("AC-27", "STMC-IN-03")
async def stmc_ac_27_limits_of_the_other_direction(dut: Any) -> None:
    """If l4_n and l2_n are low all the time, a cw move is not affected (AC-27)."""
    env = await Env.start(dut, l4_n=0, l2_n=0)
    await env.go(0x43, 100)
    await env.outcome("AC-27", 100, 0x83, 0)


@directed("AC-28", "STMC-DEC-06", "STMC-FIN-02")
async def stmc_ac_28_stop_limit_in_the_ramp_down(dut: Any) -> None:
    """In command 6, l3_n in gap 30 and l1_n shortly afterwards end the motion immediately with FIN 9E
    (AC-28).
    """
    env = await Env.start(dut)
    await env.go(0x46)
    await env.in_gap(30)
    env.set(l3_n=0)
    await env.in_gap(33)
    stamp = env.set(l1_n=0)
    fell = await env.wait_end()
    env.window("AC-28", "pin to the interrupt", fell - stamp, 0, 8)
    await env.outcome("AC-28", 34, 0x9E, MOST - 34)


@directed("AC-29", "STMC-IN-03")
async def stmc_ac_29_to_the_limit_ccw(dut: Any) -> None:
    """In command 6 ccw, l4_n in gap 12 results in 22 steps (AC-29)."""
    env = await Env.start(dut)
    await env.go(0x4E)
    await env.in_gap(12)
    env.set(l4_n=0)
    await env.outcome("AC-29", 22, 0x8E, 0xFFFFE9)


@directed("AC-30", "STMC-IN-03", "STMC-MOT-07")
async def stmc_ac_30_constant_speed_to_the_limit(dut: Any) -> None:
    """In command 5, l3_n has no effect, and l1_n ends the motion after 50 steps (AC-30)."""
    env = await Env.start(dut)
    await env.go(0x45, rate=10)
    await env.in_gap(20)
    env.set(l3_n=0)
    await env.in_gap(49)
    env.set(l1_n=0)
    await env.outcome("AC-30", 50, 0x95, 0xFFFFCD, [10] * 49)


@directed("AC-31", "STMC-MOT-05", "STMC-SGL-02", "STMC-MOT-10")
async def stmc_ac_31_start_against_the_limit(dut: Any) -> None:
    """With l1_n low, codes 42 and 43 make no step and assert the interrupt immediately; code 4A makes a step
    (AC-31).
    """
    env = await Env.start(dut)
    await env.pins(l1_n=0)
    for script, steps, finish, rest in (
        ("c 42", 0, 0x92, 0),
        ("c 43 d 05 d 00 d 00", 0, 0x93, 5),
        ("c 4A", 1, 0x82, 0),
    ):
        env.since = env.bench.now
        words = script.rsplit(" ", 2)
        if words[0] and len(words) == 3:
            await env.host.run(words[0])
        edge0 = await env.host.write(int(words[-2] == "c"), int(words[-1], 16))
        await env.bench.clocks(24 if not steps else 200)
        env.window("AC-31", "int_n", env.bench.falls("int_n", env.since)[0] - edge0, 0, 24 + 90 * steps)
        env.check("AC-31", "status", await env.host.status(), 0)
        await env.result("AC-31", steps, finish, rest)
        env.check("AC-31", "int_n", env.bench.level("int_n"), 1)


@directed("AC-32", "STMC-RUN-03")
async def stmc_ac_32_reference_point(dut: Any) -> None:
    """In command 7, cnp_n in gap 19 results in 20 steps; if the command starts with cnp_n low, it makes no
    step (AC-32).
    """
    env = await Env.start(dut)
    await env.go(0x47, rate=10)
    await env.in_gap(19)
    env.set(cnp_n=0)
    await env.outcome("AC-32", 20, 0x87, 0xFFFFEB, [10] * 19)
    await env.go(0x47, rate=10)
    await env.result("AC-32", 0, 0x87, MOST)


@directed("AC-33", "STMC-IN-04")
async def stmc_ac_33_deceleration_limit_of_command_7(dut: Any) -> None:
    """In command 7 cw, l3_n in gap 5 stops the motion immediately (AC-33)."""
    env = await Env.start(dut)
    await env.go(0x47, rate=10)
    await env.in_gap(5)
    env.set(l3_n=0)
    await env.outcome("AC-33", 6, 0x8F, MOST - 6, [10] * 5)


@directed("AC-34", "STMC-IN-05", "STMC-INP-01")
async def stmc_ac_34_motor_off(dut: Any) -> None:
    """If mon falls in gap 9, a move ends with 10 steps; while mon is low, no step is made (AC-34)."""
    env = await Env.start(dut)
    await env.go(0x44, 100, 10)
    await env.in_gap(9)
    env.set(mon=0)
    await env.outcome("AC-34", 10, 0xA4, 89)
    pattern = env.bench.level("s")
    await env.go(0x42)
    await env.result("AC-34", 0, 0xA2, 0)
    env.check("AC-34", "inputs", await env.inputs(), 0x8F)
    env.check("AC-34", "phases", env.bench.level("s"), pattern)
