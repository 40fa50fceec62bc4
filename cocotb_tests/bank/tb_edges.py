"""Orders of events on which a host relies: requests near the end of a motion, STOP and GO, table builds,
absent axes.

g is the edge of the write event of GO or STOP, V the edge of a visit of the axis, and R the number of cycles
in a round.
"""

from __future__ import annotations

import random
from itertools import product

from cocotb_tests.harness import IBF, OBF, directed

from .bench import B4, B8, B32, B64, F100
from .env import DATA, GO, MASK, STATUS, STOP, SYNC, Axis, Env
from .tb_group import due
from .tb_standstill import CHOPPED, ON

STOP_BIT, ALARM_BIT, LIMIT_BIT, SLOW_BIT = 0x40, 0x20, 0x10, 0x08


def blip(axis: Axis, edge: int, **pins: int) -> None:
    """Schedule levels of input pins for a single cycle; `edge` is the edge on which they are detected."""
    axis.at(edge - SYNC, **pins)
    axis.at(edge - SYNC + 1, **{name: 1 - level for name, level in pins.items()})


@directed("BANK-MOT-02", "BANK-MOT-03", builds=(B8, B32), exact="a write must be accepted in a given cycle")
async def bank_mot_03_requests_around_an_end(dut):
    """If an alarm causes the end of a motion on edge e, command 0x41 and a slow-down limit still set their
    finish bits at visits up to e + 4. An immediate stop sets its bit at visit e, but not at visits e + 1 to e
    + 4 (BANK-MOT-03).
    """
    env = await Env.start(dut)
    axis = await env.ready(3)
    requests = ((0x40, 0x46), (0x40, 0x45), (0x41, 0x45), (0x41, 0x46), ("slow", 0x46))
    for (request, code), late, plus in product(requests, range(-2, 7), (100, 0)):
        await axis.go(code, rate=9)
        await axis.pulse(6, plus)  # plus = 100: pout_n is high again; plus = 0: still low
        visit = axis.visit(env.bench.now + (60 if plus else 12))
        blip(axis, visit - late, alm_n=0)
        if request == "slow":
            blip(axis, visit - 4, l3_n=0)
        else:
            env.at_event(visit - 7, axis.n << 4 | STATUS, request)
        await env.bench.until(visit + 1)
        await axis.idle()
        # At constant speed, command 0x41 is also an immediate stop.
        immediate = request == 0x40 or code == 0x45
        alarm = ALARM_BIT * (not immediate or late >= 0)
        bit = (SLOW_BIT if request == "slow" else STOP_BIT) * (late <= (0 if immediate else 4))
        what = f"finish status, {request} at e {late:+}, {code:02X}, {plus}"
        env.check("BANK-MOT-03", what, await axis.finish(), 0x80 | code & 7 | alarm | bit)


@directed("BANK-MOT-05", builds=(B8, B32), exact="a write must be accepted in a given cycle")
async def bank_mot_05_slow_down_limit_with_a_stop(dut):
    """The visit that accepts 0x40 ignores a slow-down limit; the visit that accepts 0x41 also accepts the
    limit and sets both finish bits (BANK-MOT-05)."""
    env = await Env.start(dut)
    axis = await env.ready(3)
    for (request, both), late in product(((0x40, 0), (0x41, SLOW_BIT)), (-1, 0, 1)):
        await axis.go(0x46)
        await axis.pulse(6, 100)
        visit = axis.visit(env.bench.now + 60 + env.round)
        blip(axis, visit + late * env.round - 4, l3_n=0)
        env.at_event(visit - 7, axis.n << 4 | STATUS, request)
        await env.bench.until(visit + env.round + 1)
        await axis.idle()
        # A slow-down limit that is sampled one visit earlier begins the deceleration; command 0x41 is then
        # rejected.
        bits = {-1: SLOW_BIT | (STOP_BIT if request == 0x40 else 0), 0: STOP_BIT | both, 1: STOP_BIT}[late]
        what = f"finish status, {request:02X}, slow-down limit {late:+} visits"
        env.check("BANK-MOT-05", what, await axis.finish(), 0x86 | bits)


