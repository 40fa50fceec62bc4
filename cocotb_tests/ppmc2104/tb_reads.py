"""The read instructions and the interrupts (P2104-RD, P2104-INT).

W is the pulse and set-up time of 5 us in cycles.
"""

from __future__ import annotations

from itertools import product
from typing import Any

from cocotb_tests.harness import F11, F16, F48, F100, IBF, directed

from .env import Env
from .expected_timing import INIT_A, INIT_B, STEP_CODES

CODES = ((0x42, 2), (0x43, 3), (0x44, 4), (0x45, 5), (0x46, 6), (0x47, 7), (0xC3, 3), (0xC6, 6))


@directed("P2104-RD-01", "P2104-RD-02", "P2104-RD-03", "P2104-END-04", "P2104-END-05")
async def p2104_rd_01_end_status(dut: Any) -> None:
    """After each operation and each cause of its end, the first code 80 returns the bits of the operation and
    of the cause, and bit 7 = 1; the second code 80 returns the same bits, but bit 7 = 0 (P2104-RD-01).
    """
    env = await Env.start(dut)
    for axis, (code, low) in product(await env.both(INIT_A), CODES):
        for cause, bits in (("", 0x00), ("40", 0x40), ("fl_n", 0x10), ("alm_n", 0x20), ("fhl_n", 0x08)):
            if (
                (cause == "fhl_n" and low not in (3, 6))
                or (not cause and low in (5, 6, 7))
                or (cause and low == 2)
            ):
                continue
            n = (12 if not cause else 1000) if low in (3, 4) else None
            await axis.go(code, n, 20 if low in (4, 5, 7) else None)
            if cause:
                await axis.pulse(3, 20)
                if cause == "40":
                    await axis.command(0x40)
                else:
                    axis.set(**{cause: 0})
            await axis.idle()
            if cause.endswith("_n"):
                axis.set(**{cause: 1})
            got = [await axis.finish() for _ in range(3)]
            env.check("P2104-RD-01", f"{code:#x}, {cause}", got, [0x80 | bits | low, bits | low, bits | low])


@directed("P2104-RD-04", "P2104-RD-08", "P2104-LIM-10")
async def p2104_rd_04_all_levels(dut: Any) -> None:
    """For all levels of the twelve switches, a read returns the switches of its axis (P2104-RD-04)."""
    env = await Env.start(dut)
    order = ("org_n", "alm_n", "fl_n", "fhl_n", "bl_n", "bhl_n")
    places = (7, 6, 3, 2, 1, 0)
    for value in range(64):
        levels = [value >> i & 1 for i in range(6)]
        for axis, own in ((env.x1, levels), (env.x2, [1 - v for v in levels])):
            axis.set(**dict(zip(order, own, strict=True)))
        await env.bench.clocks(4)
        for axis, own in ((env.x1, levels), (env.x2, [1 - v for v in levels])):
            expected = sum(level << place for level, place in zip(own, places, strict=True))
            env.check("P2104-RD-04", f"{value:06b}, axis {axis.n}", await axis.fetch(0x81), [expected])


@directed("P2104-RD-05", "P2104-SW-05", "P2104-PHS-01")
async def p2104_rd_05_output_signal(dut: Any) -> None:
    """Code 82 returns the levels of the phases, direction and hold, with S1 in bit 7 (P2104-RD-05)."""
    env = await Env.start(dut)
    for axis in env.axes:
        for code in STEP_CODES.values():
            await axis.init(code, *INIT_A[1:])
            await axis.send(0x85, [0])
            for op in (0x42, 0x4A, 0x42, 0x42, 0x42, 0x4A, 0xCB, 0xC3):
                await axis.move(op, 2 if op & 1 else None)
                for settled in (False, True):
                    if settled:
                        await env.bench.level_is(axis.pin("hold"), 1)
                    pins = axis.phases_now
                    expected = sum((pins >> i & 1) << 7 - i for i in range(5))
                    expected |= settled << 2 | (op >> 3 & 1) << 1
                    env.check(
                        "P2104-RD-05", f"82 after {op:#x}, hold {settled}", await axis.fetch(0x82), [expected]
                    )
            await axis.command(0xC0)
            await axis.finish()
    env.check("P2104-RD-05", "axis 1 at the end", await env.x1.fetch(0x82), [0xFC])


