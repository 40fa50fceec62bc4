"""Chopper at standstill, HOLD and the outputs register: STMC-CHP, STMC-HLD, STMC-OUT-02."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import F16, directed

from .env import Env
from .expected_timing import F12, INTERNAL, ODD, SHEET, T0

CHOP: tuple[int, int, int, int] = (0x2A, 20, 5, 8)


def xt(env: Env, name: str, default: int) -> int:
    """Return a time parameter of the build in crystal periods."""
    return int(dict(env.cfg.extra).get(name, default))


def check_chopping(env: Env, rule: str, since: int, pattern: int, off: int) -> None:
    """Check that each complete phase since an edge lasts CHOP_ON_XT or CHOP_OFF_XT, without drift.

    A phase is accurate to 4 crystal periods + 1 cycle.
    """
    slack = env.cfg.cyc(4) + 1
    on_xt, off_xt = xt(env, "CHOP_ON_XT", 1_040), xt(env, "CHOP_OFF_XT", 1_740)
    rows = env.stretches(since)
    env.check(rule, "several phases seen", len(rows) >= 4, True)
    env.check(rule, "levels", {level for level, _ in rows}, {pattern, off})
    for level, clk in rows:
        nominal = env.cfg.cyc(on_xt if level == pattern else off_xt)
        env.window(rule, f"cycles of s = {level:05b}", clk, nominal - slack, nominal + slack)
    begins = [t for t, level in env.bench.edges("s", since) if level == off]
    period = env.cfg.cyc(4 * -(-on_xt // 4) + 4 * -(-off_xt // 4))
    total = begins[-1] - begins[0]
    count = len(begins) - 1
    # `period` contains both times rounded up to whole quanta of 4 crystal periods, so the measured period may
    # be up to 8 cycles shorter.
    env.window(rule, f"{count} periods", total, (period - 8) * count - 1, period * count + 1)


@directed("STMC-CHP-01", builds=(F16, F12, ODD))
async def stmc_chp_01_phases(dut: Any) -> None:
    """With bit 5 of the initialisation code = 1, on-times and off-times repeat without drift at standstill,
    for each logic (STMC-CHP-01).
    """
    env = await Env.start(dut, None, clock=0)
    for code, pattern, off in ((0x2A, 0b00011, 0b00000), (0x22, 0b11100, 0b11111), (0x2F, 0b00011, 0)):
        await env.reset()
        await env.host.init(code, 20, 5, 8)
        await env.bench.edge("s", off, 60_000)
        since = env.bench.now
        await env.bench.clocks(env.cfg.cyc(20_000))
        check_chopping(env, "STMC-CHP-01", since, pattern, off)
        env.check("STMC-CHP-01", "hold", env.bench.edges("hold"), [])


@directed("STMC-CHP-01", "STMC-CHP-02", "STMC-HLD-02", builds=(F16, F12))
async def stmc_chp_02_motion(dut: Any) -> None:
    """A motion that starts in any phase of the chopper has the full pattern; after its end, a complete
    on-time follows (STMC-CHP-02).
    """
    env = await Env.start(dut, CHOP, clock=0)
    on, slack = env.cfg.cyc(1_040), env.cfg.cyc(4) + 1
    table = [0b00011, 0b00110, 0b01100, 0b01001]
    at = 0
    for wait in (100, 700, 1_300, 2_000, 2_700):
        await env.bench.clocks(wait)
        begin = env.bench.now
        edge0 = await env.go(0x42, poll=False)
        end = await env.wait_end()
        low = [t for t, _ in env.bench.edges("s", begin) if t <= edge0 + 14]
        for t in range(edge0 + 14, end, 7):
            env.check("STMC-CHP-02", "s while BUSY", env.bench.level_at("s", t) > 0, True)
        at += 1
        step = next(t for t, level in env.bench.edges("s", edge0) if level == table[at % 4])
        env.window("STMC-MOT-06", "step", step - edge0, env.cfg.cyc(T0), env.cfg.cyc(T0) + 14)
        env.check("STMC-CHP-02", "edges before BUSY", len(low) <= 2, True)
        off = await env.bench.edge("s", 0)
        env.window("STMC-CHP-01", "first on-time", off - end, on - slack, on + slack + 2)
        await env.finish()


@directed("STMC-CHP-02", "STMC-INI-04", "STMC-INI-07")
async def stmc_chp_02_initialisations(dut: Any) -> None:
    """If a further initialisation clears or sets bit 5, the chopping changes when its table build is complete
    (STMC-CHP-02).
    """
    env = await Env.start(dut, CHOP, clock=0)
    await env.bench.edge("s", 0)
    await env.host.init(0x0A, 20, 5, 8)
    since = env.bench.now
    await env.ready()
    complete = env.bench.now
    env.check("STMC-CHP-02", "chopped during the build", len(env.bench.edges("s", since)) >= 2, True)
    await env.bench.clocks(6_000)
    env.check("STMC-CHP-02", "full pattern", env.bench.edges("s", complete), [])
    env.check("STMC-CHP-02", "s", env.bench.level("s"), 0b00011)
    await env.host.init(*CHOP)
    since = env.bench.now
    await env.bench.clocks(300)
    env.check("STMC-CHP-02", "s during the build", env.bench.edges("s", since), [])
    await env.ready()
    off = await env.bench.edge("s", 0)
    env.window("STMC-CHP-01", "a full on-time after the build", off - since, 1_040, 1_040 + 6_000)
    # After a rejected initialisation, the old bit 5 stays active.
    await env.host.init(0x0A, 5, 20, 8)
    since = env.bench.now
    await env.bench.clocks(9_000)
    check_chopping(env, "STMC-CHP-01", since, 0b00011, 0)


@directed("STMC-CHP-01", "STMC-MOT-05", "STMC-HLD-01")
async def stmc_chp_01_motion_without_a_step(dut: Any) -> None:
    """If code 42 makes no step because l1_n is low, a complete on-time nevertheless begins at the end of the
    motion (STMC-CHP-01).
    """
    env = await Env.start(dut, CHOP, clock=0)
    await env.pins(l1_n=0)
    for wait in (0, 900, 1_700):
        await env.bench.clocks(wait)
        await env.go(0x42)
        end = await env.wait_end()
        off = await env.bench.edge("s", 0)
        env.window("STMC-CHP-01", "first on-time", off - end, 1_035, 1_047)
        await env.finish()
    env.check("STMC-HLD-01", "hold", env.bench.level("hold"), 0)


@directed("STMC-OUT-02", "STMC-OUT-01", builds=(SHEET,))
async def stmc_out_02_outputs_while_chopped(dut: Any) -> None:
    """While chopping, each read of the outputs returns the unchopped pattern, and HOLD as on its pin
    (STMC-OUT-02).
    """
    env = await Env.start(dut, CHOP, clock=0)
    for wait in (1, 300, 500, 700, 900, 1_100):
        await env.bench.clocks(wait)
        env.check("STMC-OUT-02", "outputs", await env.out(), 0xC4)
    await env.move(0x4A)
    env.check("STMC-OUT-01", "outputs before hold", await env.out(), 0x92)
    await env.bench.level_is("hold", 1)
    await env.bench.clocks(4)
    env.check("STMC-OUT-01", "outputs after hold", await env.out(), 0x96)


@directed("STMC-HLD-01", "STMC-HLD-02", builds=(SHEET, ODD))
async def stmc_hld_01_hold(dut: Any) -> None:
    """hold rises HOLD_XT crystal periods after the last end, also if motions are restarted or make no step
    (STMC-HLD-01).
    """
    env = await Env.start(dut, INTERNAL, clock=0)
    delay = env.cfg.cyc(xt(env, "HOLD_XT", 544_000))
    for code, n, rate in ((0x42, None, None), (0x44, 3, 1), (0x43, 1, None)):
        await env.go(code, n, rate)
        end = await env.wait_end()
        rise = await env.bench.edge("hold", 1)
        env.window("STMC-HLD-01", "hold", rise - end, delay, delay + 16)
        await env.finish()
    begin = env.bench.now
    for _ in range(4):
        await env.move(0x42)
        await env.finish()
        await env.bench.clocks(delay - 400)
        await env.init(0x0A, 9, 9, 0)
    env.check("STMC-HLD-02", "edges of hold", len(env.bench.edges("hold", begin)) % 2, 1)
    await env.pins(mon=0)
    await env.bench.level_is("hold", 1)
    await env.go(0x42)
    end = await env.wait_end()
    env.check("STMC-HLD-01", "falls without a step", env.bench.level("hold"), 0)
    rise = await env.bench.edge("hold", 1)
    env.window("STMC-HLD-01", "hold without a step", rise - end, delay, delay + 16)


@directed("STMC-HLD-01")
async def stmc_hld_01_default(dut: Any) -> None:
    """With the default, hold rises 34 ms after a step (STMC-HLD-01)."""
    env = await Env.start(dut, INTERNAL, clock=0)
    await env.go(0x42)
    end = await env.wait_end()
    rise = await env.bench.edge("hold", 1)
    env.window("STMC-HLD-01", "hold", rise - end, 544_000, 544_016)
