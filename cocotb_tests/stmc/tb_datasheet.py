"""DATASHEET timing: STMC-DS-01..14. Times have a tolerance of -0/+16 cycles, plus up to 2 cycles to a pin."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, D16, IBF, OBF, directed
from cocotb_tests.harness.config import D25X8

from .env import WRITE_EVENT, Env
from .expected_timing import INTERNAL, gaps, slowed

TOLERANCE = 16
PIN = 2
ALL_CLOCKS = (D16, D25X8)


def after(env: Env, rule: str, what: str, got: int, xt: int, pin: int = PIN) -> None:
    """Check that `got` cycles are CYC(xt), with a tolerance of -0/+16 cycles, plus the delay to the pin."""
    nominal = env.cfg.cyc(xt)
    env.window(rule, what, got, nominal, nominal + TOLERANCE + pin)


async def event(env: Env, code: int, n: int | None = None, rate: int | None = None) -> int:
    """Start a motion; return the write event of its last byte."""
    return await env.go(code, n, rate, poll=False) + WRITE_EVENT


async def check_accepted(env: Env, rule: str, since: int, xt: int, code: int = 0x80) -> None:
    """Write a command now; check that it is accepted CYC(xt) cycles after edge `since`, and not before."""
    nominal = since + env.cfg.cyc(xt)
    await env.host.write(1, code)
    await env.bench.until(max(env.bench.now, nominal - 20))
    while env.bench.now < nominal - 5:
        env.check(rule, "IBF while closed", await env.host.status() & IBF, IBF)
    await env.host.poll(IBF, 0, dense=1_000)
    env.window(rule, "taken", env.bench.now - since, nominal - since, nominal - since + TOLERANCE + 16)


async def rest(env: Env) -> None:
    """Wait for the end of the motion, clear its interrupt, and wait until all windows are closed."""
    await env.host.poll(BUSY | IBF, 0)
    await env.finish()


@directed("STMC-DS-01", "STMC-DS-04", "STMC-DS-05", "STMC-DS-06", builds=ALL_CLOCKS)
async def stmc_ds_01_starts(dut: Any) -> None:
    """For each motion command, start and step 0 occur at their documented times after the last byte
    (STMC-DS-01, STMC-DS-04).
    """
    env = await Env.start(dut, INTERNAL, clock=0)
    for code, n, rate, start, step in (
        (0x42, None, None, 432, 1_376),
        (0x43, 2, None, 1_792, 3_200),
        (0x44, 2, 10, 432, 3_104),
        (0x45, None, 10, 432, 3_104),
        (0x46, None, None, 1_792, 3_200),
        (0x4F, None, 10, 432, 3_104),
    ):
        await env.bench.level_is("hold", 1, env.cfg.cyc(560_000))
        t = await event(env, code, n, rate)
        while env.bench.now < t + env.cfg.cyc(start) - 8:
            env.check("STMC-DS-01", "BUSY", await env.host.status() & BUSY, 0)
        hold = await env.bench.edge("hold", 0)
        after(env, "STMC-DS-01", f"hold of {code:#x}", hold - t, start)
        env.check("STMC-DS-01", "BUSY", await env.host.status() & BUSY, BUSY)
        after(env, "STMC-DS-04", f"step 0 of {code:#x}", await env.pulse(1) - t, step)
        if n is None and code != 0x42:
            await env.command(0x40)
        await rest(env)


@directed("STMC-DS-02", "STMC-DS-03", "STMC-DS-14", "STMC-INI-04", "STMC-INI-08", builds=(D16,))
async def stmc_ds_02_initialisations(dut: Any) -> None:
    """Pattern and completion of an initialisation occur at their documented times after the 4th byte
    (STMC-DS-02, STMC-DS-03).
    """
    env = await Env.start(dut, None, clock=0)
    for first, (d1, d2, pa) in enumerate(((20, 5, 8), (20, 20, 0), (255, 1, 400))):
        for byte in (d1, d2, pa & 255):
            if byte == d1:
                await env.host.command(0x25 if first else 0x2A)
            await env.host.data(byte)
            if byte == d1 and d1 == d2:
                await env.host.data(d2)
                await env.host.data(0)
                break
        edge0 = await env.host.write(0, pa >> 8)
        t = edge0 + WRITE_EVENT
        if not first:
            after(env, "STMC-DS-02", "s", await env.bench.edge("s") - t, 704)
        total = 264_000 + 209 * pa
        await env.host.write(1, 0x80)
        nominal = t + env.cfg.cyc(total)
        await env.bench.until(nominal - 20)
        env.check("STMC-DS-14", "IBF", await env.host.status(), IBF)
        await env.bench.until(nominal - 4)
        await env.host.poll(IBF, 0, dense=100)
        env.window("STMC-DS-03", "complete", env.bench.now - t, env.cfg.cyc(total), env.cfg.cyc(total) + 32)
        env.check("STMC-DS-03", "FIN", await env.host.read_data(), 0x82 if first else 0x80)
        if not first:
            await env.move(0x42)
        env.check("STMC-INI-04", "pattern, as read", await env.out() & 0xF8, 0x60)


@directed("STMC-DS-06", "STMC-DS-13", builds=ALL_CLOCKS)
async def stmc_ds_06_single_step(dut: Any) -> None:
    """112 us after the byte of a single step, int_n falls and bytes are accepted again (STMC-DS-06)."""
    env = await Env.start(dut, INTERNAL, clock=0)
    t = await event(env, 0x42)
    await env.pulse(1)
    end = await env.wait_end()
    after(env, "STMC-DS-06", "int_n", end - t, 1_792, PIN + 4)
    await rest(env)
    t = await event(env, 0x4A)
    await env.pulse(1)
    await check_accepted(env, "STMC-DS-06", t + PIN + 3, 1_792)
    env.check("STMC-DS-13", "answer", await env.host.read_data(), 0x82)


@directed("STMC-DS-07", "STMC-DS-08", "STMC-DS-13", builds=(D16,))
async def stmc_ds_07_normal_ends(dut: Any) -> None:
    """After a normal end of commands 3, 4 and 7, or an end by CNP, int_n falls after 26 us, and bytes are
    accepted after 156 us (STMC-DS-07, STMC-DS-08).
    """
    env = await Env.start(dut, INTERNAL, clock=0)
    for code, n, rate in ((0x43, 3, None), (0x44, 2, 4), (0x47, None, 4)):
        await event(env, code, n, rate)
        last = await env.pulse(n or 2)
        if n is None:
            await env.bench.clocks(200)
            last = env.bench.now
            env.set(cnp_n=0)
        end = await env.wait_end()
        after(env, "STMC-DS-07", f"int_n of {code:#x}", end - last, 416, PIN + 3)
        env.check("STMC-DS-07", "BUSY", await env.host.status() & BUSY, 0)
        await check_accepted(env, "STMC-DS-08", last, 2_496)
        env.check("STMC-DS-13", "answer", await env.host.read_data(), 0x80 | code & 7)


@directed("STMC-DS-09", "STMC-DS-10", "STMC-DS-11", builds=ALL_CLOCKS)
async def stmc_ds_09_stops(dut: Any) -> None:
    """If a limit, mon or code 40 stops a motion, no step follows, and the end occurs at its documented time
    (STMC-DS-09, STMC-DS-10).
    """
    env = await Env.start(dut, INTERNAL, clock=0)
    for code, n, rate, stop, end_xt, open_xt in (
        (0x43, 100, None, "l1_n", 3_200, 3_200),
        (0x46, None, None, "mon", 3_200, 3_200),
        (0x44, 100, 5, "l1_n", 416, 2_496),
        (0x47, None, 5, "l3_n", 416, 2_496),
        (0x45, None, 5, "c 40", 416, 2_496),
        (0x46, None, None, "c 40", 3_200, 3_200),
    ):
        await event(env, code, n, rate)
        await env.in_gap(2, 500)
        t = env.bench.now
        if stop == "c 40":
            t = await env.host.write(1, 0x40) + WRITE_EVENT
        else:
            await env.blip(stop, 3)
        end = await env.wait_end()
        after(env, "STMC-DS-09", f"int_n of {code:#x} by {stop}", end - t, end_xt, PIN + 4)
        env.check("STMC-DS-11", "steps", len(env.pulses), 3)
        await check_accepted(env, "STMC-DS-10", t, open_xt)
        env.check("STMC-DS-13", "answer", await env.host.read_data() & 0x87, 0x80 | code & 7)


@directed("STMC-DS-09", "STMC-DS-11", builds=(D16,))
async def stmc_ds_09_ramp_down(dut: Any) -> None:
    """After a requested deceleration, the end occurs 0.2 ms after its last step (STMC-DS-09)."""
    env = await Env.start(dut, INTERNAL, clock=0)
    for i, how in ((3, "c 41"), (2, "l3_n"), (5, "c 41")):
        n = 12 if i == 5 else 100
        await event(env, 0x43, n)
        await env.in_gap(i)
        if how == "c 41":
            await env.command(0x41)
        else:
            await env.blip(how)
        ticks = slowed(n, i)
        last = await env.pulse(len(ticks) + 1)
        end = await env.wait_end()
        env.train("STMC-DS-11", ticks)
        after(env, "STMC-DS-09", "int_n", end - last, 3_200 if len(ticks) + 1 < n else 416)
        await rest(env)


@directed("STMC-DS-12", "STMC-DS-14", "STMC-MOT-05", builds=(D16,))
async def stmc_ds_12_causes_at_the_start(dut: Any) -> None:
    """If a cause is active at the start, or a stop waits for the start, no step is made (STMC-DS-12)."""
    env = await Env.start(dut, INTERNAL, clock=0)
    await env.pins(l1_n=0)
    for code, n, rate, start, end_xt in (
        (0x43, 9, None, 1_792, 3_200),
        (0x44, 9, 5, 432, 416),
        (0x42, None, None, 432, 416),
    ):
        t = await event(env, code, n, rate)
        end = await env.wait_end()
        after(env, "STMC-DS-12", f"int_n of {code:#x}", end - t, start + end_xt, PIN + 8)
        env.check("STMC-DS-12", "steps", env.pulses, [])
        await rest(env)
    await env.pins(l1_n=1)
    t = await event(env, 0x43, 9)
    await check_accepted(env, "STMC-DS-14", t, 1_792, 0x40)
    await env.wait_end()
    await env.result("STMC-DS-14", 0, 0xC3, 8)


@directed("STMC-DS-13", "STMC-BUS-14", builds=(D16,))
async def stmc_ds_13_a_newer_byte(dut: Any) -> None:
    """If a byte waits after the last step of a motion and a newer byte replaces it, only the newer byte is
    processed (STMC-DS-13).
    """
    env = await Env.start(dut, INTERNAL, clock=0)
    await event(env, 0x44, 2, 3)
    last = await env.pulse(2)
    await env.host.write(1, 0x42)
    await env.bench.clocks(300)
    await env.host.write(1, 0x80)
    await env.bench.until(last + 2_600)
    env.check("STMC-DS-13", "status", await env.host.status(), OBF)
    env.check("STMC-DS-13", "FIN", await env.host.read_data(), 0x84)


@directed("STMC-DS-04", "STMC-DS-11", "STMC-DS-12", builds=(D16,))
async def stmc_ds_04_external_clock(dut: Any) -> None:
    """With the external clock, step 0 occurs on the first tick after its documented time (STMC-DS-04)."""
    env = await Env.start(dut)
    for code, n, rate, xt in ((0x43, 12, None, 3_200), (0x44, 5, 3, 3_104)):
        t = await event(env, code, n, rate)
        first = await env.pulse(1)
        env.window("STMC-DS-04", "step 0", first - t, xt, xt + TOLERANCE + PIN + 16)
        await env.outcome("STMC-DS-12", n, 0x80 | code & 7, 0, gaps(n) if rate is None else [3] * 4)
