"""Processing times of the old chip, TIMING = "DATASHEET" (P104-DS).

All times are CYC(16·us), -0/+16 cycles.

D = N - 1 is the number that a host sends for an operation of N pulses.
"""

from __future__ import annotations

from cocotb_tests.harness import BUSY, D11, D16, DATA, IBF, directed
from cocotb_tests.harness.config import D25X8

from .datasheet_env import PIN, TOLERANCE, US, DatasheetEnv
from .env import WRITE_EVENT
from .expected_timing import INIT_A


@directed("P104-DS-01", "P104-INI-07", builds=(D16, D11))
async def p104_ds_01_phase_outputs(dut):
    """44 us after the last byte of the first initialisation, s changes to pattern 0; a re-initialisation does
    not change s (P104-DS-01).
    """
    env = await DatasheetEnv.start(dut, None)
    await env.host.send(0x0A, [9, 4, 4])
    event = await env.host.data(0, poll=False) + WRITE_EVENT
    shown = await env.bench.edge("s", 3)
    env.after("P104-DS-01", "s after the write event", shown - event, 44 * US)
    await env.opens("P104-DS-02", event, 264_000)
    await env.bench.clocks(env.cfg.us(20))
    await env.move(0x42)
    await env.rest()
    since = env.bench.now
    await env.host.init(*INIT_A)
    await env.bench.clocks(env.cfg.us(100))
    env.check("P104-DS-01", "edges of s at a re-init", env.bench.edges("s", since), [])


@directed("P104-DS-02", "P104-INI-08", "P104-HSK-01", builds=(D16, D25X8))
async def p104_ds_02_init_time(dut):
    """For PA 4 and 104, the mailbox opens 264000 + 209·(PA - 4) crystal cycles after the initialisation, and
    chopping starts then (P104-DS-02).
    """
    env = await DatasheetEnv.start(dut, None)
    for pa in (4, 104):
        await env.host.send(0x2A, [9, 4, pa])
        event = await env.host.data(0, poll=False) + WRITE_EVENT
        opened = event + env.cfg.cyc(264_000 + 209 * (pa - 4))
        await env.host.poll(IBF, 0)
        env.check("P104-DS-02", "BUSY while closed", await env.host.status(), 0x00)
        await env.opens("P104-DS-02", event, 264_000 + 209 * (pa - 4))
        off = await env.bench.edge("s", 0)
        env.full_on_phase("P104-INI-08", opened, off, TOLERANCE)
        await env.host.command(0xC0)
        await env.bench.clocks(env.cfg.us(20))


@directed("P104-DS-02", "P104-DS-13", "P104-INI-06", builds=(D16,))
async def p104_ds_13_no_time_for_the_rest(dut):
    """After a rejected initialisation, a read, command 0x84 or an error, the next bytes are accepted as early
    as in FAST (P104-DS-13).
    """
    env = await DatasheetEnv.start(dut, None)
    got = []
    for script in (
        "c 0A d 04 d 09 d 04 d 00",
        "c 81",
        "c 80",
        "c 84 d 10 d 20",
        "c 87",
        "c 42",
        "c 00",
        "d 00",
    ):
        words = script.split()
        for kind, byte in zip(words[::2], words[1::2], strict=True):
            edge0 = await env.host.write(int(kind == "c"), int(byte, 16))
            await env.bench.until(edge0 + 12)
            got.append(await env.host.status())
    expected = [0x40, 0x30, 0x20, 0x10, 0xD0, 0x01, 0x01, 0x21, 0x11, 0x01, 0x81, 0xA1, 0x81, 0xB1]
    env.check("P104-DS-13", "statuses 12 cycles after each byte", got, expected)
    edge0 = await env.host.write(1, 0x82)
    await env.bench.until(edge0 + 12)
    env.check("P104-DS-13", "0x82", await env.host.read(DATA), 0xFC)