@directed("P2104-RD-06", "P2104-END-06", "P2104-RD-08", "P2104-OPR-10")
async def p2104_rd_06_remaining_pulses(dut: Any) -> None:
    """Code 83 for a stopped move, read while the other axis moves, returns max(m - 1, 0), where m is the
    number of pulses not output; another move with this value completes the count (P2104-RD-06).
    """
    env = await Env.start(dut)
    axis, other = await env.both(INIT_A)
    await other.running(200)
    for n, stop_at, left in (
        (10, 3, 6),
        (10, 9, 0),
        (10, 10, 0),
        (0x010000, 4, 0xFFFB),
        (0x1000000, 2, 0xFFFFFD),
    ):
        await axis.go(0x44, n, 9)
        await axis.pulse(stop_at, 100)
        await axis.command(0x40)
        await axis.idle()
        finish = 0x84 if stop_at == n else 0xC4
        env.check("P2104-RD-06", f"83, {stop_at} of {n}", await axis.remaining(), left)
        env.check("P2104-RD-06", "once more", await axis.remaining(), left)
        env.check("P2104-END-06", "0 left, or 1", await axis.finish(), finish)
        if left < 100 and stop_at != n:
            await axis.move(0x44, left + 1, 9)
            env.check("P2104-END-06", "the rest", len(axis.pulses), n - stop_at)
            await axis.finish()
    await env.errors()


@directed("P2104-RD-07", "P2104-INT-02", "P2104-INT-04", "P2104-ERR-06")
async def p2104_rd_07_error_code_read(dut: Any) -> None:
    """In every state, codes 86 and A6 clear only the error register and the interrupt of their axis
    (P2104-RD-07).
    """
    env = await Env.start(dut, errint_n=0)
    first, second = await env.both(INIT_A)
    await first.go(0x45, rate=255)
    await env.run("c 42 c A7")
    since = env.bench.now
    env.check("P2104-RD-07", "e2, status", await env.run("e2 s"), [1, 0x84])
    await env.bench.clocks(200)
    env.check("P2104-RD-07", "e1, status, e1", await env.run("e1 s e1"), [5, 0x04, 0])
    await env.bench.clocks(200)
    levels = [v for _, v in env.bench.edges("int_n", since)]
    env.check("P2104-INT-04", "one release each", levels, [1, 0, 1])
    await first.halt()