@directed("BANK-GRP-04", builds=(B8, B32, F100), exact="a write must be accepted in a given cycle")
async def bank_grp_04_causes_of_a_start_after_stop(dut):
    """If STOP is written at g and an operation starts at a visit from g to g + R, the operation ends on the
    next edge with finish bit 6. An alarm or limit that is active on that edge also sets its bit
    (BANK-GRP-04).
    """
    env = await Env.start(dut)
    axis = await env.ready(3)
    bits = {"alm_n": ALARM_BIT, "l1_n": LIMIT_BIT, "l3_n": 0}
    for late, pin in product((-2, -1, 0, 1, 2, env.round - 1, env.round, env.round + 1), bits):
        visit = axis.visit(env.bench.now + 120)
        g = visit - late
        if abs(g - (visit - 7)) < 6:
            continue  # the two writes would overlap on the bus
        axis.since = visit - 30
        axis.set(**{pin: 0})
        for event, address, byte in sorted([(visit - 7, axis.n << 4 | STATUS, 0x42), (g, STOP, 0)]):
            await env.write_at(event, address, byte)
        await env.bench.clocks(3 * env.round + 2 * env.cfg.w)
        stopped = STOP_BIT * (0 <= late <= env.round or (late < 0 and not bits[pin]))
        ended = stopped or bits[pin]
        what = f"{pin}, V = g {late:+}"
        env.check("BANK-GRP-04", f"finish status, {what}", await axis.finish(), 0x82 | stopped | bits[pin])
        env.check("BANK-GRP-04", f"pulses, {what}", len(axis.pulses), 0 if ended else 1)
        axis.set(**{pin: 1})


