"""Polled switches and rate limits, TIMING = "DATASHEET" (P2104-DS-20…36, AC-67 to AC-70, AC-75, AC-76)."""

from __future__ import annotations

from itertools import repeat
from typing import Any

from cocotb_tests.harness import D11, D16, F16, IBF, directed
from cocotb_tests.harness.axis_driver import NO_PULSES_DONE

from .datasheet_timing import last_byte, opens, rest
from .env import Axis, Env
from .expected_timing import INIT_B

# (kind of operation, csel) -> minimum accepted rate while the other axis is idle, and while it operates
# (P2104-DS-30).
LIMITS = {
    ("pout", 1): (0x0C, 0x19),
    ("phase", 1): (0x12, 0x23),
    ("org", 1): (0x14, 0x25),
    ("pout", 0): (0x03, 0x06),
    ("phase", 0): (0x04, 0x08),
    ("org", 0): (0x05, 0x09),
}


def rate_error(kind: str, csel: int, rate: int, operating: bool) -> int:
    """Return the rate error (12 or 13) that P2104-DS-30 requires, or 0."""
    single, double = LIMITS[kind, csel]
    return 12 if rate < single else 13 if operating and rate < double else 0


async def tried(env: Env, axis: Axis, code: int, error: int, rate: int | None = None, note: str = "") -> None:
    """Start an operation; check that it sets the error `error` and not BUSY, or that it runs if `error` is
    0.
    """
    data = [] if rate is None else [rate]
    data += [99, 0, 0] if code & 7 in (3, 4) else []
    await last_byte(axis, code, *data)
    await env.host.poll(IBF, 0)
    busy = await env.host.status() & axis.busy
    what = f"{code:#x}, rate {rate}{note}"
    env.check("P2104-DS-30", f"BUSY of {what}", busy, 0 if error else axis.busy)
    if busy:
        await axis.command(0x40)
        await axis.idle()
        await axis.finish()
    env.check("P2104-DS-30", f"error of {what}", await axis.error(), error)


@directed("AC-67", "P2104-DS-30", "P2104-DS-35", "P2104-ERR-05", builds=(D16, D11))
async def p2104_ac_67_rate_bytes(dut: Any) -> None:
    """If axis 2 has no setting, rates below the limits set error 12 (AC-67)."""
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    for csel in (1, 0):
        axis.set(csel=csel)
        await env.bench.clocks(4)
        for code, kind in ((0x44, "phase"), (0x4D, "phase"), (0x47, "org")):
            limit = LIMITS[kind, csel][0]
            for rate in (limit - 1, limit):
                error = rate_error(kind, csel, rate, False)
                env.check("AC-67", "figures", error, 12 if rate < limit else 0)
                await tried(env, axis, code, error, rate, f", csel {csel}")
    # Order of the checks: rate 00 is error 9; a rate error has priority over an active input.
    axis.set(alm_n=0)
    await env.bench.clocks(4)
    for rate, error in ((0x00, 9), (0x03, 12), (0x04, 7)):
        await tried(env, axis, 0x44, error, rate, " on ALM")


