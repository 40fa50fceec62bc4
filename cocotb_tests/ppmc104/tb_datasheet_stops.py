"""Processing times of the old chip, second part: decelerating stops, aux commands, speed limit, external
clock.

I(j) is the interval that follows pulse j.
"""

from __future__ import annotations

from cocotb_tests.harness import BUSY, D11, D16, IBF, directed

from .datasheet_env import TOLERANCE, US, DatasheetEnv
from .env import WRITE_EVENT
from .expected_timing import INIT_B, forced, rates


@directed("P104-DS-08", "P104-DS-10", "P104-END-03", "P104-FDC-02", builds=(D16, D11))
async def p104_ds_10_decelerating_stop(dut):
    """If command 0x41 is sent in I(4), its flag is set 17 us later, so I(4) or I(5) is the last interval of
    the acceleration. INT follows the end by 200 us (P104-DS-10).
    """
    # All intervals are long enough to keep the mailbox open (P104-DS-12).
    ramp = (60, 30, 10)
    env = await DatasheetEnv.start(dut, (0x0A, *ramp))
    fourth = env.cfg.quanta(8 * (rates(ramp, [3])[0] + 1))
    for early, interval in ((50, 4), (-50, 5)):
        await env.event(0x43, 200)
        fall = await env.pulse(4)
        await env.bench.until(fall + fourth - env.cfg.us(17) - early)
        event = await env.host.command(0x41, poll=False) + WRITE_EVENT
        await env.host.poll(IBF, 0)
        env.check("P104-DS-10", "no error", await env.host.status(), BUSY)
        await env.opens("P104-DS-10", event, 17 * US)
        which = forced(200, 10, interval)
        last = await env.pulse(len(which) + 1, 20)
        await env.opens("P104-DS-08", last, 200 * US, 0xC2)
        end = await env.wait_end()
        env.after("P104-DS-08", "INT after the last fall", end - last, 200 * US)
        await env.idle()
        env.check_train("P104-DS-10", rates(ramp, which))
        await env.result("P104-DS-10", len(which) + 1, 0xC3, 200 - len(which) - 2)
        await env.host.command(0xC2)
        await env.rest()


@directed("P104-DS-10", "P104-FDC-01", "P104-LIM-04", builds=(D16,))
async def p104_ds_10_slow_down_limit(dut):
    """If L3 is low for 10 cycles, the deceleration flag is set 12 us later in START or ACC, and 17 us later
    in HIGH (P104-DS-10).
    """
    env = await DatasheetEnv.start(dut, INIT_B)
    # j: interval in which L3 falls; then its length and the delay of the flag, in cycles at 16 MHz.
    for j, length, delay in ((4, 480, 192), (13, 320, 272)):
        for early in (40, -40):
            await env.event(0x43, 200)
            fall = await env.pulse(j)
            await env.bench.until(fall + length - delay - early)
            await env.bench.pulse_pin("l3_n", 0, 10)
            await env.idle()
            which = forced(200, 10, j if early > 0 else j + 1)
            env.check_train("P104-DS-10", rates(INIT_B[1:], which))
            await env.result("P104-DS-10", len(which) + 1, 0x8B, 200 - len(which) - 2)
            await env.rest()
    await env.event(0x43, 200)
    await env.bench.level_is("hold", 0)
    await env.host.poll(BUSY, BUSY)
    await env.bench.pulse_pin("l3_n", 0, 10)
    await env.idle()
    await env.result("P104-DS-10", 1, 0x8B, 198)


