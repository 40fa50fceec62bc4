"""Groups: MASK, GO, STOP (BANK-GRP).

g is the edge of the write event of GO or STOP, V the edge of a visit of the axis, w the edge of any other
write event, and R the number of cycles in a round.
"""

from __future__ import annotations

from cocotb_tests.harness import BUSY, directed

from .bench import B4, B8, B32, B64, F100
from .env import GO, INIT_A, MASK, STATUS, STOP, SYNC, Axis, Env


def due(env: Env, g: int) -> int:
    """Return the edge of pulse 1 if the write event of GO is edge g (BANK-GRP-02)."""
    return g + 4 + env.round + env.cfg.w


@directed("BANK-GRP-01", "BANK-GRP-02", builds=(B4, B8, B32, B64, F100))
async def bank_grp_02_all_on_one_edge(dut):
    """After GO, the held operations of all axes output their first pulse on the same edge (BANK-GRP-02)."""
    env = await Env.start(dut)
    axes = await env.all_ready()
    await env.mask(*range(env.size))
    for turn in range(4):
        for axis in axes:
            await axis.go(0x45 | (axis.n + turn) % 2 << 3, rate=axis.n % 3)
        for axis in axes:
            env.check("BANK-GRP-01", "BUSY, hold", (await axis.status(), axis.level("hold")), (BUSY, 0))
            env.check("BANK-GRP-01", "dir", axis.level("dir"), (axis.n + turn) % 2)
        await env.bench.clocks(env.cfg.w + turn)
        env.check("BANK-GRP-01", "no pulse before GO", [axis.pulses for axis in axes], [[]] * env.size)
        g = await env.go()
        await axes[0].pulse(3)
        env.check("BANK-GRP-02", "edges of pulse 1", {axis.pulses[0] for axis in axes}, {due(env, g)})
        for axis in axes:
            axis.check_train("BANK-MOT-01", [axis.n % 3] * (len(axis.pulses) - 1))
        await env.stop()
        for axis in axes:
            await axis.idle()
            env.check("BANK-GRP-04", "finish status", await axis.finish(), 0xC5)


@directed("BANK-GRP-01", builds=(B8, B32, F100), exact="a write must be accepted in a given cycle")
async def bank_grp_01_mask_of_a_start(dut):
    """An operation that starts at visit V is held if the MASK bit was written at w = V - 5 or earlier
    (BANK-GRP-01).
    """
    env = await Env.start(dut)
    axis = await env.ready(3)
    for byte in (8, 0):
        for early in (6, 5, 4):
            await env.mask(*([] if byte else [3]))
            visit = axis.visit(env.bench.now + 100)
            # The two writes do not fit into one round of 8 cycles, so the byte of the operation is written as
            # early as possible.
            env.at_event(visit - early - 7, axis.n << 4 | STATUS, 0x42)
            env.at_event(visit - early, MASK, byte)
            start = axis.visit(visit - early)
            axis.since = visit - 20
            await env.bench.until(visit + 3 * env.round + env.cfg.w)
            held = (visit - early <= start - 5) == bool(byte)
            env.check("BANK-GRP-01", f"pulses, w = V - {early}", len(axis.pulses), 0 if held else 1)
            if held:
                await env.mask(3)
                g = await env.go()
                await axis.pulse(1)
                env.check("BANK-GRP-02", "pulse 1", axis.pulses, [due(env, g)])
            await axis.idle()
            await axis.finish()


@directed("BANK-GRP-02", "BANK-HSK-02", builds=(B4, B8, B32))
async def bank_grp_02_refused(dut):
    """Of the axes with MASK = 1, GO sets error 1 in a busy axis, error 2 in an axis without an
    initialisation, and error 0 in an axis at standstill or waiting for parameters (BANK-GRP-02).
    """
    env = await Env.start(dut)
    busy, held, rest, fresh = env.axes[:4]
    waiting, out = env.axes[4:6] if env.size > 4 else (None, None)
    for axis in (busy, held, rest, waiting, out):
        if axis:
            await axis.init(*INIT_A)
    await busy.go(0x45, rate=9)
    await env.mask(*(axis.n for axis in (busy, held, rest, fresh, waiting) if axis))
    await held.go(0x42)
    if waiting:
        await waiting.host.send(0x43, (1, 2))
        await out.go(0x42)
        await out.idle()
    g = await env.go()
    await env.bench.clocks(2 * env.round + 10)
    for axis, want in ((busy, 0x94), (rest, 0x80), (fresh, 0xA0), (waiting, 0x80), (out, 0x00), (held, BUSY)):
        if axis:
            env.check("BANK-GRP-02", f"status of {axis.n}", await axis.status(), want)
    if waiting:
        env.check("BANK-GRP-02", "a parameter that is not requested", await waiting.host.data(0), 0xB0)
    await held.idle()
    env.check("BANK-GRP-02", "pulse 1", held.pulses, [due(env, g)])
    env.check("BANK-GRP-02", "the busy axis continues", await busy.status() & BUSY, BUSY)


