"""The limit, alarm and origin inputs (P104-LIM): their effect on each operation, priorities, timing.

I(j) is the interval that follows pulse j.
"""

from __future__ import annotations

from itertools import repeat

from cocotb_tests.harness import BUSY, F16, F50, F100, directed
from cocotb_tests.harness.checks import BOTH, two_causes

from .env import Env
from .expected_timing import INIT_A, INIT_B, forced, rates
from .states import PLATEAU, enter

ALL = 1 << 24
PINS = ("l1_n", "l2_n", "l3_n", "l4_n", "cnp_n", "alm_n")
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


def effect(code: int, pin: str) -> str:
    """Return the effect of an active pin on an operation in HIGH or at constant speed: "end", "slow" or
    "".
    """
    ccw = code >> 3 & 1
    if pin == "alm_n" or pin == ("l1_n", "l2_n")[ccw] or (pin == "cnp_n" and code & 7 == 7):
        return "end"
    if pin == ("l3_n", "l4_n")[ccw] and code & 7 in (3, 6):
        return "slow"
    return ""


def bit(pin: str) -> int:
    """Return the finish bit of a pin."""
    return {"alm_n": 0x20, "cnp_n": 0}.get(pin, 0x10 if pin in ("l1_n", "l2_n") else 0x08)


@directed(
    "P104-LIM-02",
    "P104-LIM-03",
    "P104-LIM-04",
    "P104-LIM-05",
    "P104-LIM-06",
    "P104-LIM-08",
    "P104-OPR-06",
    builds=(F16, F50),
)
async def p104_lim_02_matrix_in_motion(dut):
    """If an input falls on the plateau of an operation, CW or CCW, it ends the operation, decelerates it or
    has no effect, as the rules state (P104-LIM-02).
    """
    env = await Env.start(dut, INIT_A)
    for base, n, rate in OPERATIONS[1:]:
        for code in (base, base | 8):
            for pin in PINS:
                await env.go(code, n, rate)
                await env.pulse(6, 100)
                env.bench.set(**{pin: 0})
                kind = effect(code, pin)
                if not kind and n is None:
                    await env.pulse(12, 100)
                    await env.host.command(0x40)
                await env.idle()
                env.bench.set(**{pin: 1})
                what = f"P104-LIM-02 {code:#x} {pin}"
                low = code & 7
                if kind == "end":
                    await env.result(what, 6, 0x80 | bit(pin) | low, (n or ALL) - 7)
                elif kind == "slow":
                    # The deceleration flag is set in I(6), on the plateau: pulse 7 ends this interval, and 4
                    # more pulses follow.
                    await env.result(what, 11, 0x88 | low, (n or ALL) - 12)
                    env.check_train("P104-FDC-02", rates((9, 4, 4), forced(1000, 4, 6)))
                elif n:
                    await env.result(what, n, 0x80 | low, 0)
                else:
                    await env.result(what, 12, 0xC0 | low, ALL - 13)


@directed(
    "P104-LIM-07",
    "P104-LIM-03",
    "P104-LIM-05",
    "P104-LIM-06",
    "P104-LIM-04",
    "P104-LIM-08",
    "P104-OPR-06",
    builds=(F16, F50),
)
async def p104_lim_07_matrix_at_start(dut):
    """If an input is low at the start of an operation, the operation outputs no pulse, one pulse or all
    pulses, as the rules state (P104-LIM-07).
    """
    env = await Env.start(dut, INIT_A)
    for base, n, rate in OPERATIONS:
        for code in (base, base | 8):
            for pin in PINS:
                env.bench.set(**{pin: 0})
                await env.bench.clocks(4)
                pattern = env.bench.level("s")
                await env.go(code, n, rate)
                count = n or (1 if base == 0x42 else ALL)
                kind = effect(code, pin)
                what, low = f"P104-LIM-07 {code:#x} {pin}", code & 7
                if kind == "end":
                    await env.result(what, 0, 0x80 | bit(pin) | low, count - 1)
                    env.check(what, "s", env.bench.level("s"), pattern)
                elif kind == "slow":
                    # In POUT mode, the first plateau interval is I(5); this results in 5 + 1 + 4 pulses
                    # (P104-LIM-04).
                    pulses = 1 if base < 0xC0 else 10
                    await env.result(what, pulses, 0x88 | low, count - pulses - 1)
                elif count < ALL:
                    await env.result(what, count, 0x80 | low, 0)
                else:
                    await env.pulse(8, 100)
                    await env.host.command(0x40)
                    await env.result(what, 8, 0xC0 | low, count - 9)
                env.bench.set(**{pin: 1})
                await env.bench.clocks(4)


