"""Stop commands and operations (P104-STP, P104-OPR)."""

from __future__ import annotations

from cocotb_tests.harness import BUSY, ERR, F8, F16, F100, directed

from .env import PINS_LATEST, Lab
from .expected_timing import INIT_A, INIT_B, forced, rates, steps

ALL = 1 << 24


@directed("P104-STP-01", "P104-END-02", "P104-PHS-04", "P104-TIM-01", builds=(F16, F100))
async def p104_stp_01_immediate(dut):
    """0x40 during the high or low time of a pulse ends each kind of move there, with bit 6, and the
    phases stay energised (P104-STP-01).
    """
    lab = await Lab.start(dut, INIT_A)
    w = lab.cfg.w
    for code, n, rate in (
        (0x43, 500, None),
        (0x44, 500, 20),
        (0x45, None, 20),
        (0x46, None, None),
        (0x47, None, 20),
    ):
        for delay in (4, w - 8, w + 2, w + 40):
            await lab.go(code, n, rate)
            fall = await lab.pulse(3, delay)
            edge0 = await lab.host.command(0x40, poll=False)
            end = await lab.ended()
            await lab.idle()
            late = end - max(edge0, fall + w)
            lab.window(
                "P104-STP-01", f"end of {code:#x} after the stop or the pulse", late, 0, PINS_LATEST + 4
            )
            pattern = lab.bench.level("s")
            lab.check("P104-STP-01", "s is a pattern, not off", pattern in steps("4 full"), True)
            lab.check("P104-TIM-05", "low times", lab.bench.low_times(lab.since), [w] * 3)
            await lab.result("P104-STP-01", 3, 0xC0 | code & 7, (n or ALL) - 4)
            lab.check("P104-PHS-04", "s stays", lab.bench.level("s"), pattern)


@directed("P104-STP-01", "P104-LIM-09")
async def p104_stp_01_no_pulse_after_the_c_event(dut):
    """With 0x40 in each cycle around a pulse event, no pulse is output after the C-event, and the
    remaining count is right (P104-STP-01).
    """
    lab = await Lab.start(dut, INIT_A)
    seen = set()
    for before in range(2, 14):
        await lab.go(0x44, 10, rate=9)
        fall = await lab.pulse(3)
        await lab.bench.until(fall + 320 - before - 2)
        edge0 = await lab.host.write(1, 0x40)
        await lab.ended()
        await lab.idle()
        count = len(lab.pulses)
        seen.add(count)
        if before >= 12:
            lab.check("P104-STP-01", "pulses, stop in time", count, 3)
        lab.window("P104-STP-01", "last pulse after the write", lab.pulses[-1] - edge0, -400, PINS_LATEST)
        await lab.result("P104-STP-01", count, 0xC4, 10 - count - 1)
    lab.check("P104-STP-01", "both outcomes were met", seen, {3, 4})


@directed("P104-STP-02", "P104-STP-06", "P104-ERR-01")
async def p104_stp_02_at_rest(dut):
    """A stop at rest returns error 0 and has no effect: before and after initialisation, and after a
    move (P104-STP-02).
    """
    lab = await Lab.start(dut, None)
    for phase in range(4):
        if phase == 1:
            await lab.init(*INIT_A)
        if phase == 2:
            await lab.move(0x44, 3, rate=5)
        if phase == 3:
            await lab.host.command(0xC0)
        since = lab.bench.now
        for code in (0x40, 0x41, 0x78, 0x79):
            lab.check("P104-STP-02", f"{code:#x}, phase {phase}", await lab.host.command(code), 0x80)
        moved = {name: lab.bench.edges(name, since) for name in lab.outputs()}
        lab.check("P104-STP-06", "edges of outputs", moved, {name: [] for name in moved})
    lab.check("P104-STP-02", "finish status is that of the move", await lab.finish(), 0x84)


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
    """0x41 in any interval of 0x43 and 0x46 mirrors the ramp, in phase mode and in POUT mode
    (P104-STP-03).
    """
    lab = await Lab.start(dut, INIT_B)
    ramp = INIT_B[1:]
    for code in (0x43, 0x46, 0xC3, 0xC6):
        n = 300 if code & 7 == 3 else ALL
        for j in (1, 2, 5, 10, 11, 15) if code in (0x43, 0xC6) else (3, 12):
            await lab.go(code, n if code & 7 == 3 else None)
            await lab.pulse(j, lab.cfg.us(2))
            lab.check("P104-STP-03", "status of 0x41", await lab.host.command(0x41), BUSY)
            lab.check("P104-STP-04", "status of a second 0x41", await lab.host.command(0x41), 0xF4)
            await lab.idle()
            which = forced(1000, ramp[2], j)
            lab.check_train("P104-FDC-02", rates(ramp, which))
            await lab.result(
                "P104-END-03", j + 1 + which[j - 1], 0xC0 | code & 7, n - (j + 1 + which[j - 1]) - 1
            )