@directed("BANK-GRP-02", builds=(B8, B32, F100), exact="a write must be accepted in a given cycle")
async def bank_grp_02_which_visit(dut):
    """A GO written at g takes effect at the first visit at g + 5 or later, for operations that started at an
    earlier visit (BANK-GRP-02).
    """
    env = await Env.start(dut)
    axis = await env.ready(2)
    await env.mask(2)
    for early in range(14, -3, -1):
        visit = axis.visit(env.bench.now + 100)
        # The operation starts at `visit`; GO is written `early` cycles before it.
        events = sorted([(visit - 7, axis.n << 4 | STATUS, 0x42), (visit - early, GO, 0)])
        if abs(7 - early) < 6:
            continue  # the two writes would overlap on the bus
        axis.since = visit - 30
        for event, address, byte in events:
            await env.write_at(event, address, byte)
        await env.bench.clocks(4 * env.round + 2 * env.cfg.w)
        found = axis.visit(visit - early + 5)
        late = found <= visit
        if late:
            # GO found the axis at standstill and set error 0, unless a later byte cleared it.
            env.check("BANK-GRP-02", "status", await axis.status() & BUSY, BUSY)
            await env.go()
        await axis.idle()
        env.check("BANK-GRP-02", "pulses", len(axis.pulses), 1)
        await axis.finish()


@directed("BANK-GRP-03", builds=(B8, B32, B64), exact="a write must be accepted in a given cycle")
async def bank_grp_03_second_go_waits(dut):
    """A GO written while another GO is active takes effect R cycles after the first; a third GO has no effect
    (BANK-GRP-03).
    """
    env = await Env.start(dut)
    axes = await env.all_ready(0, env.size - 1)
    await env.mask(*(axis.n for axis in axes))
    for gap in (5, env.round - 1, env.round, env.round + 1):
        if gap < 6:
            continue
        for count in (2, 3):
            for axis in axes:
                await axis.go(0x45, rate=20)
            first = env.bench.now + 20
            await env.write_at(first, GO, 0)
            await env.write_at(first + gap, GO, 0)
            if count == 3:
                await env.go()
            await env.bench.clocks(4 * env.round + env.cfg.w)
            for axis in axes:
                env.check("BANK-GRP-02", "pulse 1", axis.pulses[0], due(env, first))
                env.check("BANK-GRP-03", "the second one is refused", await axis.status(), 0x94)
                await axis.command(0x40)
                await axis.idle()
                await axis.finish()