@directed("P104-DS-03", "P104-DS-04", "P104-DS-05", "P104-TIM-04", builds=(D16, D11))
async def p104_ds_03_start_times(dut):
    """For every operation, BUSY, hold, dir, s and pulse 1 change at the documented times after the last byte
    (P104-DS-03, P104-DS-04, P104-DS-05).
    """
    env = await DatasheetEnv.start(dut, (0x2A, 9, 4, 4))
    for code, n, rate, busy, first in (
        (0x4C, 3, 99, 27, 194 * US),
        (0x45, None, 99, 27, 194 * US),
        (0x4F, None, 99, 27, 194 * US),
        (0x43, 9, None, 112, 200 * US),
        (0x4B, 8, None, 112, 3200 + 123 * 8 // 16),
        (0x46, None, None, 112, 200 * US),
        (0xCB, 10, None, 112, 200 * US),
        (0xC3, 6, None, 112, 3200 + 123 * 6 // 16),
        (0xCE, None, None, 112, 200 * US),
    ):
        await env.bench.edge("s", 0)
        await env.bench.clocks(20)
        before = env.bench.level("dir")
        event = await env.event(code, n, rate)
        await env.bench.until(event + 10)
        env.check("P104-DS-03", "IBF falls as in FAST, BUSY still 0", await env.host.status(), 0x00)
        nominal = env.cfg.us(busy)
        if nominal > 450:
            await env.bench.until(event + nominal - 16)
            env.check("P104-DS-03", "BUSY just before", await env.host.status(), 0x00)
        await env.bench.until(event + nominal + TOLERANCE)
        env.check("P104-DS-03", "BUSY just after", await env.host.status(), BUSY)
        pulse = await env.pulse(1)
        moved = [(t, v) for t, v in env.bench.edges("s", event) if t < pulse]
        full = [t for t, v in moved if v][-1] if moved else None
        falls = env.bench.falls("hold", event)
        dirs = [t for t, _ in env.bench.edges("dir", event)]
        places = {t for t in [*falls[:1], *dirs] if t is not None}
        if full and full - event >= nominal:
            places.add(full)
        what = f"hold, dir of {code:#x}"
        env.check("P104-DS-03", f"{what}: number of edges", len(places) <= 1, True)
        for t in places:
            env.after("P104-DS-03", what, t - event, busy * US)
        env.check("P104-DS-03", "dir edge there if dir turns", len(dirs), int(before != code >> 3 & 1))
        rule = "P104-DS-04" if code & 7 in (4, 5, 7) else "P104-DS-05"
        env.after(rule, f"pulse 1 of {code:#x}", pulse - event, first)
        await env.host.command(0x40)
        await env.rest()


@directed("P104-BCK-02", "P104-DS-03", builds=(D16,))
async def p104_ds_03_clock_of_the_c_event(dut):
    """If csel and vsel change between the last byte of an operation and BUSY, the previous levels apply
    (P104-DS-03).
    """
    env = await DatasheetEnv.start(dut, (0x0A, 9, 4, 4))
    for csel, vsel, interval in ((1, 1, 3200), (0, 1, 12_800), (1, 0, 3320)):
        env.bench.set(csel=csel, vsel=vsel)
        await env.bench.clocks(20)
        event = await env.event(0x4C, 3, 99)
        await env.bench.until(event + 50)
        env.check("P104-DS-03", "BUSY still 0", await env.host.status(), 0x00)
        env.bench.set(csel=1 - csel, vsel=1 - vsel)
        await env.host.poll(BUSY, BUSY)
        await env.idle()
        intervals = env.bench.intervals(env.since)
        env.check("P104-BCK-02", f"csel, vsel = {csel}, {vsel}", intervals[-2:], [interval] * 2)
        await env.rest()


@directed("P104-DS-05", builds=(D16,))
async def p104_ds_05_long_triangles(dut):
    """With PA = 300, the delay of pulse 1 increases with N only for D below 2·PA (P104-DS-05).

    The test uses D = 599, 600 and 300.
    """
    env = await DatasheetEnv.start(dut, (0x0A, 40, 9, 300))
    for n, first in ((600, 3200 + 123 * 600 // 16), (601, 3200), (301, 3200 + 123 * 301 // 16)):
        event = await env.event(0x43, n)
        env.after("P104-DS-05", f"pulse 1 of N = {n}", await env.pulse(1) - event, first)
        await env.host.command(0x40)
        await env.rest()


@directed("P104-DS-03", "P104-HSK-01", builds=(D16,))
async def p104_ds_03_closed_until_busy(dut):
    """If AUX ON waits for the start of an operation, the command is accepted when BUSY has risen; at that
    time the chopper is off (P104-DS-03).
    """
    env = await DatasheetEnv.start(dut, (0x2A, 9, 4, 4))
    for code, n, rate, busy in ((0x44, 3, 99, 27), (0x43, 9, None, 112)):
        await env.host.command(0xC2)
        await env.bench.clocks(300)
        event = await env.event(code, n, rate)
        await env.bench.until(event + 10)
        await env.opens("P104-DS-03", event, busy * US)
        env.check("P104-DS-03", "BUSY", await env.host.status() & BUSY, BUSY)
        env.check("P104-SW-03", "s has the full pattern", env.bench.level("s") != 0, True)
        await env.idle()
        await env.rest()


@directed("P104-DS-06", "P104-SW-02", builds=(D16, D25X8))
async def p104_ds_06_single_step(dut):
    """Command 0x42 outputs its pulse after 86 us. After 112 us, INT falls, chopping begins, and the mailbox
    opens (P104-DS-06).
    """
    env = await DatasheetEnv.start(dut, (0x2A, 9, 4, 4))
    event = await env.event(0x42)
    fall = await env.pulse(1)
    env.after("P104-DS-06", "pulse", fall - event, 86 * US)
    env.check("P104-TIM-05", "BUSY at the pulse", await env.host.status() & BUSY, BUSY)
    await env.opens("P104-DS-06", event, 112 * US)
    end = await env.wait_end()
    env.after("P104-DS-06", "INT", end - event, 112 * US)
    env.check("P104-TIM-05", "low time", env.bench.low_times(env.since), [env.cfg.w])
    off = await env.bench.edge("s", 0)
    env.full_on_phase("P104-SW-02", end, off)
    await env.result("P104-DS-06", 1, 0x82, 0)


@directed("P104-DS-07", "P104-END-01", "P104-SW-02", "P104-DS-09", builds=(D16, D11))
async def p104_ds_07_normal_end(dut):
    """After the last pulse of a complete move, INT falls after 26 us, and the mailbox opens after 156 us
    (P104-DS-07).
    """
    env = await DatasheetEnv.start(dut, (0x2A, 9, 4, 4))
    for code, n, rate in ((0x44, 3, 99), (0x43, 9, None), (0xC3, 12, None)):
        await env.host.command(0xC2)
        await env.rest()
        await env.event(code, n, rate)
        last = await env.pulse(n, 20)
        await env.opens("P104-DS-07", last, 156 * US)
        end = await env.wait_end()
        env.after("P104-DS-07", f"INT of {code:#x}", end - last, 26 * US)
        off = [t for t, v in env.bench.edges("s", end) if v == 0][0]
        env.full_on_phase("P104-SW-02", end, off)
        await env.result("P104-DS-07", n, 0x80 | code & 7, 0)
    rise = await env.bench.edge("hold", 1)
    env.window("P104-DS-09", "BUSY fall to hold", rise - end, env.cfg.us(34_000), env.cfg.us(34_100))


@directed("P104-DS-08", "P104-DS-14", "P104-END-02", builds=(D16, D11))
async def p104_ds_08_immediate_end(dut):
    """If command 0x40, ALM, or command 0x41 at constant speed ends the motion, INT falls 200 us later in
    operations 011 and 110, 26 us later in others. The mailbox opens 200 or 156 us after the cause
    (P104-DS-08).
    """
    env = await DatasheetEnv.start(dut, INIT_A)
    for code, n, rate, quiet, closed in (
        (0x44, 50, 99, 26, 156),
        (0x43, 50, None, 200, 200),
        (0xC6, None, None, 200, 200),
    ):
        for cause in ("40", "alm_n", "41")[: 3 if code == 0x44 else 2]:
            await env.host.command(0xC2)
            await env.rest()
            await env.event(code, n, rate)
            await env.pulse(3, 110)
            if cause != "alm_n":
                decided = await env.host.command(int(cause, 16), poll=False) + WRITE_EVENT
                await env.host.poll(IBF, 0)
                slack = 8
            else:
                decided = env.bench.set(alm_n=0)
                await env.bench.clocks(8)
                slack = 4
            await env.host.command(0xC1, poll=False)
            taken_after = decided + env.cfg.us(closed)
            await env.bench.until(taken_after - 8)
            env.check("P104-DS-08", "IBF while closed", await env.host.status() & IBF, IBF)
            await env.host.poll(IBF, 0, dense=100)
            late = env.bench.now - decided
            env.window(
                "P104-DS-08",
                f"C1 taken, {code:#x}, {cause}",
                late,
                env.cfg.us(closed),
                env.cfg.us(closed) + 48,
            )
            low = env.cfg.us(quiet)
            end = await env.wait_end() - decided
            env.window("P104-DS-08", f"INT of {code:#x}, {cause}", end, low, low + TOLERANCE + slack + PIN)
            env.bench.set(alm_n=1)
            await env.result(
                "P104-DS-14", 3, (0xA0 if cause == "alm_n" else 0xC0) | code & 7, (n or 1 << 24) - 4
            )


@directed("P104-DS-08", "P104-LIM-07", "P104-DS-03", builds=(D16,))
async def p104_ds_08_cause_at_start(dut):
    """If ALM is low at the start, BUSY rises at its documented time, and the operation ends 200 us later
    (011) or 26 us later (others) (P104-DS-08).
    """
    env = await DatasheetEnv.start(dut, INIT_A)
    env.bench.set(alm_n=0)
    for code, n, rate, busy, quiet in (
        (0x44, 5, 99, 27, 26),
        (0x43, 5, None, 112, 200),
        (0x42, None, None, 27, 26),
    ):
        event = await env.event(code, n, rate)
        end = await env.wait_end()
        nominal = env.cfg.us(busy) + env.cfg.us(quiet)
        env.window("P104-DS-08", f"INT of {code:#x}", end - event, nominal, nominal + 2 * TOLERANCE + PIN)
        await env.host.poll(IBF, 0)
        await env.bench.clocks(env.cfg.us(200))
        await env.result("P104-LIM-07", 0, 0xA0 | code & 7, (n or 1) - 1)
        await env.rest()