@directed("P104-LIM-03", "P104-LIM-05", "P104-LIM-09", "P104-END-02", "P104-BAD-20")
async def p104_lim_03_every_phase(dut):
    """ALM or the hard limit of the direction ends a motion immediately in START, ACC, HIGH, DEC and CONST
    (P104-LIM-03, P104-LIM-05).
    """
    env = await Env.start(dut, None)
    states = {"START ramp": 0, "ACC": 2, "HIGH": PLATEAU, "DEC": PLATEAU, "DEC natural": 6}
    states |= {"START constant": 0, "CONST": 2}
    for state, pulses in states.items():
        for ccw in (0, 8):
            for pin in ("alm_n", "l2_n" if ccw else "l1_n"):
                await enter(env, state, 0x43 | ccw, 0x44 | ccw)
                hit = env.bench.set(**{pin: 0})
                end = await env.wait_end()
                env.window("P104-END-02", f"{pin} to the end in {state}", end - hit, 0, 8)
                op = 4 if "CONST" in state.upper() else 3
                total = 8 if state == "DEC natural" else 1000
                flag = 0x40 if state == "DEC" else 0
                env.bench.set(**{pin: 1})
                await env.result("P104-LIM-03", pulses, 0x80 | flag | bit(pin) | op, total - pulses - 1)


@directed("P104-LIM-04", "P104-FDC-01", "P104-FDC-04")
async def p104_lim_04_per_state(dut):
    """If L3 is low for 3 cycles, it takes effect in exactly the states that P104-LIM-04 lists, in phase mode
    and in POUT mode.
    """
    env = await Env.start(dut, None)
    for code in (0x43, 0x46, 0xC3, 0xC6):
        for state, flags in (
            ("START ramp", code < 0xC0),
            ("ACC", code < 0xC0),
            ("HIGH", True),
            ("DEC natural", False),
        ):
            if state == "DEC natural" and code & 7 == 6:
                continue
            await enter(env, state, code)
            await env.bench.pulse_pin("l3_n", 0, 3)
            await env.bench.clocks(4)
            status = await env.host.command(0x41)
            decelerating = flags or state == "DEC natural"
            env.check(
                "P104-LIM-04",
                f"0x41 after L3 in {state} of {code:#x}",
                status,
                0xF4 if decelerating else BUSY,
            )
            env.bench.set(alm_n=0)
            await env.idle()
            env.bench.set(alm_n=1)
            cause = 0x08 if flags else (0 if state == "DEC natural" else 0x40)
            env.check("P104-LIM-04", f"finish, {state} of {code:#x}", await env.finish() & 0xF8, 0xA0 | cause)


@directed("P104-LIM-04", "P104-PRO-06", "P104-EX-05")
async def p104_lim_04_pout_mode_plateau(dut):
    """In POUT mode, if L3 is low from any interval on, it takes effect when the plateau is reached
    (P104-LIM-04).
    """
    env = await Env.start(dut, INIT_B)
    for j in (1, 5, 9, 10, 11, 12, 15):
        await env.go(0xC3, 60)
        await env.pulse(j, 60)
        env.bench.set(l3_n=0)
        await env.idle()
        env.bench.set(l3_n=1)
        at = max(j, 11)
        which = forced(1000, 10, at)
        env.check_train("P104-LIM-04", rates(INIT_B[1:], which))
        await env.result("P104-LIM-04", len(which) + 1, 0x8B, 60 - len(which) - 2)
    # HIGH begins with pulse 11, after I(10), which lasts 320 cycles. A low level that ends before HIGH has no
    # effect.
    for release, pulses, finish in ((314, 60, 0x83), (326, 22, 0x8B)):
        await env.go(0xC3, 60)
        await env.pulse(2, 60)
        env.bench.set(l3_n=0)
        await env.pulse(10, release)
        env.bench.set(l3_n=1)
        await env.result("P104-LIM-04", pulses, finish, max(60 - pulses - 1, 0))