@directed(
    "BANK-GRP-03", "BANK-GRP-02", builds=(B8, B32, B64), exact="a write must be accepted in a given cycle"
)
async def bank_grp_03_mask_during_go(dut):
    """While GO is active, each visit uses the value that MASK had 5 cycles before the visit (BANK-GRP-03)."""
    env = await Env.start(dut)
    axes = await env.all_ready()
    for late in range(6, env.round + 8, max(1, env.round // 8)):
        await env.mask(*range(env.size))
        for axis in axes:
            await axis.go(0x42)
        g = env.bench.now + 20
        await env.write_at(g, GO, 0)
        await env.write_at(g + late, MASK, 0)
        await env.bench.clocks(4 * env.round + 2 * env.cfg.w)
        for axis in axes:
            found = axis.visit(g + 5)
            goes = axis.n >= 8 or found < g + late + 5
            env.check("BANK-GRP-03", f"pulses of {axis.n}, {late}", axis.pulses, [due(env, g)] * goes)
            if not goes:
                await axis.command(0x40)
            await axis.idle()
            await axis.finish()


@directed("BANK-GRP-01", "BANK-GRP-04", "BANK-MOT-02", builds=(B8, B32))
async def bank_grp_01_held_is_watched(dut):
    """A limit, an alarm, a stop command or STOP ends a held operation without a pulse (BANK-GRP-01)."""
    env = await Env.start(dut)
    axis = await env.ready(1)
    await env.mask(1)

    async def ends(what: str, code: int, finish: int) -> None:
        await axis.idle()
        env.check("BANK-GRP-01", f"pulses, {what}", axis.pulses, [])
        env.check("BANK-GRP-01", f"finish status, {what}", await axis.finish(), finish | code & 7)
        await env.go()
        await env.bench.clocks(3 * env.round + 2 * env.cfg.w)
        env.check("BANK-GRP-02", f"GO after {what}", await axis.status(), 0x80)
        env.check("BANK-GRP-02", f"pulses, {what}", axis.pulses, [])

    for pin, finish in (("l1_n", 0x90), ("alm_n", 0xA0)):
        await axis.go(0x46)
        axis.at(env.bench.now + 3, **{pin: 0})
        axis.at(env.bench.now + 4 + env.bench.slack, **{pin: 1})
        await ends(pin, 0x46, finish)
    await axis.go(0x47, rate=1)
    axis.at(env.bench.now + 3, cnp_n=0)
    axis.at(env.bench.now + 4 + env.bench.slack, cnp_n=1)
    await ends("origin", 0x47, 0x80)
    for code in (0x42, 0x46):
        await axis.go(code)
        await axis.command(0x40)
        await ends("0x40", code, 0xC0)
        await axis.go(code)
        await env.stop()
        await ends("STOP", code, 0xC0)
    await axis.go(0x42)
    await axis.command(0x41)
    await ends("0x41", 0x42, 0xC0)


@directed("BANK-GRP-04", builds=(B8, B32, F100), exact="a write must be accepted in a given cycle")
async def bank_grp_04_starts_around_stop(dut):
    """A STOP written at g ends operations that start at visits up to g + R, but no later operation
    (BANK-GRP-04).
    """
    env = await Env.start(dut)
    axis = await env.ready(4)
    for late in (-9, -8, -7, -1, 0, 1, 2, env.round - 1, env.round, env.round + 1, env.round + 2):
        visit = axis.visit(env.bench.now + 100)
        g = visit - late
        if abs(g - (visit - 7)) < 6:
            continue  # the bus is occupied by the other access
        axis.since = visit - 30
        for event, address, byte in sorted([(visit - 7, axis.n << 4 | STATUS, 0x42), (g, STOP, 0)]):
            await env.write_at(event, address, byte)
        await env.bench.clocks(2 * env.round + 2 * env.cfg.w)
        stopped = late <= env.round
        env.check("BANK-GRP-04", f"pulses, V = g {late:+}", len(axis.pulses), 0 if stopped else 1)
        env.check("BANK-GRP-04", f"finish, V = g {late:+}", await axis.finish(), 0xC2 if stopped else 0x82)


@directed("BANK-GRP-04", "BANK-MOT-04", builds=(B8, B32))
async def bank_grp_04_all_at_once(dut):
    """STOP ends all running motions on edge g + 1 and does not change axes at standstill (BANK-GRP-04)."""
    env = await Env.start(dut)
    axes = await env.all_ready()
    moving: list[Axis] = [axis for axis in axes if axis.n % 3]
    for axis in moving:
        await (axis.go(0x45, rate=0) if axis.n % 2 else axis.go(0x43, 1_000))
    await env.bench.clocks(500)
    g = await env.stop()
    await env.bench.clocks(100)
    for axis in axes:
        late = [t for t in axis.pulses if t > g]
        env.check("BANK-GRP-04", f"pulses of {axis.n} after g", late, [])
        if axis in moving:
            env.check("BANK-GRP-04", "finish", await axis.finish() & 0xF0, 0xC0)
            env.check("BANK-WIN-07", "position", await axis.position(), len(axis.pulses))
        else:
            env.check("BANK-GRP-04", "status at rest", await axis.status(), 0)
    await env.bench.clocks(SYNC)


@directed(
    "BANK-GRP-03", "BANK-GRP-02", builds=(B32, B64, F100), exact="a write must be accepted in a given cycle"
)
async def bank_grp_03_third_go(dut):
    """A third GO has no effect if it is written before g + R. At g + R or later, while the second GO is
    active, it waits for the end of the second GO (BANK-GRP-03).
    """
    env = await Env.start(dut)
    axis = await env.ready(9)
    for late in (-1, 0, 1):
        await env.mask(axis.n)
        await axis.go(0x42)
        await env.mask()
        g = axis.visit(env.bench.now + 40) - 5  # the visit at g + 5 is the earliest that detects this GO
        for edge in (g, g + env.round // 2, g + env.round + late):
            await env.write_at(edge, GO, 0)
        # MASK = 1 for the visit of the third GO, but not for an earlier visit.
        await env.write_at(g + 2 * env.round - 4, axis.n // 8 << 4 | MASK, 1 << axis.n % 8)
        await env.bench.clocks(4 * env.round + env.cfg.w)
        want = [due(env, g + 2 * env.round)] if late >= 0 else []
        env.check("BANK-GRP-03", f"pulses, third GO at g + R {late:+}", axis.pulses, want)
        if not want:
            await axis.command(0x40)
        await axis.idle()
        await axis.finish()