@directed("P2104-INT-03", "P2104-INT-05", "P2104-INT-01", builds=(F16, F11, F48, F100))
async def p2104_int_03_release_window(dut: Any) -> None:
    """A new interrupt cause during a release of int_n does not shorten the release: int_n is high for W, then
    low again (P2104-INT-03).
    """
    env = await Env.start(dut)
    w = env.cfg.w
    axis = await env.ready(1, INIT_A)
    for delay in (3, w // 4, w // 2, *range(w - 9, w + 2), w + 9):
        env.bench.set(errint_n=0)
        await axis.move(0x42)
        await env.host.write(1, 0xA7)
        await env.bench.clocks(20)
        since = env.bench.now
        await env.x2.command(0x86)
        # END1 is still pending, so int_n is low again after the window.
        await env.bench.clocks(2 * w)
        (up, one), (down, zero) = env.bench.edges("int_n", since)
        env.check("P2104-INT-03", "levels", (one, zero), (1, 0))
        env.window("P2104-INT-03", "H with a cause left", down - up, w, w + 2)
        # Code 80 releases all causes; another cause follows `delay` cycles after the release.
        edge0 = await env.host.command(0x80, poll=False)
        await env.bench.until(edge0 + delay)
        cause = await env.host.write(1, 0x87)
        await env.bench.clocks(3 * w + 40)
        (up, one), (down, zero) = env.bench.edges("int_n", edge0)
        env.window("P2104-INT-03", "C-event to H", up - edge0, 2, 12)
        inside = down - up <= w + 2
        env.window("P2104-INT-03", "H, new cause inside" if inside else "H", down - up, w, 2 * w + 40)
        if not inside:
            env.window("P2104-INT-05", "cause to L", down - cause, 2, 14)
        env.check("P2104-INT-03", f"cause {delay} cycles later", inside, delay < w - 4 or inside)
        await env.run("e1 e2")
        await env.bench.clocks(2 * w)


@directed("P2104-INT-03")
async def p2104_int_03_windows_restart(dut: Any) -> None:
    """If two of four causes are read within 5 us, the second release restarts the time for which int_n is
    high (P2104-INT-03).
    """
    env = await Env.start(dut, errint_n=0)
    await env.both(INIT_A)
    await env.run("c 87 c A7")
    for gap in (4, 12, 30, 50):
        since = env.bench.now
        await env.host.write(1, 0x86)
        await env.bench.clocks(gap)
        edge0 = await env.host.write(1, 0xA6)
        await env.bench.clocks(60)
        await env.host.write(1, 0x87)
        await env.bench.clocks(300)
        edges = env.bench.edges("int_n", since)
        env.check("P2104-INT-03", f"levels, gap {gap}", [v for _, v in edges], [1, 0])
        env.window("P2104-INT-03", "second C-event to L", edges[1][0] - edge0, 80 + 2, 80 + 14)
        await env.host.command(0x86)
        await env.bench.clocks(200)
        await env.run("c 87 c A7")


@directed("P2104-INT-01", "P2104-INT-02", "P2104-BAD-24", "P2104-AUX-01", "P2104-BAD-20")
async def p2104_int_02_what_does_not_clear(dut: Any) -> None:
    """Only code 80 clears a pending END1; until then int_n stays low, and operations continue
    (P2104-INT-02).
    """
    env = await Env.start(dut)
    first, second = await env.both(INIT_B)
    await first.move(0x42)
    since = env.bench.now
    env.check("P2104-INT-01", "int_n", env.bench.level("int_n"), 0)
    await first.move(0x43, 4)
    await second.move(0x52)
    await first.command(0xC0)
    await first.init(*INIT_A)
    await env.run("c 81 r c 82 r c 83 rrr c A0 r c A6 r c 86 r c C2 r c C1")
    for level in (0, 1, 0, 1):
        env.bench.set(errint_n=level)
        await env.bench.clocks(30)
    await first.move(0x52)
    env.check("P2104-INT-02", "edges of int_n", env.bench.edges("int_n", since), [])
    env.check("P2104-BAD-24", "end status: the newest end", await first.finish(), 0x82)
    await env.bench.clocks(200)
    env.check("P2104-INT-02", "levels", [v for _, v in env.bench.edges("int_n", since)], [1])


@directed("P2104-INT-01", "P2104-LIM-08", "P2104-BAD-20")
async def p2104_int_01_errint_when_it_happens(dut: Any) -> None:
    """The level of errint_n at the time of an error decides whether this error asserts int_n
    (P2104-INT-01).
    """
    env = await Env.start(dut)
    for axis in env.axes:
        outcomes = []
        for lead in range(-4, 12):
            env.bench.set(errint_n=1)
            await env.bench.clocks(8)
            since = env.bench.now
            env.bench.at(since + lead + 6, errint_n=0)
            await env.host.write(1, 0x87 | axis.axis_bit, gap=8)
            await env.bench.clocks(20)
            outcomes.append(env.bench.level("int_n") == 0)
            env.check("P2104-INT-01", "ERROR", await env.host.status() & (0x80 | IBF), 0x80)
            await axis.error()
            await env.bench.clocks(100)
        env.check("P2104-INT-01", "L early enough or not", outcomes, sorted(outcomes, reverse=True))
        env.check("P2104-INT-01", "both were met", set(outcomes), {True, False})


@directed("P2104-INT-01", "P2104-CMD-02", "P2104-STP-06", "P2104-LIM-03")
async def p2104_int_01_every_end(dut: Any) -> None:
    """For each kind of end, int_n falls only if I = 0 (P2104-INT-01)."""
    env = await Env.start(dut)
    for axis, masked in product(await env.both(INIT_A), (0, 0x10)):
        for how in ("itself", "40", "41", "alm_n", "fl_n", "fhl_n", "run wait"):
            axis.set(run=0 if how == "run wait" else 1)
            await axis.go(0x43 | masked, 5 if how == "itself" else 100)
            if how == "run wait":
                await axis.command(0x40)
            elif how != "itself":
                await axis.pulse(3, 20)
                if how.endswith("_n"):
                    axis.set(**{how: 0})
                else:
                    await axis.command(int(how, 16))
            await axis.idle()
            await env.bench.clocks(4)
            axis.set(run=1, alm_n=1, fl_n=1, fhl_n=1)
            env.check(
                "P2104-INT-01",
                f"int_n, ended by {how}, I {masked >> 4}",
                env.bench.level("int_n"),
                masked >> 4,
            )
            await axis.finish()
            await env.bench.clocks(100)
