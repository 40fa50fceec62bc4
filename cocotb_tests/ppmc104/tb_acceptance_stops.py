"""Acceptance checks AC-25 to AC-44 (except AC-40) at the pins, with the values of the acceptance table."""

from __future__ import annotations

from cocotb_tests.harness import ERR, OBF, directed

from .env import Env
from .expected_timing import INIT_A, INIT_B, STEP_CODES, rates, steps

A_DATA = "d 09 d 04 d 04 d 00"
A_INTERVALS = [320, 256, 192, 192, *[160] * 5, 192, 192, 256, 320]


@directed("AC-25", "P104-STP-05")
async def p104_ac_25_decelerating_stop_at_constant_speed(dut):
    """During an operation 0x45, command 0x41 after pulse 5 ends the motion immediately without an error
    (AC-25).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x45, rate=0x63)
    await env.pulse(5, 400)
    env.check("AC-25", "ERR", await env.host.command(0x41) & ERR, 0)
    await env.result("AC-25", 5, 0xC5, 0xFFFFFA)


@directed("AC-26", "P104-EX-04", "P104-FDC-03")
async def p104_ac_26_start_on_slow_down_limit(dut):
    """If L3 is low before 0x43 starts CW, exactly one pulse is output (AC-26)."""
    env = await Env.start(dut, INIT_B)
    env.bench.set(l3_n=0)
    await env.go(0x43, 1000)
    await env.result("AC-26", 1, 0x8B, 0x0003E6)


@directed("AC-27", "P104-FDC-01", "P104-FDC-04")
async def p104_ac_27_short_slow_down_limit(dut):
    """With initialisation B, L3 low for 10 cycles after pulse 4 starts a deceleration, which continues to its
    end (AC-27).
    """
    env = await Env.start(dut, INIT_B)
    await env.go(0x43, 1000)
    await env.pulse(4, 100)
    await env.bench.pulse_pin("l3_n", 0, 10)
    await env.result("AC-27", 8, 0x8B, 0x0003DF)
    env.check("AC-27", "intervals", env.intervals, [640, 576, 512, 480, 512, 576, 640])


@directed("AC-28", "P104-EX-05")
async def p104_ac_28_pout_mode_limit(dut):
    """In POUT mode with L3 always low, operation 0xC3 reaches the plateau before L3 takes effect (AC-28)."""
    env = await Env.start(dut, INIT_B)
    env.bench.set(l3_n=0)
    await env.go(0xC3, 1000)
    await env.result("AC-28", 22, 0x8B, 0x0003D1)
    env.check("AC-28", "edges of s", env.bench.edges("s", env.since), [])
    env.check_train("AC-28", rates(INIT_B[1:], [*range(11), *range(9, -1, -1)]))


@directed("AC-29", "P104-LIM-04")
async def p104_ac_29_pout_mode_missed_limit(dut):
    """In POUT mode, L3 has no effect if it is low only between pulses 3 and 8: all 1000 pulses are output
    (AC-29).
    """
    env = await Env.start(dut, INIT_B)
    await env.go(0xC3, 1000)
    await env.pulse(3)
    env.bench.set(l3_n=0)
    await env.pulse(8)
    env.bench.set(l3_n=1)
    await env.result("AC-29", 1000, 0x83, 0)


@directed("AC-30", "P104-LIM-02", "P104-LIM-08")
async def p104_ac_30_limits_of_the_direction(dut):
    """L1 and L3 do not affect a CCW move; with L4 low it outputs one pulse (AC-30)."""
    env = await Env.start(dut, INIT_B)
    env.bench.set(l1_n=0, l3_n=0)
    await env.go(0x4B, 30)
    await env.result("AC-30", 30, 0x83, 0)
    env.check("AC-30", "dir", env.bench.level("dir"), 1)
    env.bench.set(l1_n=1, l3_n=1, l4_n=0)
    await env.go(0x4B, 30)
    await env.result("AC-30", 1, 0x8B, 28)


@directed("AC-31", "P104-LIM-03", "P104-END-02")
async def p104_ac_31_hard_limit(dut):
    """During an operation 0x45, L1 after pulse 5 ends the motion within 8 cycles; afterwards only CCW
    operations output pulses (AC-31).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x45, rate=0x63)
    await env.pulse(5, 400)
    hit = env.bench.set(l1_n=0)
    late = await env.wait_end() - hit
    env.window("AC-31", "int_n after the pin edge", late, 0, 8)
    env.check("AC-31", "BUSY", await env.host.status() & 4, 0)
    await env.result("AC-31", 5, 0x95, 0xFFFFFA)
    await env.go(0x45, rate=0x63)
    await env.result("AC-31", 0, 0x95, 0xFFFFFF)
    await env.go(0x4D, rate=0x63)
    await env.pulse(3)
    env.check("AC-31", "BUSY of the CCW move", await env.host.status() & 4, 4)