@directed("P104-LIM-01", "P104-GEN-07", builds=(F16, F100))
async def p104_lim_01_two_clk_levels(dut):
    """A low level of 2 cycles takes effect exactly once, at any time within an interval (P104-LIM-01)."""
    env = await Env.start(dut, INIT_A)
    for pin, bits in (("l1_n", 0x94), ("alm_n", 0xA4)):
        for delay in (1, 2, 17, env.cfg.w - 1, env.cfg.w, env.cfg.w + 9):
            await env.go(0x44, 30, 9)
            await env.pulse(3, delay)
            await env.bench.pulse_pin(pin, 0, 2)
            await env.result("P104-LIM-01", 3, bits, 26)
    # A low level of 2 cycles also takes effect in START; a low level that ended before the start has no
    # effect.
    await env.bench.pulse_pin("l1_n", 0, 8)
    await env.bench.clocks(2)
    await env.go(0x44, 3, 9)
    await env.result("P104-LIM-01", 3, 0x84, 0)
    await env.go(0x44, 3, 9)
    await env.bench.pulse_pin("l1_n", 0, 2)
    await env.result("P104-LIM-01", 0, 0x94, 2)


@directed("P104-LIM-09", "P104-END-04", "P104-LIM-01")
async def p104_lim_09_priority_at_a_pulse(dut):
    """If ALM falls in any cycle near a pulse event, the pulse is either output or suppressed, and no other
    result occurs (P104-LIM-09).
    """
    env = await Env.start(dut, INIT_A)
    outcomes = []
    for before in range(8, -6, -1):
        await env.go(0x44, 4, 9)
        third = await env.pulse(3)
        await env.bench.until(third + 320 - before)
        env.bench.set(alm_n=0)
        await env.idle()
        env.bench.set(alm_n=1)
        count = len(env.pulses)
        outcomes.append(count)
        # Pulse 4 is the last: once it has been output, the move is complete.
        await env.result("P104-LIM-09", count, 0x84 if count == 4 else 0xA4, 0)
        if before >= 6:
            env.check("P104-LIM-09", f"pulses, ALM {before} cycles before", count, 3)
    env.check("P104-LIM-09", "one switch-over", outcomes, sorted(outcomes))
    env.check("P104-LIM-09", "both results occurred", set(outcomes), {3, 4})


@directed("P104-LIM-09", "P104-END-04", "P104-FDC-01", "P104-STP-04")
async def p104_lim_09_two_requests_on_one_edge(dut):
    """If command 0x41 and L3 occur some cycles apart, only the earlier one sets its bit. If they occur on the
    same edge, both bits are set, without an error (P104-LIM-09).
    """
    env = await Env.start(dut, INIT_B)
    kinds = []
    for shift in range(-4, 14):
        await env.go(0x43, 200)
        fall = await env.pulse(4)
        base = fall + 60
        env.bench.at(base + shift, l3_n=0)
        await env.bench.until(base - 2)
        await env.host.write(1, 0x41)
        await env.bench.clocks(14)
        status = await env.host.status()
        await env.idle()
        env.bench.set(l3_n=1)
        finish = await env.finish()
        env.check("P104-LIM-09", "pulses", len(env.pulses), 8)
        kinds.append(finish)
        env.check("P104-STP-04", f"status at {finish:#x}", status, 0xF4 if finish == 0x8B else BUSY)
    order = [0x8B, 0xCB, 0xC3]
    env.check("P104-LIM-09", "L3 first, both, 0x41 first", kinds, sorted(kinds, key=order.index))
    env.check(
        "P104-LIM-09",
        "each outcome was met, both on exactly one edge",
        (set(kinds), kinds.count(0xCB)),
        (set(order), 1),
    )