@directed("BANK-GRP-03", builds=(B8, B32, B64), exact="a write must be accepted in a given cycle")
async def bank_grp_03_a_waiting_go_begins_at_g_plus_r(dut):
    """A GO written at g + 1 to g + R, where g is the write event of another GO, takes effect as if written on
    edge g + R; a later GO takes effect on its own write event (BANK-GRP-03)."""
    env = await Env.start(dut)
    axis = await env.ready(5)
    for gap in (6, 7, env.round - 1, env.round, env.round + 1):
        if gap > 2 * env.round - 8:
            continue  # the writes of the second GO and of MASK would overlap on the bus
        await env.mask(axis.n)
        await axis.go(0x42)
        await env.mask()
        # chosen so that g + 4 + R is the last visit that checks for the first GO
        g = axis.visit(env.bench.now + 60) - 4 - env.round
        g += env.round * (g < env.bench.now + 20)
        member = g + 2 * env.round - 2  # MASK = 1 only for the visits of the second GO
        for edge, address, byte in (
            (g, GO, 0),
            (g + gap, GO, 0),
            (member, axis.n // 8 << 4 | MASK, 1 << axis.n % 8),
        ):
            env.at_event(edge, address, byte)
        await env.bench.until(member + 3 * env.round + env.cfg.w)
        begun = g + max(gap, env.round)
        env.check("BANK-GRP-03", f"pulse 1, second GO at g + {gap}", axis.pulses, [due(env, begun)])
        await axis.idle()
        await axis.finish()


@directed("BANK-HLD-01", builds=(B8,))
async def bank_hld_01_read_at_the_visit_at_which_hold_rises(dut):
    """At the visit at which hold rises, command 0x82 returns HOLD = 0; at the next visit it returns HOLD = 1
    (BANK-HLD-01).
    """
    env = await Env.start(dut)
    reads = []
    for number, late in ((0, -1), (3, 0), (6, 1)):
        axis = await env.ready(number)
        await axis.go(0x42)
        await axis.idle()
        rise = axis.visit(axis.visit(axis.pulses[0] + env.cfg.w + 1) + env.cfg.cyc(544_000))
        reads.append((rise, late, axis))
    for rise, late, axis in reads:
        await env.write_at(rise + late * env.round - 7, axis.n << 4 | STATUS, 0x82)
        await env.bench.clocks(2 * env.round)
        env.check("BANK-HLD-01", f"HOLD in 0x82, {late:+}", await axis.host.read(DATA) >> 2 & 1, late > 0)
        env.check("BANK-HLD-01", "rise of hold", axis.edges("hold", rise - env.round), [(rise, 1)])


def build_cycles(slow: int, fast: int) -> int:
    """Return the duration of a table build in cycles (BANK-INI-01)."""
    return 1954 + 136 * (slow - fast) if slow > fast else 3


@directed(
    "BANK-INI-01",
    "BANK-INI-02",
    "BANK-CHP-01",
    builds=(B4, B8, B32, B64, F100),
    exact="a register must be read in a given cycle",
)
async def bank_ini_01_duration_of_a_build(dut):
    """A table is complete B cycles after the visit of the last byte: B = 1954 + 136 (RL - RH), or 3 if RL =
    RH. The first visit at least 3 cycles later completes the initialisation and starts the chopper; the next
    visit accepts bytes again (BANK-INI-01, BANK-INI-02)."""
    env = await Env.start(dut)
    rng = random.Random(env.size)
    some = [sorted((rng.randrange(1, 256), rng.randrange(256)), reverse=True) for _ in range(5)]
    for number, (slow, fast) in enumerate([(255, 0), (1, 0), (9, 9), (255, 255), *some]):
        axis = rng.choice(env.axes)
        pulses = rng.randrange(4, 11_221)
        await axis.host.send(0x2A, (slow, fast, pulses & 0xFF))
        await axis.host.poll(IBF, 0)
        visit = axis.accepting_visit(await axis.host.write(DATA, pulses >> 8))
        complete = axis.visit(visit + build_cycles(slow, fast) + 3)
        # before `visit`, a byte would replace the last byte of the initialisation
        await env.bench.until(max(visit, env.bench.now))
        read = axis.accepting_visit(await axis.host.write(STATUS, 0x82))
        # The visit that completes the initialisation accepts no byte.
        accepting_visit, offset = max(complete + env.round, read), number % 2 - 1
        if accepting_visit + offset > env.bench.now + 8:
            got = await env.as_of(accepting_visit + offset, axis.n << 4 | STATUS)
            what = f"status, RL {slow}, RH {fast}, PA {pulses}, {offset:+}"
            env.check("BANK-INI-02", what, got, IBF if offset < 0 else OBF)
        off = complete + env.cfg.quanta(ON)
        await env.bench.until(max(off, env.bench.now) + 20)
        env.check(
            "BANK-CHP-01", f"first OFF phase, RL {slow}, RH {fast}", axis.patterns(complete + 1)[0], (off, 0)
        )
        await axis.host.read(DATA)
        await axis.command(0xC0)  # excitation off: no more edges of this chopper


@directed("BANK-GRP-02", "BANK-INI-02", builds=(B8, B32), exact="a write must be accepted in a given cycle")
async def bank_grp_02_go_while_an_axis_is_initialised(dut):
    """While the table of an axis is built, the axis rejects GO. The error is 2 during the first
    initialisation, up to the visit that completes it, and 0 during later ones. The initialisation completes
    nevertheless (BANK-GRP-02).
    """
    env = await Env.start(dut)
    axis = env.axes[6]
    slow, fast = CHOPPED[1:3]
    for again, offset in product((False, True), (-20, -1, 0, 1)):
        await env.mask(axis.n)
        if not again:
            await axis.command(0xC0)
        await axis.host.send(0x0A, (slow, fast, 4))
        await axis.host.poll(IBF, 0)
        visit = axis.accepting_visit(await axis.host.write(DATA, 0))
        complete = axis.visit(visit + build_cycles(slow, fast) + 3)
        g = complete + offset * env.round - 5
        await env.write_at(g, GO, 0)
        await env.bench.clocks(2 * env.round)
        error = 0xA0 if not again and offset <= 0 else 0x80
        what = f"status, again {again}, GO {offset:+} visits from the completion"
        env.check("BANK-GRP-02", what, await axis.status() & 0xF0, error)
        await env.mask()
        await env.bench.until(max(complete, env.bench.now) + 2 * env.round)
        env.check("BANK-INI-02", "pulses afterwards", len(await axis.move(0x42)), 1)
        await axis.finish()


@directed("BANK-WIN-01", "BANK-WIN-03", builds=(B4, B8, B32))
async def bank_win_01_bank_registers_at_absent_axes(dut):
    """A write to MASK, GO or STOP at an absent axis has no effect. The byte of MASK for absent axes reads as
    0 and ignores writes (BANK-WIN-01, BANK-WIN-03).
    """
    env = await Env.start(dut)
    axis = await env.ready(0)
    await env.mask(0)
    await axis.go(0x45, rate=9)
    for absent in {env.size, 63}:
        await env.host.write(absent << 4 | GO, 0)
        await env.host.write(absent << 4 | MASK, 0)
    await env.bench.clocks(3 * env.round + 2 * env.cfg.w)
    env.check("BANK-WIN-01", "pulses after GO at an absent axis", axis.pulses, [])
    for k in range(max(1, env.size // 8), min(8, env.size)):
        await env.host.write(k << 4 | MASK, 0xFF)
        env.check("BANK-WIN-03", f"MASK byte {k}", await env.host.read(k << 4 | MASK), 0)
    env.check("BANK-WIN-03", "MASK byte 0", await env.host.read(MASK), 1)
    g = await env.go()
    await axis.pulse(2)
    await env.host.write(env.size << 4 | STOP, 0)
    await axis.pulse(5)
    env.check("BANK-GRP-02", "pulse 1", axis.pulses[0], due(env, g))
    await axis.halt()
