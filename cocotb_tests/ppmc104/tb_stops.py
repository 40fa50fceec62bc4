"""The stop commands and the operations (P104-STP, P104-OPR).

D = N - 1 is the number that a host sends for an operation of N pulses.
"""

from __future__ import annotations

from cocotb_tests.harness import BUSY, ERR, F8, F16, F100, directed

from .env import PINS_LATEST, Env
from .expected_timing import INIT_A, INIT_B, forced, rates, steps

ALL = 1 << 24


@directed("P104-STP-01", "P104-END-02", "P104-PHS-04", "P104-TIM-01", builds=(F16, F100))
async def p104_stp_01_immediate(dut):
    """If command 0x40 occurs in the high or low time of a pulse, each kind of move ends at this pulse, with
    finish bit 6, and the phases stay energised (P104-STP-01).
    """
    env = await Env.start(dut, INIT_A)
    w = env.cfg.w
    for code, n, rate in (
        (0x43, 500, None),
        (0x44, 500, 20),
        (0x45, None, 20),
        (0x46, None, None),
        (0x47, None, 20),
    ):
        for delay in (4, w - 8, w + 2, w + 40):
            await env.go(code, n, rate)
            fall = await env.pulse(3, delay)
            edge0 = await env.host.command(0x40, poll=False)
            end = await env.wait_end()
            await env.idle()
            late = end - max(edge0, fall + w)
            env.window(
                "P104-STP-01", f"end of {code:#x} after the stop or the pulse", late, 0, PINS_LATEST + 4
            )
            pattern = env.bench.level("s")
            env.check("P104-STP-01", "s is a pattern, not off", pattern in steps("4 full"), True)
            env.check("P104-TIM-05", "low times", env.bench.low_times(env.since), [w] * 3)
            await env.result("P104-STP-01", 3, 0xC0 | code & 7, (n or ALL) - 4)
            env.check("P104-PHS-04", "s stays", env.bench.level("s"), pattern)


@directed("P104-STP-01", "P104-LIM-09")
async def p104_stp_01_no_pulse_after_the_c_event(dut):
    """With command 0x40 in each cycle near a pulse event, no pulse is output after the core has consumed the
    command (its C-event), and the remaining count is correct (P104-STP-01).
    """
    env = await Env.start(dut, INIT_A)
    seen = set()
    for before in range(2, 14):
        await env.go(0x44, 10, rate=9)
        fall = await env.pulse(3)
        await env.bench.until(fall + 320 - before - 2)
        edge0 = await env.host.write(1, 0x40)
        await env.wait_end()
        await env.idle()
        count = len(env.pulses)
        seen.add(count)
        if before >= 12:
            env.check("P104-STP-01", "pulses, stop in time", count, 3)
        env.window("P104-STP-01", "last pulse after the write", env.pulses[-1] - edge0, -400, PINS_LATEST)
        await env.result("P104-STP-01", count, 0xC4, 10 - count - 1)
    env.check("P104-STP-01", "both outcomes were met", seen, {3, 4})


@directed("P104-STP-02", "P104-STP-06", "P104-ERR-01")
async def p104_stp_02_at_rest(dut):
    """A stop command at standstill returns error 0 and has no effect, before and after initialisation and
    after a move (P104-STP-02).
    """
    env = await Env.start(dut, None)
    for phase in range(4):
        if phase == 1:
            await env.init(*INIT_A)
        if phase == 2:
            await env.move(0x44, 3, rate=5)
        if phase == 3:
            await env.host.command(0xC0)
        since = env.bench.now
        for code in (0x40, 0x41, 0x78, 0x79):
            env.check("P104-STP-02", f"{code:#x}, phase {phase}", await env.host.command(code), 0x80)
        moved = {name: env.bench.edges(name, since) for name in env.outputs()}
        env.check("P104-STP-06", "edges of outputs", moved, {name: [] for name in moved})
    env.check("P104-STP-02", "finish status is that of the move", await env.finish(), 0x84)


@directed(
    "P104-STP-03",
    "P104-STP-04",
    "P104-FDC-01",
    "P104-FDC-02",
    "P104-END-03",
    "P104-OPR-07",
    "P104-OPR-10",
    builds=(F16, F8),
)
async def p104_stp_03_decelerating(dut):
    """Command 0x41 in any interval of the operations 0x43 and 0x46 mirrors the ramp, in phase mode and in
    POUT mode (P104-STP-03).
    """
    env = await Env.start(dut, INIT_B)
    ramp = INIT_B[1:]
    for code in (0x43, 0x46, 0xC3, 0xC6):
        n = 300 if code & 7 == 3 else ALL
        for j in (1, 2, 5, 10, 11, 15) if code in (0x43, 0xC6) else (3, 12):
            await env.go(code, n if code & 7 == 3 else None)
            await env.pulse(j, env.cfg.us(2))
            env.check("P104-STP-03", "status of 0x41", await env.host.command(0x41), BUSY)
            env.check("P104-STP-04", "status of a second 0x41", await env.host.command(0x41), 0xF4)
            await env.idle()
            which = forced(1000, ramp[2], j)
            env.check_train("P104-FDC-02", rates(ramp, which))
            await env.result(
                "P104-END-03", j + 1 + which[j - 1], 0xC0 | code & 7, n - (j + 1 + which[j - 1]) - 1
            )


