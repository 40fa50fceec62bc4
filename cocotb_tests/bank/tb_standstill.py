"""Standstill: completion of initialisations, chopper, hold (BANK-INI-02, BANK-CHP, BANK-HLD)."""

from __future__ import annotations

from cocotb_tests.harness import IBF, directed

from .bench import B4, B8, B32, F100
from .env import CONFIG, DATA, STATUS, Env

ON, OFF = 260, 435
"""Default phases of the chopper in quanta (P104-SW-04)."""
CHOPPED = (0x2A, 9, 4, 4)


@directed("BANK-CHP-01", "BANK-INI-02", builds=(B4, B8, B32, F100))
async def bank_chp_01_phases(dut):
    """While all axes chop, the duration of every phase is exact to the cycle, also after the end of a motion
    (BANK-CHP-01).
    """
    env = await Env.start(dut)
    axes = await env.all_ready(init=CHOPPED)
    since = env.bench.now
    await env.bench.clocks(env.cfg.quanta(3 * (ON + OFF)))
    quantum = env.cfg.quanta(1)
    for axis in axes:
        for value, clk in axis.stretches(since):
            want = (ON if value else OFF) * quantum
            env.check("BANK-CHP-01", f"phase {value:05b} of {axis.n}", clk, want)
        env.check("BANK-CHP-01", "phases", len(axis.stretches(since)) >= 4, True)
    axis = axes[1]
    edge0 = await axis.go(0x42, poll=False)
    end = axis.visit(axis.accepting_visit(edge0) + 2 * env.cfg.w + 1)
    if axis.visit(edge0 + 9) == axis.accepting_visit(edge0):
        await env.bench.until(end + (ON + OFF + 5) * quantum)
        off, on = axis.patterns(end)[:2]
        env.check(
            "BANK-CHP-01",
            "from the end of the motion",
            off,
            (axis.visit(axis.pulses[0] + env.cfg.w + 1) + ON * quantum, 0),
        )
        env.check("BANK-CHP-01", "the next", on, (off[0] + OFF * quantum, 0b00110))


@directed("BANK-CHP-01", "BANK-GEN-04", builds=(B8, F100), exact="a write must be accepted in a given cycle")
async def bank_chp_01_settings(dut):
    """Parameters and vsel set the durations of the chopper phases as the rules state. vsel applies to a phase
    if it was written 7 cycles or more before the visit that schedules the first edge of the phase
    (BANK-CHP-01, BANK-GEN-04).
    """
    env = await Env.start(dut)
    axis = await env.ready(3, CHOPPED)
    quantum = env.cfg.quanta(1)
    for on, off in ((0, 0), (1, 2), (3, 0)):
        await axis.host.send(0x84, (on, off))
        for vsel in (1, 0):
            await axis.set_config(1, vsel)
            await env.bench.clocks(env.cfg.quanta(900))
            since = env.bench.now
            length = 12 * (on + off) + (240 if vsel else 215)
            await env.bench.clocks(env.cfg.quanta(3 * length))
            expected = {0: 12 * off + (132 if vsel else 115), 1: 12 * on + (108 if vsel else 100)}
            for value, clk in axis.stretches(since):
                env.check(
                    "BANK-CHP-01", f"phase, {on} {off}, vsel {vsel}", clk, expected[bool(value)] * quantum
                )
    await axis.host.send(0x84, (0, 0))
    for early in (8, 7, 6):
        await axis.set_config(1, 1)
        await env.bench.clocks(env.cfg.quanta(600))
        since = axis.patterns(0)[-1][0]
        level = axis.patterns(0)[-1][1]
        edge = since + (108 if level else 132) * quantum
        while edge < env.bench.now + 60:
            level = 0 if level else 1
            edge += (108 if level else 132) * quantum
        ordered = axis.visit(edge - env.round + 1)
        await env.write_at(ordered - early, axis.n << 4 | CONFIG, 1)
        await env.bench.clocks(env.cfg.quanta(200))
        # The phase with the level `level` ends on `edge`; the next phase has the other level.
        follows = (132, 115) if level else (108, 100)
        nexts = [t for t, _ in axis.patterns(edge)]
        want = follows[1 if early >= 7 else 0] * quantum
        env.check("BANK-GEN-04", f"phase, vsel {early} cycles before", nexts[1] - nexts[0], want)


