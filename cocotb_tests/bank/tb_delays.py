"""Delays from the switches of a bank to their effects, and the time of an address before its strobe."""

from __future__ import annotations

from itertools import product

from cocotb_tests.harness import OBF, directed

from .bench import B8, B32, F100
from .env import CONFIG, DATA, STATUS, SYNC, Env
from .tb_limits import Waves


@directed("BANK-MOT-02", builds=(B8, B32, F100))
async def bank_mot_02_delays(dut):
    """A limit or an alarm that is first sampled SYNC cycles before a pulse prevents it; a later one does not.
    With JITTER=1, both occur at that edge (BANK-MOT-02).
    """
    env = await Env.start(dut)
    waves = Waves(env, 0)
    await waves.start()
    for pin in ("l1_n", "alm_n"):
        seen: dict[int, set[bool]] = {}
        for early, _ in product((SYNC - 1, SYNC, SYNC + 1), range(3)):
            for axis in env.axes:
                await waves.held(axis, 0x44)
            edges = waves.edges(await env.go())
            await env.bench.until(edges[1] - early)
            env.bench.set(**{pin: 0})
            await waves.over(edges)
            env.bench.set(**{pin: (1 << env.size) - 1})
            for axis in env.axes:
                seen.setdefault(early, set()).add(len(axis.pulses) == 1)
                env.check("BANK-MOT-02", "pulse 1", axis.pulses[0], edges[0])
                await axis.finish()
        expected = {SYNC - 1: {False}, SYNC: {True}, SYNC + 1: {True}}
        if env.bench.slack:
            expected[SYNC] = {False, True}
        env.check("BANK-MOT-02", f"pulses prevented by {pin}, by its lead", seen, expected)


@directed("BANK-WIN-04", "BANK-WIN-06", "BANK-HSK-01", builds=(B8, B32))
async def bank_win_04_address_before_a_strobe(dut):
    """At each distance from the visits, an access to another axis than before uses the registers of this axis
    if its address is stable 1 cycle before the strobe; with JITTER=1, 2 cycles before it (BANK-WIN-04).
    """
    env = await Env.start(dut)
    rng = env.bench.rng
    for axis in env.axes:
        await axis.host.write(CONFIG, axis.n & 3)
    for step in range(12 * env.round):
        axis = env.axes[5 * step % env.size]
        await env.bench.clocks(rng.randrange(env.round))
        env.check("BANK-WIN-04", f"CONFIG of axis {axis.n}", await axis.host.read(CONFIG), axis.n & 3)
        other = env.axes[(5 * step + 3) % env.size]
        await env.bench.clocks(rng.randrange(env.round))
        await other.host.write(STATUS, 0x81)
        await env.bench.clocks(2 * env.round)
        env.check("BANK-WIN-04", f"OBF of axis {other.n} after a command", await other.status() & OBF, OBF)
        await other.host.read(DATA)