@directed("P104-LIM-09", "P104-END-04", exact="the switches must be sampled at the same edge")
async def p104_lim_09_limit_and_alarm_on_one_edge(dut):
    """If L1 and ALM fall on the same edge, both bits are set in each operation, while accelerating, at
    constant speed and while decelerating (P104-LIM-09).
    """
    env = await Env.start(dut, INIT_A)
    await two_causes(env, "P104-LIM-09", ("l1_n", "alm_n"))
    env.bench.set(l1_n=0, alm_n=0)
    await env.go(0x42)
    await env.result("P104-LIM-09", 0, BOTH | 2, 0)


@directed(
    "P104-LIM-09",
    "P104-LIM-04",
    "P104-LIM-06",
    "P104-END-04",
    exact="the switches must be sampled at the same edge",
)
async def p104_lim_09_causes_on_the_external_clock(dut):
    """With vsel = L and an external clock, L3, CNP, and L1 with ALM have the same effect as with an internal
    clock (P104-LIM-09).
    """
    env = await Env.start(dut, (0x1A, 9, 4, 4), vsel=0)
    period = env.cfg.us(4)
    env.bench.external_clock(repeat(period), high=period // 2)
    await two_causes(env, "P104-LIM-09", ("l1_n", "alm_n"))
    for code, rate, pin, made, finish in ((0x46, None, "l3_n", 11, 0x8E), (0x47, 9, "cnp_n", 6, 0x87)):
        await env.go(code, None, rate)
        await env.pulse(6, 100)
        env.bench.set(**{pin: 0})
        await env.idle()
        env.bench.set(**{pin: 1})
        await env.result("P104-LIM-09", made, finish, ALL - made - 1)


@directed(
    "P104-LIM-09", "P104-END-04", "P104-STP-03", exact="command and switch must be sampled at the same edge"
)
async def p104_lim_09_stop_command_and_hard_limit(dut):
    """If a stop command and L1 take effect on the same edge of a ramped move, command 0x40 sets its bit in
    addition to the bit of the limit; command 0x41 is too late to set its bit (P104-LIM-09).
    """
    env = await Env.start(dut, INIT_B)
    kinds = {}
    for code in (0x40, 0x41):
        kinds[code] = []
        for shift in range(-4, 14):
            await env.go(0x43, 200)
            base = await env.pulse(4) + 60
            env.bench.at(base + shift, l1_n=0)
            await env.bench.until(base - 2)
            await env.host.write(1, code)
            await env.bench.clocks(14)
            await env.idle()
            env.bench.set(l1_n=1)
            kinds[code].append(await env.finish())
            await env.host.write(1, 0x80)  # clear the error of a stop command at standstill
    both = [place for place, finish in enumerate(kinds[0x40]) if finish == 0xD3]
    env.check("P104-LIM-09", "0x40 and L1 coincide on one edge", len(both), 1)
    late = both[0]
    env.check("P104-LIM-09", "0x40", set(kinds[0x40][:late]) | set(kinds[0x40][late + 1 :]), {0x93, 0xC3})
    env.check("P104-LIM-09", "0x41 on that edge, or later", set(kinds[0x41][: late + 1]), {0x93})
    env.check("P104-LIM-09", "0x41 a cycle before", set(kinds[0x41][late + 1 :]), {0xD3})


@directed("P104-LIM-10", "P104-RD-05")
async def p104_lim_10_nothing_at_rest(dut):
    """At standstill, changes of the inputs change no output and do not affect later moves (P104-LIM-10)."""
    env = await Env.start(dut, INIT_A)
    since = env.bench.now
    for _ in range(60):
        env.bench.set(**{pin: env.bench.rng.randrange(2) for pin in PINS})
        await env.bench.clocks(env.bench.rng.randrange(1, 12))
    env.bench.set(**dict.fromkeys(PINS, 1))
    await env.bench.clocks(4)
    moved = {name: env.bench.edges(name, since) for name in env.outputs()}
    env.check("P104-LIM-10", "edges of outputs", moved, {name: [] for name in moved})
    env.check("P104-LIM-10", "finish status", await env.finish(), 0x00)
    await env.move(0x43, 12)
    await env.result("P104-LIM-10", 12, 0x83, 0)
