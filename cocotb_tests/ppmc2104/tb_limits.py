"""The limit, slow-down, alarm and origin inputs (P2104-LIM): their effect on each operation.

I(j) is the interval that follows pulse j.
"""

from __future__ import annotations

from itertools import product
from typing import Any

from cocotb_tests.harness import F16, F48, F100, directed
from cocotb_tests.harness.axis_driver import NO_PULSES_DONE, forced, rates
from cocotb_tests.harness.checks import BOTH, two_causes

from .env import Env
from .expected_timing import INIT_A
from .states import MOVING, enter, leave

PINS = ("fl_n", "bl_n", "fhl_n", "bhl_n", "org_n", "alm_n")
# (operation, pulse count, rate if the operation has one)
OPERATIONS = (
    (0x42, None, None),
    (0x43, 24, None),
    (0xC3, 24, None),
    (0x44, 24, 9),
    (0x45, None, 9),
    (0x46, None, None),
    (0xC6, None, None),
    (0x47, None, 9),
)


def effect(code: int, pin: str, waiting: bool = False) -> str:
    """Return the effect of an active pin on a running operation: "end", "slow" or "" (table of chapter 7)."""
    ccw = code >> 3 & 1
    if pin in ("alm_n", ("fl_n", "bl_n")[ccw]):
        return "end"
    if pin == "org_n":
        return "end" if code & 7 == 7 and not waiting else ""
    return "slow" if pin == ("fhl_n", "bhl_n")[ccw] and code & 7 in (3, 6) else ""


def bit(pin: str) -> int:
    """Return the end-status bit of a pin."""
    return {"alm_n": 0x20, "org_n": 0}.get(pin, 0x10 if pin in ("fl_n", "bl_n") else 0x08)


async def matrix_in_motion(env: Env, axis_number: int) -> None:
    """Check each operation in both directions with each input, which falls on the plateau.

    The inputs of the other axis are active.
    """
    axis, other = env.axes[axis_number - 1], env.axes[2 - axis_number]
    await axis.init(*INIT_A)
    other.set(**dict.fromkeys(PINS, 0))
    for base, n, rate in OPERATIONS[1:]:
        for code, pin in product((base, base | 8), PINS):
            await axis.go(code, n, rate)
            await axis.pulse(6, 100)
            axis.set(**{pin: 0})
            kind = effect(code, pin)
            if not kind and n is None:
                await axis.pulse(12, 100)
                await axis.command(0x40)
            await axis.idle()
            axis.set(**{pin: 1})
            what, low = f"P2104-LIM-02 {code:#x} {pin} axis {axis.n}", code & 7
            if kind == "end":
                await axis.result(what, 6, 0x80 | bit(pin) | low, (n or NO_PULSES_DONE) - 7)
            elif kind == "slow":
                # The deceleration flag is set in I(6), on the plateau: pulse 7 ends this interval, and 4 more
                # pulses follow.
                await axis.result(what, 11, 0x88 | low, (n or NO_PULSES_DONE) - 12)
                axis.check_train("P2104-FDC-03", rates(INIT_A[1:], forced(1000, 4, 6)))
            elif n:
                await axis.result(what, n, 0x80 | low, 0)
            else:
                await axis.result(what, 12, 0xC0 | low, NO_PULSES_DONE - 13)


@directed("P2104-LIM-02", "P2104-LIM-03", "P2104-LIM-04", "P2104-LIM-05", "P2104-LIM-07", builds=(F16, F48))
async def p2104_lim_02_matrix_axis_1(dut: Any) -> None:
    """If an input falls on the plateau of an operation of axis 1, it ends the operation, decelerates it or
    has no effect, as the rules state (P2104-LIM-02).
    """
    env = await Env.start(dut)
    await matrix_in_motion(env, 1)


@directed("P2104-LIM-02", "P2104-LIM-03", "P2104-LIM-04", "P2104-LIM-05", "P2104-LIM-07")
async def p2104_lim_02_matrix_axis_2(dut: Any) -> None:
    """If an input falls on the plateau of an operation of axis 2, it ends the operation, decelerates it or
    has no effect, as the rules state (P2104-LIM-02).
    """
    env = await Env.start(dut)
    await matrix_in_motion(env, 2)