@directed("P104-DS-10", "P104-END-05", "P104-FDC-05", builds=(D16,))
async def p104_ds_10_flag_too_late(dut):
    """If command 0x41 or L3 sets the deceleration flag only after the natural deceleration or the end has
    begun, the flag has no effect on this operation or the next one (P104-DS-10).
    """
    env = await DatasheetEnv.start(dut, INIT_B)
    for cause in ("41", "l3_n", "none"):
        # With N = 8, natural deceleration begins at pulse 5, and I(4) is 480 cycles long. With N = 2, I(1) is
        # 640 cycles long.
        for n, j, length in ((8, 4, 480), (2, 1, 640)):
            await env.event(0x43, n)
            fall = await env.pulse(j)
            await env.bench.until(fall + length - 60)
            if cause == "41":
                await env.host.command(0x41, poll=False)
                env.check("P104-DS-10", "no error", await env.host.poll(IBF, 0), BUSY)
            elif cause == "l3_n":
                await env.bench.pulse_pin("l3_n", 0, 10)
            await env.idle()
            which = [min(i - 1, n - 1 - i, 10) for i in range(1, n)]
            env.check_train("P104-DS-10", rates(INIT_B[1:], which))
            await env.result("P104-DS-10", n, 0x83, 0)
            await env.rest()


@directed("P104-DS-11", "P104-AUX-01", "P104-AUX-02", "P104-AUX-05", builds=(D16, D11))
async def p104_ds_11_aux_times(dut):
    """AUX ON/OFF, the command for the auxiliary outputs, and command 0xC0 change their pins 14 or 18 us after
    the write; until then the mailbox is closed (P104-DS-11).
    """
    env = await DatasheetEnv.start(dut, (0x02, 9, 4, 4))
    for code, pin in ((0xC1, "aux_n"), (0xC2, "aux_n")):
        event = await env.host.write(1, code) + WRITE_EVENT
        await env.bench.until(event + 10)
        env.check("P104-DS-11", "IBF falls as in FAST", await env.host.status() & IBF, 0)
        await env.opens("P104-DS-11", event, 14 * US, 0x87)
        env.after("P104-DS-11", f"{pin} after {code:#x}", env.bench.edges(pin, event)[0][0] - event, 14 * US)
    await env.host.command(0x86)
    event = await env.host.write(0, 0x05) + WRITE_EVENT
    env.after("P104-DS-11", "auxo", await env.bench.edge("auxo", 0xA) - event, 14 * US)
    await env.bench.clocks(40)
    await env.event(0x44, 3, 255)
    await env.pulse(1, 40)
    event = await env.host.write(1, 0xC0) + WRITE_EVENT
    env.after("P104-DS-11", "aux_n by 0xC0 while BUSY", await env.bench.edge("aux_n", 0) - event, 14 * US)
    await env.idle()
    await env.rest()
    event = await env.host.write(1, 0xC0) + WRITE_EVENT
    await env.bench.until(event + 10)
    await env.opens("P104-DS-11", event, 18 * US, 0x42)
    env.check("P104-AUX-04", "0x42 afterwards", await env.host.status(), 0xA0)
    env.after("P104-DS-11", "s by 0xC0", env.bench.edges("s", event)[0][0] - event, 18 * US)


@directed("P104-DS-12", "P104-STP-01", builds=(D16,))
async def p104_ds_12_speed_limit(dut):
    """Command 0xC1 waits during intervals below 148 quanta (phase mode) or 100 quanta (POUT mode); it is
    accepted in longer intervals (P104-DS-12).
    """
    env = await DatasheetEnv.start(dut, None)
    # The intervals are just below and just above the limit, in quanta: 144 and 152 in phase mode, 96 and 104
    # in POUT mode, 142 and 150 with vsel = L.
    for rate, code, vsel, open_ in (
        (17, 0x44, 1, False),
        (18, 0x44, 1, True),
        (13, 0x44, 0, False),
        (14, 0x44, 0, True),
        (11, 0xC3, 1, False),
        (12, 0xC3, 1, True),
    ):
        await env.init(0x0A, rate, rate, 4)
        env.bench.set(vsel=vsel)
        await env.event(code, 12, rate if code == 0x44 else None)
        await env.pulse(3, 40)
        await env.host.command(0xC1 if env.bench.level("aux_n") else 0xC2, poll=False)
        await env.bench.clocks(20)
        what = f"IBF at rate {rate}, {code:#x}, vsel {vsel}"
        env.check("P104-DS-12", what, await env.host.status() & IBF, 0 if open_ else IBF)
        if not open_:
            await env.pulse(12, 1000)
            env.check("P104-DS-12", "IBF after the last pulse", await env.host.status() & IBF, IBF)
            await env.host.poll(IBF, 0)
        await env.result("P104-DS-12", 12, 0x80 | code & 7, 0)
        await env.rest()


