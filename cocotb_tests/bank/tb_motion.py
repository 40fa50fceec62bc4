"""Motions: exact intervals on several axes at the same time, ends, and the visits that detect the ends
(BANK-MOT).

V is the edge of a visit of the axis.
"""

from __future__ import annotations

from itertools import product

from cocotb_tests.harness import BUSY, directed
from cocotb_tests.harness.axis_driver import indices, rates, steps

from .bench import B4, B8, B32, B64, F100
from .env import CONFIG, DATA, INIT_A, POSITION, STATUS, SYNC, Env

RAMP = (20, 0, 30)


@directed("BANK-MOT-01", "BANK-GEN-01", "BANK-GEN-02", builds=(B4, B8, B32, B64, F100))
async def bank_mot_01_all_axes_at_once(dut):
    """During ramps and constant speeds of all axes, each pulse train and each low time is exact to the
    cycle (BANK-MOT-01).
    """
    env = await Env.start(dut)
    for axis in env.axes:
        await axis.init(0x0A, *RAMP, opened=False)
    expected = {}
    for axis in env.axes:
        await axis.opened()
        ccw = axis.n % 2 << 3
        if axis.n % 4 == 3:
            expected[axis.n] = [axis.n % 5] * 99
            edge0 = await axis.go(0x44 | ccw, 100, axis.n % 5, poll=False)
        else:
            expected[axis.n] = rates(RAMP, indices(90, RAMP[2]))
            edge0 = await axis.go(0x43 | ccw, 90, poll=False)
        start = axis.accepting_visit(edge0)
        await env.bench.level_is(axis.pin("hold"), 0)
        env.check("BANK-MOT-01", "hold falls at the visit", axis.edges("hold"), [(start, 0)])
        axis.since = start
        axis.started = start
    for axis in env.axes:
        await axis.idle()
        env.check("BANK-MOT-01", f"pulse 1 of {axis.n}", axis.pulses[0] - axis.started, env.cfg.w)
        axis.check_train("BANK-MOT-01", expected[axis.n])
        axis.check_lows("BANK-MOT-01", expected[axis.n])
        count = len(expected[axis.n]) + 1
        env.check("BANK-WIN-07", "position", await axis.position(), -count if axis.n % 2 else count)
        place = axis.pulses[0]
        seen = axis.patterns(place)
        env.check("BANK-MOT-01", "s changes with pout_n", [t for t, _ in seen], axis.pulses)
        ring = steps("4 full")
        way = [ring[(-k if axis.n % 2 else k) % 4] for k in range(1, count + 1)]
        env.check("BANK-MOT-01", f"phases of {axis.n}", [value for _, value in seen], way)


@directed("BANK-MOT-01", "BANK-INI-01", builds=(B8, B32))
async def bank_mot_01_another_ramp(dut):
    """An axis that is initialised again uses its new ramp; the other axes keep their ramps (BANK-MOT-01)."""
    env = await Env.start(dut)
    ramps = {1: (20, 3, 8), 2: (9, 0, 12), 6: (14, 5, 4)}
    for ramp in ((12, 1, 10), (30, 2, 6)):
        for n in ramps:
            await env.axes[n].init(0x0A, *ramps[n])
        ramps[2] = ramp
        await env.axes[2].init(0x0A, *ramp)
        for n in ramps:
            await env.axes[n].move(0x43, 40)
            env.axes[n].check_train("BANK-MOT-01", rates(ramps[n], indices(40, ramps[n][2])))
            await env.axes[n].finish()


@directed(
    "BANK-MOT-01", "BANK-GEN-04", builds=(B8, B32, F100), exact="a write must be accepted in a given cycle"
)
async def bank_mot_01_slow_clocks(dut):
    """For all values of csel and vsel, the intervals are those of the PPMC-104. The values that were written
    7 cycles or more before the start apply (BANK-MOT-01, BANK-GEN-04).
    """
    env = await Env.start(dut)
    axis = await env.ready(env.size - 3)
    for csel, vsel in ((1, 1), (1, 0), (0, 1), (0, 0)):
        await axis.set_config(csel, vsel)
        await env.bench.clocks(2 * env.round)
        for rate in (0, 2, 3, 7):
            await axis.move(0x44, 4, rate)
            axis.check_train("BANK-MOT-01", [rate] * 3, csel, vsel)
            axis.check_lows("BANK-MOT-01", [rate] * 3, csel, vsel)
    for late in range(-3, 4):
        await axis.set_config(1, 1)
        await axis.host.send(0x45)
        # CONFIG is written `late` + 7 cycles after the byte that starts the motion.
        axis.since = env.bench.now
        event = axis.visit(env.bench.now + 80) - 14 + late
        env.at_event(event, axis.n << 4 | DATA, 1)
        await env.write_at(event + 7, axis.n << 4 | CONFIG, 2)
        start = axis.visit(event + 7)
        await axis.pulse(3, 40)
        env.check("BANK-MOT-01", "pulse 1", axis.pulses[0], start + env.cfg.w)
        axis.check_train("BANK-GEN-04", [1] * 2, 0 if event + 7 + 7 <= start else 1)
        await axis.halt()


