"""Switches, STOP and stop commands -2 to +2 cycles from a pulse, for each position of the pulse in its round
(BANK-MOT-02).

One GO releases the held operations of all axes. Their pulses occur on the same edge, which has a different
position in the round for each axis. The expected results follow from the edges alone.

g is the edge of the write event of GO or STOP, V the edge of a visit of the axis, R the number of cycles in a
round, and W the pulse and set-up time of 5 us in cycles.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from itertools import product

from cocotb_tests.harness import directed
from cocotb_tests.harness.axis_driver import steps
from cocotb_tests.harness.checks import BOTH, two_causes

from .bench import B4, B8, B32, B64, F100
from .env import GO, STATUS, STOP, SYNC, Axis, Env

N = 4
OFFSETS = range(-2, 3)
WAYS = (0, 1)
PULSES = (1, 2, N)
"""The first, a middle and the last pulse of an operation of N pulses."""
CAUSES = {"limit": 0x10, "alarm": 0x20, "origin": 0x00}
PINS = {"limit": ("l1_n", "l2_n"), "alarm": ("alm_n", "alm_n"), "origin": ("cnp_n", "cnp_n")}


@dataclass(frozen=True)
class Case:
    """Case for one axis: the cause that ends its motion, which is detected `offset` cycles after pulse
    `pulse`, and the number of cycles for which the pin of the cause is low.
    """

    cause: str
    offset: int
    pulse: int
    ccw: int
    clk: int

    @property
    def code(self) -> int:
        """Operation code of an origin search, or of a move of N pulses."""
        return (0x47 if self.cause == "origin" else 0x44) | self.ccw << 3


class Waves:
    """Waves of cases; a wave runs one case on each axis. `rate` determines the low time of the pulses: half
    of an interval, or W.
    """

    def __init__(self, env: Env, rate: int) -> None:
        self.env, self.rate, self.done = env, rate, 0
        self.interval = env.cfg.quanta(8 * (rate + 1))
        self.positions = [0] * env.size

    async def start(self) -> None:
        """Initialise all axes and set their MASK bits."""
        await self.env.all_ready()
        await self.env.mask(*range(self.env.size))

    def edges(self, g: int) -> list[int]:
        """Return the edges of the pulses that a GO with write event g starts, if no cause ends the motion."""
        first = g + 4 + self.env.round + self.env.cfg.w
        return [first + k * self.interval for k in range(N)]

    async def let_go(self) -> list[int]:
        """Write GO at a fixed position in the round and return the edges of the pulses.

        Because each axis has another position in the round, the pulses then have all positions in the rounds.
        """
        g = -(-(self.env.bench.now + 10) // self.env.round) * self.env.round
        return self.edges(await self.env.write_at(g, GO, 0))

    async def held(self, axis: Axis, code: int) -> None:
        """Start an operation with N pulses (code 4) or without a pulse count; the axis holds it until GO."""
        await (axis.go(code, N, self.rate) if code & 7 == 4 else axis.go(code, rate=self.rate))

    async def play(self, cases: list[Case]) -> None:
        """Run one wave with one case per axis. Raise AssertionError unless each motion ends as expected."""
        env = self.env
        for axis, case in zip(env.axes, cases, strict=True):
            await self.held(axis, case.code)
        edges = await self.let_go()
        moves: dict[int, dict[str, int]] = {}
        for axis, case in zip(env.axes, cases, strict=True):
            seen = edges[case.pulse - 1] + case.offset
            pin = axis.pin(PINS[case.cause][case.ccw])
            moves.setdefault(seen - SYNC, {})[pin] = 0
            moves.setdefault(seen - SYNC + case.clk + env.bench.slack, {})[pin] = 1
        await env.bench.drive(sorted(moves.items()))
        await self.over(edges)
        for axis, case in zip(env.axes, cases, strict=True):
            pin = axis.pin(PINS[case.cause][case.ccw])
            seen = env.bench.pin_edges(pin, 0, edges[case.pulse - 1] + case.offset - SYNC)[0] + SYNC
            come = [t for t in edges if t < seen]
            complete = case.cause != "origin" and len(come) == N
            finish = 0x80 | case.code & 7 | (0 if complete else CAUSES[case.cause])
            total = N if case.cause != "origin" else 1 << 24
            await self.judge(axis, case, come, finish, total)

    async def over(self, edges: list[int]) -> None:
        """Wait until the motions of all axes must have ended."""
        await self.env.bench.until(
            max(self.env.bench.now, edges[-1] + self.env.cfg.w + 2 * self.env.round + 10)
        )

    async def judge(self, axis: Axis, case: object, come: list[int], finish: int, total: int = N) -> None:
        """Check the result of one case: pulses, finish status, remaining pulses, position and phases."""
        env, what = self.env, f"axis {axis.n}, {case}, rate {self.rate}"
        ccw = axis.level("dir")
        self.positions[axis.n] += -len(come) if ccw else len(come)
        position = self.positions[axis.n]
        env.check("BANK-MOT-02", f"pulses, {what}", axis.pulses, come)
        env.check("BANK-MOT-02", f"BUSY, {what}", await axis.status() & 4, 0)
        env.check("BANK-MOT-02", f"finish status, {what}", await axis.finish(), finish)
        env.check("BANK-MOT-02", f"remaining, {what}", await axis.remaining(), max(total - len(come) - 1, 0))
        env.check("BANK-WIN-07", f"position, {what}", await axis.position(), position)
        env.check("BANK-MOT-02", f"phases, {what}", axis.phases_now, steps("4 full")[position % 4])
        self.done += 1


def cases_of_pins() -> list[tuple[str, int, int, int]]:
    """Return all combinations of cause, offset, pulse and direction."""
    return list(product(CAUSES, OFFSETS, PULSES, WAYS))


async def pin_waves(dut: object, rate: int, rounds: int) -> Waves:
    """Run every case `rounds` times, each time on the next axis.

    If `rounds` is R, the number of cycles in a round of the bank, each case runs at each position in that
    round.
    """
    env = await Env.start(dut)
    waves, rng = Waves(env, rate), random.Random(rate)
    await waves.start()
    cases = cases_of_pins()
    queue = [Case(*case, rng.choice((1, 1, 2, 3))) for turn in range(rounds) for case in _turned(cases, turn)]
    queue += queue[: -len(queue) % env.size]
    for at in range(0, len(queue), env.size):
        await waves.play(queue[at : at + env.size])
    return waves


def _turned(cases: list[tuple[str, int, int, int]], turn: int) -> list[tuple[str, int, int, int]]:
    """Rotate the list of cases, so that each case runs on another axis in the next wave."""
    return cases[turn:] + cases[:turn]


@directed("BANK-MOT-01", "BANK-MOT-02", "BANK-MOT-04", "BANK-WIN-07", builds=(B8,))
async def bank_mot_02_pins_around_pulses(dut):
    """A limit, an alarm or the origin that is detected -2 to +2 cycles from the first, a middle or the last
    pulse ends the motion on its edge of detection (BANK-MOT-02).
    """
    waves = await pin_waves(dut, 0, 12)
    assert waves.done >= 90 * 12


@directed("BANK-MOT-02", "BANK-MOT-04", "BANK-WIN-07", builds=(B4, B8, B32, B64, F100))
async def bank_mot_02_pins_around_slower_pulses(dut):
    """In the other builds, and at a rate whose low time is W, a limit, an alarm or the origin near a pulse
    also ends the motion on its edge of detection (BANK-MOT-02).
    """
    waves = await pin_waves(dut, 3, 2)
    assert waves.done >= 180


@directed("BANK-MOT-02", "BANK-GRP-04", "BANK-WIN-07", builds=(B4, B8, B32, F100))
async def bank_grp_04_stop_around_pulses(dut):
    """If the edge g + 1 of a STOP is -2 to +2 cycles from a pulse of all axes, exactly the pulses on edge g +
    1 or later are suppressed (BANK-GRP-04).
    """
    env = await Env.start(dut)
    waves = Waves(env, 2)
    await waves.start()
    for offset, pulse in product(OFFSETS, PULSES):
        for axis in env.axes:
            await waves.held(axis, 0x44 | axis.n % 2 << 3)
        edges = await waves.let_go()
        g = edges[pulse - 1] + offset - 1
        g = await env.write_at(g, STOP, 0)
        await waves.over(edges)
        come = [t for t in edges if t < g + 1]
        for axis in env.axes:
            finish = 0x84 if len(come) == N else 0xC4
            await waves.judge(axis, f"STOP {offset:+} at pulse {pulse}", come, finish)


@directed("BANK-MOT-02", "BANK-MOT-03", "BANK-WIN-07", builds=(B8, F100))
async def bank_mot_02_stop_command_around_pulses(dut):
    """A stop command (0x40 or 0x41) that is accepted at a visit near a pulse suppresses exactly the pulses on
    the edge of that visit or later (BANK-MOT-02).
    """
    env = await Env.start(dut)
    waves = Waves(env, 1)
    await waves.start()
    axis = env.axes[5]
    await env.mask(5)
    done = 0
    for pulse, place, code in product(
        PULSES, range(0, 2 * env.round + 2, max(1, env.round // 12)), (0x40, 0x41)
    ):
        ccw = done & 1
        await waves.held(axis, 0x44 | ccw << 3)
        edges = await waves.let_go()
        event = edges[pulse - 1] - 7 - env.round + place - 1
        event = await env.write_at(event, axis.n << 4 | STATUS, code)
        visit = axis.visit(event + 7)
        await waves.over(edges)
        come = [t for t in edges if t < visit]
        finish = 0x84 if len(come) == N else 0xC4
        await waves.judge(axis, f"{code:02X} at {visit - edges[pulse - 1]:+} of pulse {pulse}", come, finish)
        done += 1


@directed("BANK-MOT-02", "BANK-MOT-03", "BANK-GRP-04", "BANK-WIN-07", builds=(B8, B32))
async def bank_mot_02_two_causes(dut):
    """If two causes of an end occur up to six cycles apart near a pulse, only the earlier one sets its finish
    bit; if they occur on the same edge, both set their bits (BANK-MOT-02).
    """
    env = await Env.start(dut)
    waves = Waves(env, 0)
    await waves.start()
    bits = {"l1_n": 0x10, "alm_n": 0x20}
    for (one, two), apart, offset in product((("l1_n", "alm_n"), ("alm_n", "l1_n")), range(7), OFFSETS):
        for axis in env.axes:
            await waves.held(axis, 0x44)
        edges = await waves.let_go()
        seen = edges[1] + offset
        ones, none = (1 << env.size) - 1, 0
        moves: dict[int, dict[str, int]] = {}
        for pin, t in ((one, seen), (two, seen + apart)):
            moves.setdefault(t - SYNC, {})[pin] = none
            moves.setdefault(t - SYNC + 1 + env.bench.slack, {})[pin] = ones
        await env.bench.drive(sorted(moves.items()))
        await waves.over(edges)
        for axis in env.axes:
            at = {pin: env.bench.pin_edges(axis.pin(pin), 0, seen - SYNC)[0] + SYNC for pin in (one, two)}
            first = min(at.values())
            come = [t for t in edges if t < first]
            finish = 0x84 | sum(bits[pin] for pin, t in at.items() if t == first)
            if axis.n % max(1, env.size // 8):
                waves.positions[axis.n] += len(come)
            else:
                await waves.judge(axis, f"{one} {offset:+}, {two} {apart} later", come, finish)


@directed(
    "BANK-MOT-02",
    "BANK-MOT-05",
    builds=(B8, B32),
    exact="the switches must be sampled at the same edge",
)
async def bank_mot_02_limit_and_alarm_on_one_edge(dut):
    """If L1 and ALM fall on the same edge, both finish bits are set. This holds for each operation, while
    accelerating, at constant speed and while decelerating. If a slow-down limit occurs before the last pulse
    of an operation with a pulse count, the end of the count sets no bit (BANK-MOT-02, BANK-MOT-05).
    """
    env = await Env.start(dut)
    axis = await env.ready(3)
    pins = (axis.pin("l1_n"), axis.pin("alm_n"))
    await two_causes(axis, "BANK-MOT-02", pins)
    axis.bench.set(**dict.fromkeys(pins, 0))
    await axis.go(0x42)
    await axis.result("BANK-MOT-02", 0, BOTH | 2, 0)
    axis.bench.set(**dict.fromkeys(pins, 1))
    for n in (1, 2):
        await axis.go(0x43, n)
        if n == 2:
            await axis.pulse(1, 10)
        axis.set(l3_n=0)
        await axis.result("BANK-MOT-05", n, 0x83, 0)
        axis.set(l3_n=1)


@directed("BANK-MOT-02", "BANK-MOT-05", builds=(B8, B32))
async def bank_mot_02_what_is_ignored(dut):
    """At constant speed, the origin, the limits of the other direction and the slow-down limits do not end a
    motion; command 0x81 reports their levels (BANK-MOT-02, BANK-MOT-05).
    """
    env = await Env.start(dut)
    axis = await env.ready(3)
    for code, pins in ((0x44, ("cnp_n", "l2_n", "l3_n", "l4_n")), (0x4C, ("cnp_n", "l1_n", "l3_n", "l4_n"))):
        for pin in pins:
            await axis.go(code, 5, 1)
            await axis.pulse(2)
            axis.set(**{pin: 0})
            await axis.idle()
            axis.set(**{pin: 1})
            env.check("BANK-MOT-02", f"pulses with {pin}", len(axis.pulses), 5)
            env.check("BANK-MOT-02", f"finish status with {pin}", await axis.finish(), 0x84)
    for axis in (env.axes[0], env.axes[-1]):
        for pin, levels in (("l1_n", 0xC7), ("l2_n", 0xCB), ("l3_n", 0xCD), ("l4_n", 0xCE), ("cnp_n", 0x4F)):
            axis.set(**{pin: 0})
            env.check("BANK-MOT-05", f"inputs with {pin}", await axis.fetch(0x81), [levels])
            axis.set(**{pin: 1})


@directed("BANK-MOT-05", builds=(B8, B32, F100))
async def bank_mot_05_inputs_to_the_clk(dut):
    """If command 0x81 is accepted at visit V, it reports an alarm that was detected on edge V - 4 or earlier,
    but not one that was detected on edge V - 3 (BANK-MOT-05).
    """
    env = await Env.start(dut)
    axis = env.axes[6]
    for early in (5, 4, 3):
        visit = axis.visit(env.bench.now + 60)
        start = visit - early - SYNC
        axis.at(start, alm_n=0)
        visit = axis.visit(await env.write_at(visit - 7, axis.n << 4 | STATUS, 0x81) + 7)
        await env.bench.clocks(2 * env.round)
        early = visit - SYNC - env.bench.pin_edges(axis.pin("alm_n"), 0, start)[0]
        want = 0x8F if early >= 4 else 0xCF
        env.check("BANK-MOT-05", f"inputs, e = V - {early}", await axis.host.read(0), want)
        axis.set(alm_n=1)


@directed("BANK-MOT-02", builds=(B8, B32))
async def bank_mot_02_after_a_forced_end(dut):
    """A limit in the low time of the last pulse of a forced deceleration does not count as the cause of the
    end (BANK-MOT-02).
    """
    env = await Env.start(dut)
    axis = await env.ready(2)
    for offset in (1, 10, 0):
        edge0 = await axis.go(0x43, 100, poll=False)
        last = axis.accepting_visit(edge0) + env.cfg.w  # command 0x41 before pulse 1 leaves only this pulse
        await axis.host.poll(2, 0)
        await axis.command(0x41)
        axis.at(last + offset - SYNC, l1_n=0)
        axis.at(last + offset - SYNC + 2, l1_n=1)
        await axis.idle()
        early = env.bench.pin_edges(axis.pin("l1_n"), 0, last + offset - SYNC)[0] + SYNC <= last
        pulses, finish = (0, 0xD3) if early else (1, 0xC3)
        env.check("BANK-MOT-02", f"pulses, {offset:+}", len(axis.pulses), pulses)
        env.check("BANK-MOT-02", f"finish status, {offset:+}", await axis.finish(), finish)