@directed("AC-68", "AC-69", "P2104-DS-30", "P2104-DS-31", "P2104-DS-32", "P2104-DS-33", builds=(D16,))
async def p2104_ac_68_ramps_and_two_axes(dut: Any) -> None:
    """For RH and rates near the limits, errors are 12, 13 or 0, depending on whether axis 2 is idle or
    operating (AC-68, AC-69).
    """
    env = await Env.start(dut)
    axis, other = env.axes
    for rh, level, cases in (
        (0x0B, 1, ((0xC3, 12), (0xC6, 12))),
        (0x0C, 1, ((0xC3, 0), (0xC6, 0), (0x43, 12))),
        (0x11, 1, ((0x43, 12), (0x46, 12), (0xC3, 0))),
        (0x02, 0, ((0xC3, 12),)),
        (0x03, 0, ((0xC3, 0), (0x43, 12))),
    ):
        axis.set(csel=level)
        # The setting itself is never rejected because of its rate.
        await axis.init(0x02, 0x63, rh, 10)
        env.check("P2104-DS-33", f"error of the setting, RH {rh:#x}", await axis.error(), 0)
        for code, error in cases:
            await tried(env, axis, code, error, note=f", RH {rh:#x}, csel {level}")
    await other.init(*INIT_B)
    other.set(run=0)
    await other.go(0x42)
    await env.host.poll(IBF, 0)
    for level, cases in (
        (1, ((0x44, 0x22, 13), (0x44, 0x23, 0), (0x47, 0x24, 13), (0x47, 0x25, 0), (0x44, 0x11, 12))),
        (0, ((0x44, 0x07, 13), (0x44, 0x08, 0), (0x47, 0x08, 13), (0x47, 0x09, 0), (0x45, 0x03, 12))),
    ):
        axis.set(csel=level)
        await env.bench.clocks(4)
        for code, rate, error in cases:
            kind = "org" if code == 0x47 else "phase"
            env.check("AC-69", "figures", rate_error(kind, level, rate, True), error)
            await tried(env, axis, code, error, rate, f", csel {level}, axis 2 in RUN wait")
        await tried(env, axis, 0x42, 0, note=": single steps have no rate")
    for rh, level, error in ((0x18, 1, 13), (0x19, 1, 0), (0x05, 0, 13), (0x06, 0, 0)):
        axis.set(csel=level)
        await axis.init(0x02, 0x63, rh, 10)
        await tried(env, axis, 0xC3, error, note=f", RH {rh:#x}, csel {level}, axis 2 in RUN wait")
        await tried(env, axis, 0x43, 13, note=f", RH {rh:#x}, csel {level}, axis 2 in RUN wait")
    # If the other axis is fast, a slow operation is accepted, and the fast motion continues.
    await other.command(0x40)
    await rest(env)
    other.set(run=1)
    await axis.go(0x44, 2_000, 0x04)
    await env.host.poll(IBF, 0)
    await other.go(0x44, 5, 0x30)
    await env.host.poll(IBF, 0)
    env.check("P2104-DS-32", "both BUSY", await env.host.status() & 0x8C, 0x0C)
    await other.idle()
    other.check_train("P2104-DS-32", [0x30] * 4)
    await axis.command(0x40)
    await axis.idle()
    axis.check_train("P2104-DS-32", [0x04] * (len(axis.pulses) - 1), 0)


@directed("AC-70", "P2104-DS-31", "P2104-DS-33", "P2104-DS-36", builds=(D16,))
async def p2104_ac_70_switching_counts(dut: Any) -> None:
    """If axis 2 is at standstill with S = 1, axis 1 has the rate limit for two operating axes (AC-70)."""
    env = await Env.start(dut)
    axis, other = await env.ready(1, INIT_B), env.x2
    await other.init(0x12, *INIT_B[1:])
    await tried(env, axis, 0x44, 13, 0x22, ", axis 2 switching")
    await tried(env, axis, 0x44, 0, 0x23, ", axis 2 switching")
    await other.command(0xC0)
    await tried(env, axis, 0x44, 0, 0x22, ", axis 2 off")
    await axis.command(0xC0)
    await axis.init(0x0A, *INIT_B[1:])
    clock = env.bench.external_clock(repeat(20), axis.clock, high=10)
    await tried(env, axis, 0x45, 0, 0x00, ", external clock")
    # This rate is higher than the old chip could output; the core outputs it nevertheless.
    await axis.go(0x44, 50, 0)
    await axis.result("P2104-DS-36", 50, 0x84, 0)
    clock.cancel()


@directed("AC-70", "P2104-DS-34", "P2104-INTV-01", builds=(F16,))
async def p2104_ac_70_no_limits_in_fast(dut: Any) -> None:
    """In FAST, rate 01 works on both axes, one of which has S = 1 (AC-70)."""
    env = await Env.start(dut)
    axis, other = env.axes
    await axis.init(*INIT_B)
    await other.init(0x12, *INIT_B[1:])
    await other.running(1)
    await axis.move(0x44, 20, 1)
    axis.check_train("P2104-DS-34", [1] * 19)
    await axis.result("P2104-DS-34", 20, 0x84, 0)
    await other.halt()
    env.check("P2104-DS-34", "errors", await env.errors(), (0, 0))