@directed(
    "BANK-CHP-01", "BANK-HSK-02", builds=(B8, B32, F100), exact="a register must be read in a given cycle"
)
async def bank_hsk_02_chopper_takes_the_visit(dut):
    """A visit that schedules an edge of the chopper does not accept a waiting byte; the next visit accepts it
    (BANK-HSK-02).
    """
    env = await Env.start(dut)
    axis = await env.ready(env.size - 1, CHOPPED)
    address = axis.n << 4 | STATUS
    await env.bench.clocks(env.cfg.quanta(ON + 30))
    for delay in range(-1, 2):
        edge = axis.patterns(0)[-1][0]
        edge += (OFF if axis.patterns(0)[-1][1] == 0 else ON) * env.cfg.quanta(1)
        ordered = axis.visit(edge - env.round + 1)
        visit = ordered + delay * env.round
        await env.write_at(visit - 7, address, 0x81)
        late = delay == 0
        got = await env.as_of(visit + 1, address)
        env.check("BANK-HSK-02", f"IBF, {delay:+} rounds", got & IBF, IBF * late)
        await env.bench.clocks(2 * env.round)
        await axis.host.read(DATA)
        await env.bench.clocks(2 * env.round)


@directed("BANK-INI-02", "BANK-HSK-02", "BANK-INI-01", builds=(B8, B32, F100))
async def bank_ini_02_completion(dut):
    """After an initialisation, the first visit that accepts bytes is the one after the visit that
    completes it (BANK-INI-02).
    """
    env = await Env.start(dut)
    axis = await env.ready(2, CHOPPED)
    edges = []
    for _ in range(3):
        await env.axes[5].init(0x0A, 12, 3, 4)
        await axis.host.send(0x2A, (12, 3, 4))
        await axis.host.write(DATA, 0)
        await axis.host.poll(IBF, 0)
        await axis.opened()
        await env.bench.clocks(env.cfg.quanta(ON + 10))
        edges.append(axis.patterns(0)[-1])
    env.check("BANK-INI-02", "OFF phase after a completion", [value for _, value in edges], [0, 0, 0])


@directed("BANK-HLD-01", "BANK-CHP-01", builds=(B8,))
async def bank_hld_01_hold(dut):
    """After a motion, hold rises at the first visit that is at least 34 ms later and does not schedule an
    edge of the chopper (BANK-HLD-01).
    """
    env = await Env.start(dut)
    plain, chopped, again, low = env.axes[0], env.axes[3], env.axes[5], env.axes[7]
    for axis in (plain, chopped, again, low):
        await axis.init(*(CHOPPED if axis is chopped else (0x0A, 9, 4, 4)))
    # 34 ms are 136 000 quanta: 60 chopper periods (700 + 1555 quanta) and one ON phase (700), so this visit
    # schedules an edge of the chopper.
    await chopped.set_config(1, 0)
    await chopped.host.send(0x84, (50, 120))
    ends = {}
    for axis in (plain, chopped, again):
        await axis.go(0x42)
        await axis.idle()
        ends[axis.n] = axis.visit(axis.pulses[0] + env.cfg.w + 1)
    hold_clk = env.cfg.cyc(544_000)
    await env.bench.until(ends[again.n] + hold_clk // 2)
    await again.go(0x42)
    await again.idle()
    ends[again.n] = again.visit(again.pulses[0] + env.cfg.w + 1)
    env.check("BANK-HLD-01", "hold falls at a start", again.level("hold"), 0)
    await env.bench.until(max(ends.values()) + hold_clk + 10 * env.round)
    for axis in (plain, again):
        want = axis.visit(ends[axis.n] + hold_clk)
        env.check("BANK-HLD-01", f"hold of {axis.n}", axis.edges("hold", ends[axis.n]), [(want, 1)])
    due = chopped.visit(ends[3] + hold_clk)
    ordering = [chopped.visit(t - env.round + 1) for t, _ in chopped.patterns(due - 50)]
    env.check("BANK-HLD-01", "that visit orders an edge", due in ordering, True)
    got = chopped.edges("hold", ends[3])
    env.check("BANK-HLD-01", "hold together with the chopper", got, [(due + env.round, 1)])
    env.check("BANK-HLD-01", "no motion: hold stays", low.edges("hold", 0), [])
