"""DATASHEET timing: STMC-DS-01..14. Times are -0/+16 cycles, plus up to 2 cycles to a pin."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, D16, IBF, OBF, directed
from cocotb_tests.harness.config import D25X8

from .env import WRITE_EVENT, Lab
from .expected_timing import INTERNAL, gaps, slowed

TOLERANCE = 16
PIN = 2
ALL_CLOCKS = (D16, D25X8)


def after(lab: Lab, rule: str, what: str, got: int, xt: int, pin: int = PIN) -> None:
    """Check that `got` cycles are CYC(xt), -0/+16, plus the delay to the pin."""
    nominal = lab.cfg.cyc(xt)
    lab.window(rule, what, got, nominal, nominal + TOLERANCE + pin)


async def event(lab: Lab, code: int, n: int | None = None, rate: int | None = None) -> int:
    """Start a motion; return the write event of its last byte."""
    return await lab.go(code, n, rate, poll=False) + WRITE_EVENT


async def taken(lab: Lab, rule: str, since: int, xt: int, code: int = 0x80) -> None:
    """Check that a command written now is accepted CYC(xt) cycles after `since`, not before."""
    nominal = since + lab.cfg.cyc(xt)
    await lab.host.write(1, code)
    await lab.bench.until(max(lab.bench.now, nominal - 20))
    while lab.bench.now < nominal - 5:
        lab.check(rule, "IBF while closed", await lab.host.status() & IBF, IBF)
    await lab.host.poll(IBF, 0, dense=1_000)
    lab.window(rule, "taken", lab.bench.now - since, nominal - since, nominal - since + TOLERANCE + 16)


async def rest(lab: Lab) -> None:
    """Wait for the end of the motion, read its interrupt, and wait until all windows are closed."""
    await lab.host.poll(BUSY | IBF, 0)
    await lab.finish()


@directed("STMC-DS-01", "STMC-DS-04", "STMC-DS-05", "STMC-DS-06", builds=ALL_CLOCKS)
async def stmc_ds_01_starts(dut: Any) -> None:
    """For each motion command, start and step 0 occur at their times after the last byte (STMC-DS-01,
    STMC-DS-04).
    """
    lab = await Lab.start(dut, INTERNAL, clock=0)
    for code, n, rate, start, step in (
        (0x42, None, None, 432, 1_376),
        (0x43, 2, None, 1_792, 3_200),
        (0x44, 2, 10, 432, 3_104),
        (0x45, None, 10, 432, 3_104),
        (0x46, None, None, 1_792, 3_200),
        (0x4F, None, 10, 432, 3_104),
    ):
        await lab.bench.level_is("hold", 1, lab.cfg.cyc(560_000))
        t = await event(lab, code, n, rate)
        while lab.bench.now < t + lab.cfg.cyc(start) - 8:
            lab.check("STMC-DS-01", "BUSY", await lab.host.status() & BUSY, 0)
        hold = await lab.bench.edge("hold", 0)
        after(lab, "STMC-DS-01", f"hold of {code:#x}", hold - t, start)
        lab.check("STMC-DS-01", "BUSY", await lab.host.status() & BUSY, BUSY)
        after(lab, "STMC-DS-04", f"step 0 of {code:#x}", await lab.pulse(1) - t, step)
        if n is None and code != 0x42:
            await lab.command(0x40)
        await rest(lab)


@directed("STMC-DS-02", "STMC-DS-03", "STMC-DS-14", "STMC-INI-04", "STMC-INI-08", builds=(D16,))
async def stmc_ds_02_initialisations(dut: Any) -> None:
    """Pattern and completion of an initialisation occur at their times after the 4th byte (STMC-DS-02,
    STMC-DS-03).
    """
    lab = await Lab.start(dut, None, clock=0)
    for first, (d1, d2, pa) in enumerate(((20, 5, 8), (20, 20, 0), (255, 1, 400))):
        for byte in (d1, d2, pa & 255):
            if byte == d1:
                await lab.host.command(0x25 if first else 0x2A)
            await lab.host.data(byte)
            if byte == d1 and d1 == d2:
                await lab.host.data(d2)
                await lab.host.data(0)
                break
        edge0 = await lab.host.write(0, pa >> 8)
        t = edge0 + WRITE_EVENT
        if not first:
            after(lab, "STMC-DS-02", "s", await lab.bench.edge("s") - t, 704)
        total = 264_000 + 209 * pa
        await lab.host.write(1, 0x80)
        nominal = t + lab.cfg.cyc(total)
        await lab.bench.until(nominal - 20)
        lab.check("STMC-DS-14", "IBF", await lab.host.status(), IBF)
        await lab.bench.until(nominal - 4)
        await lab.host.poll(IBF, 0, dense=100)
        lab.window("STMC-DS-03", "complete", lab.bench.now - t, lab.cfg.cyc(total), lab.cfg.cyc(total) + 32)
        lab.check("STMC-DS-03", "FIN", await lab.host.read_data(), 0x82 if first else 0x80)
        if not first:
            await lab.move(0x42)
        lab.check("STMC-INI-04", "pattern, as read", await lab.out() & 0xF8, 0x60)


@directed("STMC-DS-06", "STMC-DS-13", builds=ALL_CLOCKS)
async def stmc_ds_06_single_step(dut: Any) -> None:
    """int_n falls, and bytes are accepted again, 112 us after the byte of a single step (STMC-DS-06)."""
    lab = await Lab.start(dut, INTERNAL, clock=0)
    t = await event(lab, 0x42)
    await lab.pulse(1)
    end = await lab.ended()
    after(lab, "STMC-DS-06", "int_n", end - t, 1_792, PIN + 4)
    await rest(lab)
    t = await event(lab, 0x4A)
    await lab.pulse(1)
    await taken(lab, "STMC-DS-06", t + PIN + 3, 1_792)
    lab.check("STMC-DS-13", "answer", await lab.host.read_data(), 0x82)


@directed("STMC-DS-07", "STMC-DS-08", "STMC-DS-13", builds=(D16,))
async def stmc_ds_07_normal_ends(dut: Any) -> None:
    """After a normal end, or one by CNP, of commands 3, 4 and 7, int_n falls after 26 us, and bytes are
    accepted after 156 us (STMC-DS-07, STMC-DS-08).
    """
    lab = await Lab.start(dut, INTERNAL, clock=0)
    for code, n, rate in ((0x43, 3, None), (0x44, 2, 4), (0x47, None, 4)):
        await event(lab, code, n, rate)
        last = await lab.pulse(n or 2)
        if n is None:
            await lab.bench.clocks(200)
            last = lab.bench.now
            lab.set(cnp_n=0)
        end = await lab.ended()
        after(lab, "STMC-DS-07", f"int_n of {code:#x}", end - last, 416, PIN + 3)
        lab.check("STMC-DS-07", "BUSY", await lab.host.status() & BUSY, 0)
        await taken(lab, "STMC-DS-08", last, 2_496)
        lab.check("STMC-DS-13", "answer", await lab.host.read_data(), 0x80 | code & 7)


@directed("STMC-DS-09", "STMC-DS-10", "STMC-DS-11", builds=ALL_CLOCKS)
async def stmc_ds_09_stops(dut: Any) -> None:
    """When a limit, mon or 40 stops a motion, no step follows, and the end occurs at its time
    (STMC-DS-09, STMC-DS-10).
    """
    lab = await Lab.start(dut, INTERNAL, clock=0)
    for code, n, rate, stop, end_xt, open_xt in (
        (0x43, 100, None, "l1_n", 3_200, 3_200),
        (0x46, None, None, "mon", 3_200, 3_200),
        (0x44, 100, 5, "l1_n", 416, 2_496),
        (0x47, None, 5, "l3_n", 416, 2_496),
        (0x45, None, 5, "c 40", 416, 2_496),
        (0x46, None, None, "c 40", 3_200, 3_200),
    ):
        await event(lab, code, n, rate)
        await lab.in_gap(2, 500)
        t = lab.bench.now
        if stop == "c 40":
            t = await lab.host.write(1, 0x40) + WRITE_EVENT
        else:
            await lab.blip(stop, 3)
        end = await lab.ended()
        after(lab, "STMC-DS-09", f"int_n of {code:#x} by {stop}", end - t, end_xt, PIN + 4)
        lab.check("STMC-DS-11", "steps", len(lab.pulses), 3)
        await taken(lab, "STMC-DS-10", t, open_xt)
        lab.check("STMC-DS-13", "answer", await lab.host.read_data() & 0x87, 0x80 | code & 7)


@directed("STMC-DS-09", "STMC-DS-11", builds=(D16,))
async def stmc_ds_09_ramp_down(dut: Any) -> None:
    """After a requested deceleration, the end follows its last step by 0.2 ms (STMC-DS-09)."""
    lab = await Lab.start(dut, INTERNAL, clock=0)
    for i, how in ((3, "c 41"), (2, "l3_n"), (5, "c 41")):
        n = 12 if i == 5 else 100
        await event(lab, 0x43, n)
        await lab.in_gap(i)
        if how == "c 41":
            await lab.command(0x41)
        else:
            await lab.blip(how)
        ticks = slowed(n, i)
        last = await lab.pulse(len(ticks) + 1)
        end = await lab.ended()
        lab.train("STMC-DS-11", ticks)
        after(lab, "STMC-DS-09", "int_n", end - last, 3_200 if len(ticks) + 1 < n else 416)
        await rest(lab)


@directed("STMC-DS-12", "STMC-DS-14", "STMC-MOT-05", builds=(D16,))
async def stmc_ds_12_causes_at_the_start(dut: Any) -> None:
    """A cause at the start, or a stop that waits for the start, prevents all steps (STMC-DS-12)."""
    lab = await Lab.start(dut, INTERNAL, clock=0)
    await lab.pins(l1_n=0)
    for code, n, rate, start, end_xt in (
        (0x43, 9, None, 1_792, 3_200),
        (0x44, 9, 5, 432, 416),
        (0x42, None, None, 432, 416),
    ):
        t = await event(lab, code, n, rate)
        end = await lab.ended()
        after(lab, "STMC-DS-12", f"int_n of {code:#x}", end - t, start + end_xt, PIN + 8)
        lab.check("STMC-DS-12", "steps", lab.pulses, [])
        await rest(lab)
    await lab.pins(l1_n=1)
    t = await event(lab, 0x43, 9)
    await taken(lab, "STMC-DS-14", t, 1_792, 0x40)
    await lab.ended()
    await lab.result("STMC-DS-14", 0, 0xC3, 8)


@directed("STMC-DS-13", "STMC-BUS-14", builds=(D16,))
async def stmc_ds_13_a_newer_byte(dut: Any) -> None:
    """If a newer byte replaces a byte that waits for the end, only the newer one is checked
    (STMC-DS-13).
    """
    lab = await Lab.start(dut, INTERNAL, clock=0)
    await event(lab, 0x44, 2, 3)
    last = await lab.pulse(2)
    await lab.host.write(1, 0x42)
    await lab.bench.clocks(300)
    await lab.host.write(1, 0x80)
    await lab.bench.until(last + 2_600)
    lab.check("STMC-DS-13", "status", await lab.host.status(), OBF)
    lab.check("STMC-DS-13", "FIN", await lab.host.read_data(), 0x84)


@directed("STMC-DS-04", "STMC-DS-11", "STMC-DS-12", builds=(D16,))
async def stmc_ds_04_external_clock(dut: Any) -> None:
    """With the external clock, step 0 is on the first tick after its time (STMC-DS-04)."""
    lab = await Lab.start(dut)
    for code, n, rate, xt in ((0x43, 12, None, 3_200), (0x44, 5, 3, 3_104)):
        t = await event(lab, code, n, rate)
        first = await lab.pulse(1)
        lab.window("STMC-DS-04", "step 0", first - t, xt, xt + TOLERANCE + PIN + 16)
        await lab.outcome("STMC-DS-12", n, 0x80 | code & 7, 0, gaps(n) if rate is None else [3] * 4)