@directed("P104-STP-05", "P104-OPR-09", "P104-OPR-11", "P104-OPR-08")
async def p104_stp_05_decelerating_at_constant_speed(dut):
    """During 0x42, 0x44, 0x45 and 0x47, 0x41 acts like 0x40, without an error (P104-STP-05)."""
    lab = await Lab.start(dut, INIT_A)
    for code, n, rate in ((0x44, 300, 30), (0x45, None, 30), (0x47, None, 30)):
        await lab.go(code, n, rate)
        fall = await lab.pulse(4, 300)
        lab.check("P104-STP-05", f"ERR in {code:#x}", await lab.host.command(0x41) & ERR, 0)
        lab.window("P104-STP-05", "INT after the stop", await_end(lab) - fall, 300, 330)
        await lab.result("P104-STP-05", 4, 0xC0 | code & 7, (n or ALL) - 5)
    await lab.go(0x42)
    lab.check("P104-STP-05", "ERR in START of 0x42", await lab.host.command(0x41) & ERR, 0)
    await lab.result("P104-STP-05", 0, 0xC2, 0)


def await_end(lab: Lab) -> int:
    """Return the edge of the last fall of int_n."""
    return lab.bench.falls("int_n")[-1]


@directed("P104-STP-07", "P104-END-07")
async def p104_stp_07_mask_is_of_the_operation(dut):
    """After a stop, INT follows bit I of the move; bit 4 of the stop is ignored (P104-STP-07)."""
    lab = await Lab.start(dut, INIT_A)
    for operation in (0x45, 0x55, 0x46, 0x56):
        for stop in (0x40, 0x50, 0x41, 0x51):
            await lab.go(operation, None, 9 if operation & 7 == 5 else None)
            await lab.pulse(3, 100)
            await lab.host.command(stop)
            await lab.idle()
            masked = operation >> 4 & 1
            lab.check("P104-STP-07", f"int_n, {operation:#x} {stop:#x}", lab.bench.level("int_n"), masked)
            lab.check("P104-STP-07", "finish bits 7, 6", await lab.finish() & 0xC0, 0xC0)


@directed("P104-STP-08", "P104-END-05", "P104-END-01")
async def p104_stp_08_in_fin(dut):
    """In the low time of the last pulse, stops do not affect a complete or stopped move (P104-STP-08)."""
    lab = await Lab.start(dut, INIT_A)
    for code, rate, decel in ((0x43, None, 0xF4), (0x44, 9, 0x04), (0xC3, None, 0xF4)):
        for stop, status in ((0x40, 0x04), (0x41, decel)):
            await lab.go(code, 4, rate)
            await lab.pulse(4, 20)
            lab.check("P104-STP-08", f"{stop:#x} in FIN of {code:#x}", await lab.host.command(stop), status)
            await lab.result("P104-STP-08", 4, 0x80 | code & 7, 0)
    await lab.go(0x44, 10, rate=9)
    await lab.pulse(4, 4)
    await lab.host.command(0x40)
    lab.check("P104-STP-08", "0x41 while a stopped pulse is low", await lab.host.command(0x41), BUSY)
    await lab.result("P104-STP-08", 4, 0xC4, 5)
    for code, n in ((0x43, 100), (0x46, None)):
        await lab.go(code, n)
        await lab.pulse(3, 4)
        await lab.host.command(0x40)
        status = await lab.host.command(0x41)
        lab.check("P104-STP-08", f"0x41 while a stopped pulse of {code:#x} is low", status, 0xF4)
        await lab.result("P104-STP-08", 3, 0xC0 | code & 7, (n or ALL) - 4)


@directed("P104-OPR-02", "P104-OPR-03", "P104-GEN-05", "P104-END-06")
async def p104_opr_02_counts(dut):
    """If a move is stopped early, the remaining count shows that all three bytes of D were used
    (P104-OPR-02).
    """
    lab = await Lab.start(dut, INIT_A)
    for d in (0x000001, 0x000100, 0x010000, 0x123456, 0x800000, 0xFFFFFF):
        for code, rate in ((0x43, None), (0x44, 9)):
            await lab.go(code, d + 1, rate)
            await lab.pulse(1, 100)
            await lab.host.command(0x40)
            await lab.result("P104-OPR-02", 1, 0xC0 | code & 7, d - 1)
    for code, rate in ((0x45, 9), (0x46, None), (0x47, 9), (0xC6, None)):
        await lab.go(code, None, rate)
        await lab.pulse(2, 100)
        await lab.host.command(0x40)
        await lab.result("P104-OPR-02", 2, 0xC0 | code & 7, 0xFFFFFD)
    for d in (0, 1, 2, 299):
        await lab.move(0x44, d + 1, rate=4)
        await lab.result("P104-OPR-02", d + 1, 0x84, 0)
    await lab.move(0x42)
    await lab.result("P104-OPR-02", 1, 0x82, 0)
    await lab.move(0x43, 0x0101)
    await lab.result("P104-OPR-02", 257, 0x83, 0)