@directed("P104-STP-05", "P104-OPR-09", "P104-OPR-11", "P104-OPR-08")
async def p104_stp_05_decelerating_at_constant_speed(dut):
    """During the operations 0x42, 0x44, 0x45 and 0x47, command 0x41 has the effect of command 0x40, without
    an error (P104-STP-05).
    """
    env = await Env.start(dut, INIT_A)
    for code, n, rate in ((0x44, 300, 30), (0x45, None, 30), (0x47, None, 30)):
        await env.go(code, n, rate)
        fall = await env.pulse(4, 300)
        env.check("P104-STP-05", f"ERR in {code:#x}", await env.host.command(0x41) & ERR, 0)
        env.window("P104-STP-05", "INT after the stop", await_end(env) - fall, 300, 330)
        await env.result("P104-STP-05", 4, 0xC0 | code & 7, (n or ALL) - 5)
    await env.go(0x42)
    env.check("P104-STP-05", "ERR in START of 0x42", await env.host.command(0x41) & ERR, 0)
    await env.result("P104-STP-05", 0, 0xC2, 0)


def await_end(env: Env) -> int:
    """Return the edge of the last fall of int_n."""
    return env.bench.falls("int_n")[-1]


@directed("P104-STP-07", "P104-END-07")
async def p104_stp_07_mask_is_of_the_operation(dut):
    """After a stop, bit I of the move determines INT; bit 4 of the stop code is ignored (P104-STP-07)."""
    env = await Env.start(dut, INIT_A)
    for operation in (0x45, 0x55, 0x46, 0x56):
        for stop in (0x40, 0x50, 0x41, 0x51):
            await env.go(operation, None, 9 if operation & 7 == 5 else None)
            await env.pulse(3, 100)
            await env.host.command(stop)
            await env.idle()
            masked = operation >> 4 & 1
            env.check("P104-STP-07", f"int_n, {operation:#x} {stop:#x}", env.bench.level("int_n"), masked)
            env.check("P104-STP-07", "finish bits 7, 6", await env.finish() & 0xC0, 0xC0)


@directed("P104-STP-08", "P104-END-05", "P104-END-01")
async def p104_stp_08_in_fin(dut):
    """In the low time of the last pulse, stops do not affect a complete or stopped move (P104-STP-08)."""
    env = await Env.start(dut, INIT_A)
    for code, rate, decel in ((0x43, None, 0xF4), (0x44, 9, 0x04), (0xC3, None, 0xF4)):
        for stop, status in ((0x40, 0x04), (0x41, decel)):
            await env.go(code, 4, rate)
            await env.pulse(4, 20)
            env.check("P104-STP-08", f"{stop:#x} in FIN of {code:#x}", await env.host.command(stop), status)
            await env.result("P104-STP-08", 4, 0x80 | code & 7, 0)
    await env.go(0x44, 10, rate=9)
    await env.pulse(4, 4)
    await env.host.command(0x40)
    env.check("P104-STP-08", "0x41 while a stopped pulse is low", await env.host.command(0x41), BUSY)
    await env.result("P104-STP-08", 4, 0xC4, 5)
    for code, n in ((0x43, 100), (0x46, None)):
        await env.go(code, n)
        await env.pulse(3, 4)
        await env.host.command(0x40)
        status = await env.host.command(0x41)
        env.check("P104-STP-08", f"0x41 while a stopped pulse of {code:#x} is low", status, 0xF4)
        await env.result("P104-STP-08", 3, 0xC0 | code & 7, (n or ALL) - 4)


@directed("P104-OPR-02", "P104-OPR-03", "P104-GEN-05", "P104-END-06")
async def p104_opr_02_counts(dut):
    """If a move is stopped early, the remaining count proves that all three bytes of D were used
    (P104-OPR-02).
    """
    env = await Env.start(dut, INIT_A)
    for d in (0x000001, 0x000100, 0x010000, 0x123456, 0x800000, 0xFFFFFF):
        for code, rate in ((0x43, None), (0x44, 9)):
            await env.go(code, d + 1, rate)
            await env.pulse(1, 100)
            await env.host.command(0x40)
            await env.result("P104-OPR-02", 1, 0xC0 | code & 7, d - 1)
    for code, rate in ((0x45, 9), (0x46, None), (0x47, 9), (0xC6, None)):
        await env.go(code, None, rate)
        await env.pulse(2, 100)
        await env.host.command(0x40)
        await env.result("P104-OPR-02", 2, 0xC0 | code & 7, 0xFFFFFD)
    for d in (0, 1, 2, 299):
        await env.move(0x44, d + 1, rate=4)
        await env.result("P104-OPR-02", d + 1, 0x84, 0)
    await env.move(0x42)
    await env.result("P104-OPR-02", 1, 0x82, 0)
    await env.move(0x43, 0x0101)
    await env.result("P104-OPR-02", 257, 0x83, 0)