@directed("AC-32", "P104-LIM-05")
async def p104_ac_32_alarm(dut):
    """ALM after pulse 6 of an operation 0x46 ends the operation with 6 pulses (AC-32)."""
    env = await Env.start(dut, INIT_A)
    await env.go(0x46)
    await env.pulse(6, 100)
    env.bench.set(alm_n=0)
    await env.result("AC-32", 6, 0xA6, 0xFFFFF9)


@directed("AC-33", "P104-LIM-07", "P104-LIM-09")
async def p104_ac_33_causes_at_start(dut):
    """With L1 and ALM low at the start, the operations 0x43 and 0x42 output no pulse. Each of them sets both
    cause bits, leaves the full remaining count, and asserts INT (AC-33).
    """
    env = await Env.start(dut, INIT_A)
    env.bench.set(l1_n=0, alm_n=0)
    pattern = env.bench.level("s")
    await env.go(0x43, 10)
    await env.result("AC-33", 0, 0xB3, 9)
    await env.go(0x42)
    await env.result("AC-33", 0, 0xB2, 0)
    env.check("AC-33", "s", env.bench.level("s"), pattern)
    env.check("AC-33", "falls of int_n", len(env.bench.falls("int_n")), 2)


@directed("AC-34", "P104-LIM-06")
async def p104_ac_34_origin(dut):
    """CNP after pulse 7 ends an operation 0x47 without a cause bit; an operation 0x44 ignores CNP (AC-34)."""
    env = await Env.start(dut, INIT_A)
    await env.go(0x47, rate=0x63)
    await env.pulse(7, 400)
    env.bench.set(cnp_n=0)
    await env.result("AC-34", 7, 0x87, 0xFFFFF8)
    await env.go(0x47, rate=0x63)
    await env.result("AC-34", 0, 0x87, 0xFFFFFF)
    await env.go(0x44, 4, rate=0x63)
    await env.result("AC-34", 4, 0x84, 0)


@directed("AC-35", "P104-END-05")
async def p104_ac_35_too_late(dut):
    """With N = 3, L1 in the low time of pulse 3 does not prevent a complete move (AC-35)."""
    env = await Env.start(dut, INIT_A)
    await env.go(0x43, 3)
    await env.pulse(3, 20)
    env.bench.set(l1_n=0)
    await env.result("AC-35", 3, 0x83, 0)


@directed("AC-36", "P104-CMD-04", "P104-RD-01")
async def p104_ac_36_commands_while_busy(dut):
    """During a move, commands that are not allowed return errors 1, 0 and 6, and the move is not affected
    (AC-36).
    """
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 6, rate=0x63)
    await env.pulse(2)
    got = await env.statuses("c 80 c 44 c 0A c 84 c 85 c 87 d 11")
    env.check("AC-36", "statuses", got, [*[0x94] * 5, 0x84, 0xE4])
    env.check("AC-36", "OBF", await env.host.status() & OBF, 0)
    await env.result("AC-36", 6, 0x84, 0)
    env.check("AC-36", "intervals", env.intervals, [3200] * 5)


@directed("AC-37", "P104-AUX-01", "P104-AUX-02", "P104-AUX-05")
async def p104_ac_37_aux_while_busy(dut):
    """During a move, the aux commands drive their pins, and the move is not affected (AC-37)."""
    env = await Env.start(dut, INIT_A)
    await env.go(0x44, 6, rate=0x63)
    await env.pulse(2)
    env.check("AC-37", "status after 0x86", await env.host.command(0x86), 0x14)
    env.check("AC-37", "status after its data", await env.host.data(0x05), 0x04)
    await env.bench.clocks(2)
    env.check("AC-37", "auxo", env.bench.level("auxo"), 0b1010)
    for code, level in ((0xC1, 0), (0xC2, 1), (0xC0, 0)):
        env.check("AC-37", f"status after {code:#x}", await env.host.command(code), 0x04)
        await env.bench.clocks(2)
        env.check("AC-37", f"aux_n after {code:#x}", env.bench.level("aux_n"), level)
    await env.result("AC-37", 6, 0x84, 0)
    env.check("AC-37", "intervals", env.intervals, [3200] * 5)
    await env.go(0x42)
    await env.result("AC-37", 1, 0x82, 0)