@directed("P104-OPR-04", "P104-OPR-08", "P104-INT-01", "P104-INT-05", "P104-BAD-17")
async def p104_opr_04_all_rates(dut):
    """For every rate byte 0..255, the intervals and low times of 3 pulses follow the formula
    (P104-OPR-04).
    """
    lab = await Lab.start(dut, INIT_A)
    for r in range(256):
        await lab.move(0x44, 3, rate=r)
        lab.check_train("P104-OPR-04", [r, r])
        lab.check_lows("P104-TIM-05", [r, r])


@directed("P104-OPR-05", "P104-EX-09", "P104-TIM-04", "P104-PHS-01")
async def p104_opr_05_phase_and_pout_mode(dut):
    """Only phase mode changes s: tried with a 5-phase half-step motor and moves in both directions
    (P104-OPR-05).
    """
    lab = await Lab.start(dut, (0x0F, 9, 4, 4))
    since = lab.bench.now
    await lab.move(0x4C, 4, rate=9)
    got = lab.bench.edges("s", since)
    lab.check("P104-EX-09", "s", [v for _, v in got], [0b10011, 0b10001, 0b11001, 0b11000])
    lab.check("P104-OPR-05", "edges of s are the pulses", [t for t, _ in got], lab.pulses)
    for code in (0xC3, 0xCB):
        before = lab.bench.level("s")
        await lab.move(code, 7)
        lab.check("P104-OPR-05", f"pulses of {code:#x}", len(lab.pulses), 7)
        lab.check("P104-OPR-05", f"edges of s, {code:#x}", lab.bench.edges("s", lab.since), [])
        lab.check("P104-OPR-05", "pattern", lab.bench.level("s"), before)
    await lab.move(0x44, 4, rate=9)
    back = [v for _, v in lab.bench.edges("s", lab.since)]
    lab.check("P104-OPR-05", "CW again from the same index", back, [0b11001, 0b10001, 0b10011, 0b00011])


@directed("P104-OPR-05", "P104-SW-03")
async def p104_opr_05_pout_mode_unchopped(dut):
    """With S = 1, the pattern stays on during the complete POUT-mode move (P104-OPR-05)."""
    lab = await Lab.start(dut, (0x2A, 9, 4, 4))
    await lab.bench.edge("s", 0)
    await lab.go(0xC3, 30)
    started = lab.bench.falls("hold", lab.since)[0]
    await lab.ended()
    lab.check("P104-OPR-05", "s from the start on", lab.bench.level_at("s", started), 0b00011)
    lab.check("P104-OPR-05", "edges of s in the move", lab.bench.edges("s", started + 1), [])


@directed("P104-OPR-06", "P104-TIM-02", "P104-TIM-05", builds=(F16, F8, F100))
async def p104_opr_06_single_step(dut):
    """Single steps are the same for any csel, vsel, clock source and ramp (P104-OPR-06)."""
    lab = await Lab.start(dut, (0x0A, 255, 200, 4))
    for external in (False, True):
        if external:
            await lab.init(0x1A, 0, 0, 4)
        for csel, vsel in ((1, 1), (0, 1), (1, 0), (0, 0)):
            lab.bench.set(csel=csel, vsel=vsel)
            await lab.bench.clocks(4)
            for code in (0x42, 0x4A):
                await lab.move(code)
                fell = lab.bench.falls("hold", lab.since)
                w = lab.cfg.w
                if fell:
                    lab.window("P104-OPR-06", "hold to pulse", lab.pulses[0] - fell[0], w, w + 2)
                lab.check("P104-OPR-06", "low time", lab.bench.low_times(lab.since), [w])
                await lab.result("P104-OPR-06", 1, 0x82, 0)


@directed("P104-OPR-11", "P104-LIM-06", "P104-END-06")
async def p104_opr_11_origin_search(dut):
    """CNP, at the start or between pulses, ends 0x47 CW and CCW without a cause bit and keeps the
    remaining count (P104-OPR-11).
    """
    lab = await Lab.start(dut, INIT_A)
    for code in (0x47, 0x4F):
        for count in (1, 2, 6):
            await lab.go(code, None, 12)
            await lab.pulse(count, 200)
            lab.bench.set(cnp_n=0)
            await lab.result("P104-OPR-11", count, 0x87, ALL - count - 1)
            lab.bench.set(cnp_n=1)
            await lab.bench.clocks(4)
            lab.check_train("P104-OPR-11", [12] * (count - 1))


@directed("P104-OPR-01", "P104-RD-07", "P104-RD-03")
async def p104_opr_01_status_of_old_move_replaced(dut):
    """A complete move after a stopped one has no cause bit and no remaining count of the old move
    (P104-OPR-01).
    """
    lab = await Lab.start(dut, INIT_A)
    for stop_first in (True, False, True):
        await lab.go(0x4C, 100, rate=9)
        await lab.pulse(3, 100)
        await lab.host.command(0x40)
        await lab.idle()
        if stop_first:
            await lab.result("P104-OPR-01", 3, 0xC4, 96)
        await lab.move(0x43, 2)
        await lab.result("P104-OPR-01", 2, 0x83, 0)
        lab.check("P104-RD-03", "bit 7 on the second read", await lab.finish(), 0x03)