@directed("P104-DS-12", "P104-LIM-01", "P104-STP-04", builds=(D16,))
async def p104_ds_12_ends_with_the_fast_part(dut):
    """If command 0xC1 waits during a fast plateau, it is accepted in the first slow interval; command 0x41
    and limits take effect immediately (P104-DS-12).
    """
    env = await DatasheetEnv.start(dut, INIT_B)
    await env.event(0x43, 60)
    await env.pulse(15, 40)
    await env.host.command(0xC1, poll=False)
    # The rates while decelerating are 9,10,10,11,12,12,14,15,17,19. I(58) has rate 17 and lasts 144 quanta;
    # I(59), the last interval, has rate 19 and lasts 160 quanta.
    await env.pulse(58, 100)
    env.check("P104-DS-12", "IBF in I(58), 144 q", await env.host.status() & IBF, IBF)
    await env.pulse(59, 60)
    env.check("P104-DS-12", "IBF in I(59), 160 q", await env.host.status() & IBF, 0)
    await env.result("P104-DS-12", 60, 0x83, 0)
    await env.host.command(0xC2)
    await env.rest()
    await env.event(0x43, 200)
    await env.pulse(15, 10)
    await env.host.command(0x41, poll=False)
    await env.bench.clocks(20)
    env.check("P104-DS-12", "0x41 is taken", await env.host.status() & IBF, 0)
    # The deceleration flag is set 17 us = 272 cycles later, in the same interval of 320 cycles.
    await env.result("P104-DS-12", 26, 0xC3, 173)
    await env.rest()
    await env.event(0x44, 100, 9)
    await env.pulse(5, 100)
    env.bench.set(l1_n=0)
    await env.result("P104-DS-12", 5, 0x94, 94)


@directed("P104-DS-04", "P104-DS-05", "P104-DS-12", "P104-TIM-03", builds=(D16,))
async def p104_ds_04_external_clock(dut):
    """With an external clock, the first edge after 194 or 200 us causes pulse 1, and no speed limit applies
    (P104-DS-04, P104-DS-05, P104-DS-12).
    """
    env = await DatasheetEnv.start(dut, (0x1A, 9, 4, 4))
    for code, n, rate, first in ((0x44, 8, 0, 194), (0x43, 14, None, 200)):
        await env.host.command(0xC2)
        await env.rest()
        event = await env.event(code, n, rate)
        clock = env.bench.external_clock([180] * 200, high=90)
        pulse = await env.pulse(1)
        edges = env.clock_edges(event)
        nominal = event + env.cfg.us(first)
        candidates = [t for t in edges if nominal - 3 <= t + 3 and t <= pulse]
        env.window("P104-DS-04", f"edge to pulse 1 of {code:#x}", pulse - candidates[0], 2, 5 + TOLERANCE)
        env.window("P104-DS-04", f"pulse 1 of {code:#x}", pulse - nominal, 0, 180 + TOLERANCE + 5)
        await env.pulse(3, 20)
        await env.host.command(0xC1, poll=False)
        await env.bench.clocks(20)
        env.check("P104-DS-12", "IBF: not applied to the external clock", await env.host.status() & IBF, 0)
        await env.result("P104-DS-04", n, 0x80 | code & 7, 0)
        clock.cancel()
        await env.bench.align()
        env.bench.set(clock=0)