@directed("P104-OPR-04", "P104-OPR-08", "P104-INT-01", "P104-INT-05", "P104-BAD-17")
async def p104_opr_04_all_rates(dut):
    """For each rate 0 to 255, the intervals and low times of 3 pulses follow the formula (P104-OPR-04)."""
    env = await Env.start(dut, INIT_A)
    for r in range(256):
        await env.move(0x44, 3, rate=r)
        env.check_train("P104-OPR-04", [r, r])
        env.check_lows("P104-TIM-05", [r, r])


@directed("P104-OPR-05", "P104-EX-09", "P104-TIM-04", "P104-PHS-01")
async def p104_opr_05_phase_and_pout_mode(dut):
    """Only phase mode changes s (P104-OPR-05).

    The test uses a 5-phase half-step motor and moves in both directions.
    """
    env = await Env.start(dut, (0x0F, 9, 4, 4))
    since = env.bench.now
    await env.move(0x4C, 4, rate=9)
    got = env.bench.edges("s", since)
    env.check("P104-EX-09", "s", [v for _, v in got], [0b10011, 0b10001, 0b11001, 0b11000])
    env.check("P104-OPR-05", "edges of s are the pulses", [t for t, _ in got], env.pulses)
    for code in (0xC3, 0xCB):
        before = env.bench.level("s")
        await env.move(code, 7)
        env.check("P104-OPR-05", f"pulses of {code:#x}", len(env.pulses), 7)
        env.check("P104-OPR-05", f"edges of s, {code:#x}", env.bench.edges("s", env.since), [])
        env.check("P104-OPR-05", "pattern", env.bench.level("s"), before)
    await env.move(0x44, 4, rate=9)
    back = [v for _, v in env.bench.edges("s", env.since)]
    env.check("P104-OPR-05", "CW again from the same index", back, [0b11001, 0b10001, 0b10011, 0b00011])


@directed("P104-OPR-05", "P104-SW-03")
async def p104_opr_05_pout_mode_unchopped(dut):
    """With S = 1, the pattern stays on during the complete POUT-mode move (P104-OPR-05)."""
    env = await Env.start(dut, (0x2A, 9, 4, 4))
    await env.bench.edge("s", 0)
    await env.go(0xC3, 30)
    started = env.bench.falls("hold", env.since)[0]
    await env.wait_end()
    env.check("P104-OPR-05", "s from the start on", env.bench.level_at("s", started), 0b00011)
    env.check("P104-OPR-05", "edges of s in the move", env.bench.edges("s", started + 1), [])


@directed("P104-OPR-06", "P104-TIM-02", "P104-TIM-05", builds=(F16, F8, F100))
async def p104_opr_06_single_step(dut):
    """Single steps are the same for each csel, vsel, clock source and ramp (P104-OPR-06)."""
    env = await Env.start(dut, (0x0A, 255, 200, 4))
    for external in (False, True):
        if external:
            await env.init(0x1A, 0, 0, 4)
        for csel, vsel in ((1, 1), (0, 1), (1, 0), (0, 0)):
            env.bench.set(csel=csel, vsel=vsel)
            await env.bench.clocks(4)
            for code in (0x42, 0x4A):
                await env.move(code)
                fell = env.bench.falls("hold", env.since)
                w = env.cfg.w
                if fell:
                    env.window("P104-OPR-06", "hold to pulse", env.pulses[0] - fell[0], w, w + 2)
                env.check("P104-OPR-06", "low time", env.bench.low_times(env.since), [w])
                await env.result("P104-OPR-06", 1, 0x82, 0)


@directed("P104-OPR-11", "P104-LIM-06", "P104-END-06")
async def p104_opr_11_origin_search(dut):
    """CNP, at the start or between pulses, ends operation 0x47 in either direction without a cause bit; the
    remaining count is correct (P104-OPR-11).
    """
    env = await Env.start(dut, INIT_A)
    for code in (0x47, 0x4F):
        for count in (1, 2, 6):
            await env.go(code, None, 12)
            await env.pulse(count, 200)
            env.bench.set(cnp_n=0)
            await env.result("P104-OPR-11", count, 0x87, ALL - count - 1)
            env.bench.set(cnp_n=1)
            await env.bench.clocks(4)
            env.check_train("P104-OPR-11", [12] * (count - 1))


@directed("P104-OPR-01", "P104-RD-07", "P104-RD-03")
async def p104_opr_01_status_of_old_move_replaced(dut):
    """A complete move that follows a stopped move has no cause bit and no remaining count of the stopped move
    (P104-OPR-01).
    """
    env = await Env.start(dut, INIT_A)
    for stop_first in (True, False, True):
        await env.go(0x4C, 100, rate=9)
        await env.pulse(3, 100)
        await env.host.command(0x40)
        await env.idle()
        if stop_first:
            await env.result("P104-OPR-01", 3, 0xC4, 96)
        await env.move(0x43, 2)
        await env.result("P104-OPR-01", 2, 0x83, 0)
        env.check("P104-RD-03", "bit 7 on the second read", await env.finish(), 0x03)