@directed("BANK-MOT-01", "BANK-GEN-04", builds=(B8, B32, F100))
async def bank_mot_01_steep_ramp_of_slow_clocks(dut):
    """With csel low, the intervals of a steep ramp are those of the PPMC-104. Such a ramp skips many rates,
    so the search for the next rate while decelerating ends after the low time (BANK-MOT-01).
    """
    env = await Env.start(dut)
    axis = env.axes[env.size - 2]
    ramp = (90, 2, 4)
    await axis.init(0x0A, *ramp)
    for csel, vsel in ((0, 1), (0, 0), (1, 1)):
        await axis.set_config(csel, vsel)
        await env.bench.clocks(2 * env.round)
        await axis.move(0x43, 12)
        axis.check_train("BANK-MOT-01", rates(ramp, indices(12, ramp[2])), csel, vsel)
        await axis.finish()


@directed("BANK-MOT-04", builds=(B4, B8, B32, F100), exact="a register must be read in a given cycle")
async def bank_mot_04_busy_falls(dut):
    """After a complete move, BUSY falls at the first visit V after the last low time (BANK-MOT-04).

    The test reads the status at V - 1 and V.
    """
    env = await Env.start(dut)
    for axis in (env.axes[0], env.axes[-1]):
        await axis.init(*INIT_A)
        for n, offset, want in ((1, -1, BUSY), (1, 0, 0), (3, -1, BUSY), (3, 0, 0)):
            edge0 = await axis.go(0x44, n, 1, poll=False)
            last = axis.accepting_visit(edge0) + env.cfg.w + env.cfg.quanta(16 * (n - 1))
            end = axis.visit(last + env.cfg.w + 1)
            got = await env.as_of(end + offset, axis.n << 4 | STATUS)
            env.check("BANK-MOT-04", f"status of {axis.n} at V {offset:+}", got, want)
            env.check("BANK-MOT-04", "last low time", axis.edges("pout_n")[-1], (last + env.cfg.w, 1))
            await axis.finish()


@directed(
    "BANK-MOT-03", "BANK-MOT-04", builds=(B8, B32, F100), exact="a register must be read in a given cycle"
)
async def bank_mot_04_cut_while_high(dut):
    """If a limit is detected on edge e while pout_n is high, BUSY falls at the first visit at e + 5 or later
    (BANK-MOT-04).
    """
    env = await Env.start(dut)
    axis = await env.ready(env.size - 1)
    for early in (4, 5, 6):
        for offset, want in ((-1, BUSY), (0, 0)):
            await axis.go(0x45, rate=30)
            await axis.pulse(1, env.cfg.w + 10)
            visit = axis.visit(env.bench.now + 60)
            seen = visit - early
            axis.at(seen - SYNC, l1_n=0)
            axis.at(seen - SYNC + 1, l1_n=1)
            end = visit + (env.round if early < 5 else 0)
            got = await env.as_of(end + offset, axis.n << 4 | STATUS)
            env.check("BANK-MOT-04", f"status, e = V - {early}, {offset:+}", got, want)
            await axis.idle()
            env.check("BANK-MOT-02", "pulses", len(axis.pulses), 1)
            env.check("BANK-MOT-02", "finish status", await axis.finish(), 0x95)


@directed("BANK-MOT-03", builds=(B8, B32), exact="a write must be accepted in a given cycle")
async def bank_mot_03_byte_before_it_is_known(dut):
    """A Decelerating Stop that is accepted before the visit that detects the end has the same effect as
    during a motion (BANK-MOT-03).
    """
    env = await Env.start(dut)
    axis = await env.ready(4)
    for early, error in ((4, False), (5, True)):
        await axis.go(0x46)
        await axis.pulse(1, env.cfg.w + 20)
        visit = axis.visit(env.bench.now + 60)
        axis.at(visit - early - SYNC, l1_n=0)
        await env.write_at(visit - 7, axis.n << 4 | STATUS, 0x41)
        await env.bench.clocks(3 * env.round)
        # The visit that ends the motion does not accept the byte. At the next visit, which accepts it, the
        # byte is a stop command at standstill.
        env.check("BANK-MOT-03", f"ERR, e = V - {early}", await axis.status() & 0xF0, 0x80 * error)
        axis.set(l1_n=1)
        env.check("BANK-MOT-03", "finish status", await axis.finish(), 0x96 | 0 if error else 0x96 | 0x40)


@directed("BANK-MOT-05", builds=(B8, B32, F100), exact="only one visit may sample the limit")
async def bank_mot_05_slow_down_limit(dut):
    """A slow-down limit that was detected on edge V - 4 takes effect at visit V; a limit that was detected on
    edge V - 3 does not (BANK-MOT-05).
    """
    env = await Env.start(dut)
    axis = await env.ready(env.size - 2)
    for early in (5, 4, 3):
        await axis.go(0x43, 1_000)
        await axis.pulse(2, env.cfg.w + 20)
        visit = axis.visit(env.bench.now + 60)
        axis.at(visit - early - SYNC, l3_n=0)
        # Depending on `early`, this visit is the only one that samples the low level, or no visit samples it.
        axis.at(visit - early - SYNC + 1, l3_n=1)
        if early == 4:
            await axis.idle()
            env.check("BANK-MOT-05", "finish status", await axis.finish(), 0x8B)
            env.check("BANK-MOT-05", "few pulses", len(axis.pulses) < 8, True)
        else:
            await axis.pulse(30)
            await axis.halt()