@directed("P2104-LIM-09", "P2104-END-04", exact="the switches must be sampled at the same edge")
async def p2104_lim_09_limit_and_alarm_on_one_edge(dut: Any) -> None:
    """If FL and ALM fall on the same edge, both bits are set: while accelerating, at constant speed, while
    decelerating, and in RUN wait (P2104-LIM-09).
    """
    env = await Env.start(dut)
    for axis in await env.both(INIT_A):
        pins = (axis.pin("fl_n"), axis.pin("alm_n"))
        await two_causes(axis, "P2104-LIM-09", pins)
        axis.set(run=0)
        await env.bench.clocks(4)
        await axis.go(0x42)
        env.bench.set(**dict.fromkeys(pins, 0))
        await axis.result("P2104-LIM-09", 0, BOTH | 2, 0)
        axis.set(run=1, fl_n=1, alm_n=1)


@directed(
    "P2104-LIM-06",
    "P2104-LIM-05",
    "P2104-OPR-06",
    "P2104-BAD-17",
    exact="the switches must be sampled at the same edge",
)
async def p2104_lim_06_matrix_at_start(dut: Any) -> None:
    """If an input is low at the start of an operation, the operation sets error 7, outputs one pulse, or
    outputs all pulses, as the rules state (P2104-LIM-06).
    """
    env = await Env.start(dut, errint_n=0)
    for axis in await env.both(INIT_A):
        # First make a complete move. A rejected start must not change the results of the last operation.
        await axis.go(0x44, 10, 9)
        await axis.pulse(3, 100)
        await axis.halt()
        for (base, n, rate), ccw, pin in product(OPERATIONS, (0, 8), PINS):
            code = base | ccw
            before = (await axis.finish(), await axis.remaining())
            axis.set(**{pin: 0})
            await env.bench.clocks(4)
            kind, low = effect(code, pin), code & 7
            what = f"P2104-LIM-06 {code:#x} {pin} axis {axis.n}"
            since = env.bench.now
            await axis.go(code, n, rate)
            if kind == "end":
                await env.bench.clocks(200)
                env.check(what, "error", await axis.error(), 7)
                falls = env.bench.falls(axis.pin("hold"), since)
                moved = (axis.edges("pout_n", since), axis.edges("dir", since), falls)
                env.check(what, "edges", moved, ([], [], []))
                env.check(what, "phases", env.bench.edges(axis.phases, since), [])
                env.check(what, "results", (await axis.finish(), await axis.remaining()), before)
            else:
                total = n or (1 if base == 0x42 else NO_PULSES_DONE)
                pulses = 1 if kind == "slow" else total
                if pulses == NO_PULSES_DONE:
                    pulses = 8
                    await axis.pulse(8, 100)
                    await axis.command(0x40)
                bits = 0x08 if kind == "slow" else 0x40 if pulses < total else 0
                await axis.result(what, pulses, 0x80 | bits | low, max(total - pulses - 1, 0))
            axis.set(**{pin: 1})
            await env.bench.clocks(4)
        axis.set(**dict.fromkeys(PINS, 0))
        await env.bench.clocks(4)
        await axis.refused("P2104-BAD-17", "42 with all inputs active", 7, 0x42)
        axis.set(**dict.fromkeys(PINS, 1))
        await axis.running(99)
        axis.set(**dict.fromkeys(PINS, 0))
        await axis.result("P2104-BAD-17", 1, 0xB5, NO_PULSES_DONE - 2)
        axis.set(**dict.fromkeys(PINS, 1))