@directed("AC-38", "P104-AUX-02", "P104-RD-08")
async def p104_ac_38_aux_before_init(dut):
    """The auxiliary ports work before initialisation (AC-38)."""
    env = await Env.start(dut, None)
    await env.host.run("c 86 d FF")
    await env.bench.clocks(2)
    env.check("AC-38", "auxo", env.bench.level("auxo"), 0b0000)
    await env.host.run("c 86 d A0")
    await env.bench.clocks(2)
    env.check("AC-38", "auxo", env.bench.level("auxo"), 0b1111)
    env.bench.set(auxi=0b1001)
    env.check("AC-38", "0x85", await env.host.run("c 85 r"), [0x09])


@directed("AC-39", "P104-HSK-07")
async def p104_ac_39_cancelled_command(dut):
    """A read command cancels an operation whose parameters are incomplete (AC-39)."""
    env = await Env.start(dut, INIT_A)
    env.check("AC-39", "0x81", await env.host.run("c 43 d 09 c 81 r"), [0xCF])
    env.check("AC-39", "status after a late byte", await env.host.data(0x00), 0xB0)
    await env.bench.clocks(500)
    env.check("AC-39", "pulses", env.bench.pulses(), [])


@directed("AC-41", "P104-INI-03", "P104-INI-06")
async def p104_ac_41_rejected_inits(dut):
    """After initialisation A, four illegal initialisations return errors 5, 5, 4 and 4, and the old ramp
    stays active (AC-41).
    """
    env = await Env.start(dut, INIT_A)
    cases = (((5, 6, 100), 0xD0), ((9, 4, 3), 0xD0), ((9, 4, 11221), 0xC0), ((5, 6, 11221), 0xC0))
    for values, status in cases:
        env.check("AC-41", f"status of {values}", await env.host.init(0x0A, *values), status)
    await env.go(0x43, 14)
    await env.result("AC-41", 14, 0x83, 0)
    env.check("AC-41", "intervals", env.intervals, A_INTERVALS)


@directed("AC-42", "P104-INI-03", "P104-EX-11")
async def p104_ac_42_extreme_inits(dut):
    """The extreme legal values of an initialisation are accepted; with RL = RH, all intervals have one rate
    (AC-42).
    """
    env = await Env.start(dut, None)
    for values in ((9, 4, 4), (9, 4, 11220), (10, 10, 4), (255, 0, 4)):
        env.check("AC-42", f"status of {values}", await env.host.init(0x0A, *values), 0x00)
        if values == (10, 10, 4):
            await env.move(0x43, 12)
            env.check("AC-42", "intervals", env.intervals, [352] * 11)


@directed("AC-43", "P104-INI-05", "P104-AUX-04")
async def p104_ac_43_frozen_until_excitation_off(dut):
    """A re-initialisation for 5 phases after initialisation A changes the motor type only after Excitation
    OFF (AC-43).
    """
    env = await Env.start(dut, INIT_A)
    await env.host.run(f"c 0F {A_DATA}")
    env.check("AC-43", "s after the re-init", env.bench.level("s"), 0b00011)
    await env.move(0x42)
    env.check("AC-43", "s after a step", env.bench.level("s"), 0b00110)
    await env.host.run("c C0")
    await env.bench.clocks(2)
    env.check("AC-43", "s after Excitation OFF", env.bench.level("s"), 0b00000)
    env.check("AC-43", "status of 0x42", await env.host.command(0x42), 0xA0)
    await env.host.run(f"c 0F {A_DATA}")
    got = [env.bench.level("s")]
    for _ in range(3):
        await env.move(0x42)
        got.append(env.bench.level("s"))
    env.check("AC-43", "s of the new motor", got, [0b00011, 0b00111, 0b00110, 0b01110])


@directed("AC-44", "P104-PHS-01", "P104-PHS-06", "P104-OPR-05")
async def p104_ac_44_step_lists(dut):
    """For each motor type and logic, s follows its list through two electrical turns CW and back (AC-44)."""
    env = await Env.start(dut, None)
    for name, code in STEP_CODES.items():
        for positive in (True, False):
            await env.host.command(0xC0)
            await env.init(code if positive else code & ~8, 9, 4, 4)
            table = steps(name, positive)
            length = len(table)
            await env.bench.clocks(2)
            since, got, directions = env.bench.now, [env.bench.level("s")], []
            for op in [0x52] * (2 * length) + [0x5A] * (2 * length):
                await env.move(op)
                directions.append(env.bench.level("dir"))
            env.check("AC-44", "dir", directions, [0] * (2 * length) + [1] * (2 * length))
            got += [value for _, value in env.bench.edges("s", since)]
            walk = [*range(2 * length + 1), *range(2 * length - 1, -1, -1)]
            env.check("AC-44", f"{name}, positive {positive}", got, [table[i % length] for i in walk])