@directed(
    "BANK-MOT-05",
    "P104-LIM-09",
    "P104-FDC-05",
    builds=(B8, B32),
    exact="the switches must be sampled at the same edge",
)
async def bank_mot_05_only_the_first_request(dut):
    """A slow-down limit sets no bit if a command or the count has already begun the deceleration, or if the
    visit that samples the limit has detected an end (BANK-MOT-05).
    """
    env = await Env.start(dut)
    axis = await env.ready(3)
    for code, n, made, finish in ((0x41, 1_000, 6, 0xC3), (None, 24, 21, 0x83), (0x40, 24, 21, 0xC3)):
        await axis.go(0x43, n)
        await axis.pulse(made, 100)
        if code == 0x41:
            await axis.command(code)
            await axis.pulse(made + 1, 100)
        axis.set(l3_n=0)
        if code == 0x40:
            await env.bench.clocks(2 * env.round)
            await axis.command(code)
        await axis.idle()
        axis.set(l3_n=1)
        env.check("BANK-MOT-05", f"finish status, {n} pulses", await axis.finish(), finish)
    # L1 and L3 fall together, either while pout_n is high or during its low time, which delays the end of the
    # motion.
    for early, plus in product((7, 6, 5, 4, 3, 2), (100, 0)):
        await axis.go(0x46)
        await axis.pulse(6, plus)
        visit = axis.visit(env.bench.now + (60 if plus else 8 + SYNC))
        axis.at(visit - early - SYNC, l1_n=0, l3_n=0)
        await axis.idle()
        axis.set(l1_n=1, l3_n=1)
        # Both levels are detected on edge V - early. Visit V samples the slow-down limit. If early is at
        # least 5, visit V also detects the end of the motion.
        await axis.result(f"BANK-MOT-03, V - {early}, {plus}", 6, 0x9E if early == 4 else 0x96)


@directed(
    "BANK-MOT-05", "BANK-MOT-02", builds=(B8, B32, F100), exact="a write must be accepted in a given cycle"
)
async def bank_mot_05_which_pulse_counts(dut):
    """A deceleration flag set at visit V takes effect for a pulse on edge V and for later ones
    (BANK-MOT-05).
    """
    env = await Env.start(dut)
    axis = await env.ready(5)
    for code in (0x41, 0):
        for late in range(-2, 3):
            edge0 = await axis.go(0x43, 1_000, poll=False)
            first = axis.accepting_visit(edge0) + env.cfg.w
            second = first + env.cfg.quanta(8 * (1 + INIT_A[1]))
            visit = axis.visit(second + late * env.round // 2)
            if code:
                await env.write_at(visit - 7, axis.n << 4 | STATUS, code)
            else:
                axis.at(visit - 4 - SYNC, l3_n=0)
                axis.at(visit - 4 - SYNC + env.round, l3_n=1)
            await axis.pulse(2)
            await axis.idle()
            # The motion ends after the interval of index 0. After pulse 1 the current interval has index 0;
            # after pulse 2 it has index 1.
            want = 2 if visit <= second else 4
            env.check("BANK-MOT-05", f"pulses, V {visit - second:+} cycles", len(axis.pulses), want)
            await axis.finish()


@directed(
    "BANK-MOT-02",
    "BANK-WIN-07",
    "BANK-MOT-03",
    builds=(B8, B32, F100),
    exact="a register must be read in a given cycle",
)
async def bank_mot_02_pulse_cancelled(dut):
    """If a counted pulse is suppressed, the position is corrected when the end is detected
    (BANK-WIN-07).
    """
    env = await Env.start(dut)
    axis = await env.ready(6)
    for number in range(3):
        edge0 = await axis.go(0x45, rate=9, poll=False)
        second = axis.accepting_visit(edge0) + env.cfg.w + env.cfg.quanta(80)
        ordered = axis.visit(second - env.round + 1)
        axis.at(second - SYNC, l1_n=0)
        axis.at(second - SYNC + 3, l1_n=1)
        known = axis.visit(second + 5)
        want = (2, 2, 1)[number] + number
        at = (ordered, known - 1, known)[number]
        got = await env.as_of(at, axis.n << 4 | POSITION)
        env.check("BANK-WIN-07", f"position, {number}", got, want)
        await axis.idle()
        env.check("BANK-MOT-02", "pulses", len(axis.pulses), 1)
        env.check("BANK-MOT-02", "finish status", await axis.finish(), 0x95)
        env.check("BANK-MOT-02", "phases", axis.phases_now, steps("4 full")[(number + 1) % 4])