@directed("P2104-LIM-03", "P2104-LIM-04", "P2104-LIM-07", "P2104-LIM-05", "P2104-OPR-02")
async def p2104_lim_03_matrix_in_run_wait(dut: Any) -> None:
    """In RUN wait, an input that is low for 3 cycles ends the operation without a pulse, is stored, or has no
    effect (P2104-LIM-03, P2104-LIM-05).
    """
    env = await Env.start(dut)
    for axis in await env.both(INIT_A):
        for (base, n, rate), ccw, pin in product(OPERATIONS, (0, 8), PINS):
            code, low = base | ccw, base & 7
            axis.set(run=0)
            await axis.go(code, n, rate)
            await axis.blip(pin, 3)
            await env.bench.clocks(8)
            kind = effect(code, pin, waiting=True)
            what = f"P2104-LIM-03 {code:#x} {pin} axis {axis.n}"
            total = n or (1 if base == 0x42 else NO_PULSES_DONE)
            env.check(what, "BUSY", await env.host.status() & axis.busy, 0 if kind == "end" else axis.busy)
            axis.set(run=1)
            if kind == "end":
                await axis.result(what, 0, 0x80 | bit(pin) | low, total - 1)
                continue
            pulses = 1 if kind == "slow" else min(total, 8)
            if pulses < total and kind != "slow":
                await axis.pulse(8, 100)
                await axis.command(0x40)
            bits = 0x08 if kind == "slow" else 0x40 if pulses < total else 0
            await axis.result(what, pulses, 0x80 | bits | low, max(total - pulses - 1, 0))


@directed("P2104-LIM-03", "P2104-LIM-04", "P2104-END-02", "P2104-LIM-09", "P2104-END-04")
async def p2104_lim_03_every_state(dut: Any) -> None:
    """In every state of a moving axis, a limit or an alarm ends the operation within 8 cycles (P2104-LIM-03,
    P2104-LIM-04).
    """
    env = await Env.start(dut)
    done = {"ACC": 2, "HIGH": 5, "DEC": 5, "DEC natural": 5, "CONST": 2}
    for state, ccw, pin in product(MOVING, (0, 1), ("limit", "alm_n")):
        axis = env.axes[ccw]
        if state.startswith("FIN"):
            continue
        name = pin if pin == "alm_n" else ("fl_n", "bl_n")[ccw]
        await enter(axis, state, ccw)
        stamp = axis.set(**{name: 0})
        end = await axis.wait_end()
        env.window("P2104-END-02", f"{name} to the end in {state}", end - stamp, 0, 8)
        axis.set(**{name: 1}, run=1)
        low = 4 if "CONST" in state.upper() else 3
        total = 8 if state == "DEC natural" else 1000
        flag = 0x40 if state in ("DEC", "START flagged") else 0
        pulses = done.get(state, 0)
        await axis.result(f"P2104-LIM-03 {state}", pulses, 0x80 | flag | bit(name) | low, total - pulses - 1)
        await leave(axis)


@directed("P2104-LIM-05", "P2104-FDC-01", "P2104-PRO-05", "P2104-FSM-03")
async def p2104_lim_05_every_state(dut: Any) -> None:
    """A 3-cycle slow-down pulse sets the deceleration flag only in RUNWAIT, START, ACC and HIGH; all moving
    states except FIN are tried (P2104-LIM-05).
    """
    env = await Env.start(dut)
    for state, ccw in product(MOVING, (0, 1)):
        axis = env.axes[1 - ccw]
        if state.startswith("FIN"):
            continue
        await enter(axis, state, ccw)
        await axis.blip(("fhl_n", "bhl_n")[ccw], 3)
        await env.bench.clocks(4)
        axis.set(alm_n=0)
        await axis.idle()
        axis.set(alm_n=1)
        flags = state in ("RUNWAIT", "START", "ACC", "HIGH")
        cause = 0x08 if flags else 0x40 if state in ("DEC", "START flagged") else 0
        env.check("P2104-LIM-05", f"end status, {state}", await axis.finish() & 0xF8, 0xA0 | cause)
        await leave(axis)