@directed("AC-75", "P2104-DS-20", "P2104-DS-23", "P2104-LIM-01", builds=(D16, D11))
async def p2104_ac_75_polled_limits(dut: Any) -> None:
    """Limit levels of 10 us, at 7 offsets, are in some cases missed by the polling; levels of 36 us are never
    missed (AC-75).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    us = env.cfg.us
    ended = []
    for offset in range(7):
        edge0 = await last_byte(axis, 0x45, 0xFF)
        await env.bench.until(edge0 + us(200 + 5 * offset))
        await axis.blip("fl_n", us(10))
        await env.bench.clocks(40)
        ended.append((await env.host.status() & axis.busy) == 0)
        if not ended[-1]:
            await axis.command(0x40)
        await axis.idle()
        env.check("AC-75", "end status", await axis.finish(), 0x95 if ended[-1] else 0xC5)
    env.check("AC-75", "missed, seen", (ended.count(False) >= 4, ended.count(True) >= 1), (True, True))
    for offset in (0, 7, 19, 33):
        for pin, finish in (("fl_n", 0x95), ("alm_n", 0xA5)):
            edge0 = await last_byte(axis, 0x45, 0xFF)
            await env.bench.until(edge0 + us(200 + offset))
            stamp = await axis.blip(pin, us(36))
            end = await axis.wait_end()
            env.window("AC-75", "pin to the end", end - stamp, 2, us(35) + 8)
            env.check("AC-75", "end status", await axis.finish(), finish)
            await env.bench.clocks(us(50))
    # While a window is open, no input is sampled; the limit is detected at most 35 us after the end of the
    # window.
    await axis.go(0x45, rate=0xFF)
    await axis.pulse(1, 300)
    edge0 = await env.host.command(0xC1, poll=False)
    stamp = axis.set(fl_n=0)
    end = await axis.wait_end()
    env.window("P2104-DS-20", "pin to the end, 40 us window", end - stamp, us(40 + 35) - 20, us(40 + 35) + 30)
    axis.set(fl_n=1)
    # The slow-down limit is polled, too: during code 43 it sets the deceleration flag at a polling tick.
    await rest(env)
    await axis.go(0x43, 1000)
    await axis.pulse(30, 100)
    await axis.blip("fhl_n", us(36))
    await axis.idle()
    env.window("P2104-DS-20", "pulses", len(axis.pulses), 41, 42)
    env.check("P2104-DS-20", "end status", await axis.finish(), 0x8B)


@directed("AC-76", "P2104-DS-21", "P2104-LIM-07", builds=(D16,))
async def p2104_ac_76_origin_at_pulses(dut: Any) -> None:
    """In an origin search, ORG has no effect if it is low only between two falls of pout_n; if ORG is low at
    a fall, the search ends (AC-76).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_B)
    await axis.go(0x47, rate=0x31)
    await axis.pulse(5, 200)
    await axis.blip("org_n", 1_000)
    await axis.pulse(8, 1_500)
    await axis.blip("org_n", 200)
    await axis.result("AC-76", 9, 0x87)
    env.check("AC-76", "83", await axis.fetch(0x83, 3), [0xF6, 0xFF, 0xFF])
    # The fall of pulse 1 also samples ORG. In RUN wait, ORG is not sampled.
    axis.set(run=0)
    await axis.go(0x47, rate=0x31)
    await env.bench.clocks(env.cfg.us(40))
    axis.set(org_n=0)
    await env.bench.clocks(1_000)
    env.check("P2104-DS-21", "BUSY in RUN wait", await env.host.status() & axis.busy, axis.busy)
    axis.set(run=1)
    await axis.result("P2104-DS-21", 1, 0x87, NO_PULSES_DONE - 2)
    axis.set(org_n=1)


@directed("P2104-DS-01", "P2104-DS-14", "P2104-HSK-04", "P2104-STP-07", builds=(D16,))
async def p2104_ds_01_window_for_both_axes(dut: Any) -> None:
    """While axis 1 processes its setting, bytes for the moving axis 2 also wait, including a stop
    (P2104-DS-01).
    """
    env = await Env.start(dut)
    axis, other = env.axes
    await other.init(*INIT_B)
    await other.go(0x45, rate=0xFF)
    edge0 = await last_byte(axis, 0x02, 9, 4, 4, 0)
    await env.bench.clocks(100)
    await env.host.command(0x60, poll=False)
    await env.bench.until(edge0 + env.cfg.us(71_000) - 40)
    env.check("P2104-DS-01", "status", await env.host.status() & 0x3E, IBF | axis.cmnd | other.busy)
    pulses = len(other.pulses)
    end = await other.wait_end()
    env.window("P2104-DS-02", "the stop's end", end - edge0, env.cfg.us(71_400), env.cfg.us(71_400) + 60)
    env.window("P2104-STP-07", "pulses after the window", len(other.pulses) - pulses, 0, 1)
    env.check("P2104-DS-01", "rates", set(other.intervals), {8_192})
    await rest(env)
    edge0 = await last_byte(other, 0x42)
    await opens(env, "P2104-DS-04", edge0, 103)