@directed("P2104-LIM-01", "P2104-GEN-07", "P2104-LIM-10", builds=(F16, F100))
async def p2104_lim_01_two_clk_levels(dut: Any) -> None:
    """A low level of 2 cycles takes effect exactly once, at any time within an interval (P2104-LIM-01)."""
    env = await Env.start(dut)
    for axis, (pin, bits, code) in product(
        await env.both(INIT_A), (("fl_n", 0x94, 0x44), ("alm_n", 0xA4, 0x4C), ("bl_n", 0x94, 0x4C))
    ):
        for delay in (1, 2, 17, env.cfg.w - 1, env.cfg.w, env.cfg.w + 9):
            await axis.go(code, 30, 9)
            await axis.pulse(3, delay)
            await axis.blip(pin, 2)
            await axis.result("P2104-LIM-01", 3, bits, 26)
        # A low level that ended before the start has no effect; a low level in START ends the operation.
        await axis.blip(pin, 8)
        await env.bench.clocks(4)
        await axis.go(code, 3, 9)
        await axis.result("P2104-LIM-10", 3, 0x84, 0)
        await axis.go(code, 3, 9, poll=False)
        await env.bench.clocks(12)
        await axis.blip(pin, 2)
        await axis.result("P2104-LIM-01", 0, bits, 2)


@directed("P2104-LIM-09", "P2104-END-04", "P2104-END-05", "P2104-LIM-01")
async def p2104_lim_09_priority_at_a_pulse(dut: Any) -> None:
    """If an input that ends the motion falls in any cycle near the last pulse event, the pulse is either
    output or suppressed, and no other result occurs (P2104-LIM-09).
    """
    env = await Env.start(dut)
    axis = await env.ready(1, INIT_A)
    for pin, code in (("alm_n", 0x44), ("fl_n", 0x44), ("bl_n", 0x4C)):
        outcomes = []
        for before in range(8, -6, -1):
            await axis.go(code, 4, 9)
            third = await axis.pulse(3)
            await env.bench.until(third + 320 - before)
            axis.set(**{pin: 0})
            await axis.idle()
            axis.set(**{pin: 1})
            count = len(axis.pulses)
            outcomes.append(count)
            # Pulse 4 is the last: once it has been output, the move is complete.
            await axis.result("P2104-LIM-09", count, 0x84 if count == 4 else 0x84 | bit(pin), 0)
            if before >= 4:
                env.check("P2104-LIM-09", f"pulses, {pin} {before} cycles before", count, 3)
        env.check("P2104-LIM-09", "one switch-over", outcomes, sorted(outcomes))
        env.check("P2104-LIM-09", "both results occurred", set(outcomes), {3, 4})
    # If the input falls at the end of START, pulse 1, which would begin at this moment, is also either output
    # or suppressed.
    counts = []
    for after in range(env.cfg.w - 6, env.cfg.w + 10):
        edge0 = await axis.go(0x42, poll=False)
        await env.bench.until(edge0 + after)
        axis.set(alm_n=0)
        await axis.idle()
        axis.set(alm_n=1)
        counts.append(len(axis.pulses))
        await axis.result("P2104-LIM-09", counts[-1], 0x82 if counts[-1] else 0xA2, 0)
    env.check("P2104-LIM-09", "START or pulse 1", (counts[0], counts[-1], counts), (0, 1, sorted(counts)))


@directed("P2104-LIM-10", "P2104-RD-04", "P2104-LIM-08", "P2104-INT-05")
async def p2104_lim_10_nothing_at_rest(dut: Any) -> None:
    """With both axes at standstill, changes of the inputs change no output and do not affect later moves
    (P2104-LIM-10).
    """
    env = await Env.start(dut)
    axes = await env.both(INIT_A)
    since = env.bench.now
    names = (*PINS, "run", "csel", "extck")
    for _ in range(60):
        env.bench.set(
            **{pin: env.bench.rng.randrange(4) for pin in names}, errint_n=env.bench.rng.randrange(2)
        )
        await env.bench.clocks(env.bench.rng.randrange(1, 12))
    env.bench.set(**dict.fromkeys(names, 3), errint_n=1)
    await env.bench.clocks(4)
    env.quiet("P2104-LIM-10", since, "auxo")
    for axis in axes:
        env.check("P2104-LIM-10", "end status", await axis.finish(), 0x00)
        await axis.move(0x43, 12)
        await axis.result("P2104-LIM-10", 12, 0x83, 0)
