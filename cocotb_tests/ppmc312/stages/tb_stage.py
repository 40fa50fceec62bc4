"""Contracts of ppmc312_muldiv, ppmc312_cosine_rom and ppmc312_stage_unit (builder, table, plan)."""

from __future__ import annotations

import random

import cocotb

from openppmc.model.ppmc312.stages import (
    LAST,
    STAGES,
    SettingError,
    Table,
    build,
    curve,
    ramped,
    sigmoid_weights,
)

from ...harness import BlockDriver, rng, same
from . import stage_types
from .stage_types import Target, brief, pack, walk_start

AREA, GROUPS, BLOCKS = stage_types.AREA, stage_types.GROUPS, stage_types.BLOCKS
LONGEST_BUILD, LONGEST_PLAN = 127 * 300, 135 + 5 * 131 + 53
# start, stop, high, acceleration, deceleration, sigmoid, separate. The rows are T1..T5 of
# docs/ppmc312/README.md, settings just inside and outside its error conditions, the fastest and slowest
# rates, and the most pulses.
SETTINGS = [
    (1000, 0, 200, 2000, 0, 0, 0),
    (1000, 0, 200, 2000, 0, 1, 0),
    (1000, 500, 200, 2000, 1500, 0, 1),
    (500, 1000, 200, 1500, 2000, 0, 1),
    (8192, 0, 64, 60_000, 0, 1, 0),
    (1000, 0, 200, 761, 0, 0, 0),
    (1000, 0, 200, 762, 0, 1, 0),
    (1000, 0, 200, 763, 0, 0, 0),
    (1000, 1000, 200, 2000, 761, 0, 1),
    (1000, 1000, 200, 762, 2000, 1, 1),
    *((0xFFFF, 0, 0xFF7F, pulses, 0, pulses & 1, 0) for pulses in (254, 255, 256)),
    (1000, 0, 872, 2000, 0, 0, 0),
    (1000, 328, 200, 2000, 2000, 1, 1),
    (1000, 500, 200, 2000, 300, 0, 1),
    (0xFFFF, 0xFFFF, 2, 0xFFFFFF, 0xFFFFFF, 1, 1),
    (0xFFFF, 0x82, 2, 0xFFFFFF, 0xFFFFFF, 0, 1),
    (0xFFFF, 0, 0xFF7F, 500, 0, 1, 0),
]


@cocotb.test()
async def muldiv_exact(dut):
    """For random and extreme operands, products, quotients and remainders are exact and on time."""
    rand = rng()
    u = BlockDriver(dut, "muldiv", BLOCKS, "busy_o hi_o lo_o")
    await u.reset()
    for n in range(300):
        steps, mul = rand.randint(1, 24), rand.randrange(2)
        small = rand.choice(((1 << steps) - 1, rand.getrandbits(steps)))
        bits = 39 + mul  # the remainder needs one more bit
        operand = rand.choice(((1 << bits) - 1, rand.getrandbits(rand.randint(1, bits)) | 1))
        if mul:
            hi, lo = 0, small  # the low bits of the product are output in the upper bits of lo
        else:
            hi = rand.randrange(operand)
            lo = small << 24 - steps
        await u.clk(start_i=1, mul_i=mul, steps_i=steps, lo_i=lo, operand_i=hi)
        u.put(start_i=0, lo_i=rand.getrandbits(24), mul_i=rand.randrange(2), operand_i=operand)
        last = steps + (1 - mul)
        for clk in range(last):
            same(f"{n}: busy in cycle {clk} of {last}", (await u.clk())[0], 1)
        busy, got_hi, got_lo = await u.settle()
        same(f"{n}: busy after {last} cycles", busy, 0)
        if mul:
            same(f"{n}: {small} * {operand}", got_hi << steps | got_lo >> 24 - steps, small * operand)
        else:
            want = divmod(hi << steps | small, operand)
            same(f"{n}: {hi << steps | small} / {operand}", (got_lo & (1 << steps) - 1, got_hi), want)


@cocotb.test()
async def muldiv_product_is_divided(dut):
    """A product that is kept in the block can be divided without a reload."""
    rand = rng()
    u = BlockDriver(dut, "muldiv", BLOCKS, "busy_o hi_o lo_o")
    await u.reset()
    for n in range(40):
        pulses, speed = rand.getrandbits(24), rand.getrandbits(32)
        whole = rand.randrange(speed * pulses >> 24, 1 << 39) + 1
        await u.clk(start_i=1, mul_i=1, steps_i=24, lo_i=pulses, operand_i=0)
        u.put(start_i=0, operand_i=speed)
        for _ in range(24):
            await u.clk()
        u.put(lo_i=rand.getrandbits(24), operand_i=whole, mul_i=0)
        await u.clk(start_i=1, keep_i=1)
        u.put(start_i=0, keep_i=0)
        for _ in range(25):
            await u.clk()
        same(f"{n}: {pulses} * {speed} / {whole}", (await u.settle())[2:0:-1], divmod(pulses * speed, whole))


@cocotb.test()
async def cosine_weights(dut):
    """The weight of a stage is valid two cycles after its index; with linear_i = 1 it equals the index."""
    u = BlockDriver(dut, "rom", BLOCKS, "weight_o")
    u.choose()
    order = [*range(STAGES), *rng().sample(range(STAGES), STAGES)]
    got = [await u.clk(linear_i=0, index_i=i) for i in [*order, 0, 0]]
    same("weights", got[2:], [sigmoid_weights()[i] for i in order])
    got = [await u.clk(linear_i=1, index_i=i) for i in [*order, 0, 0]]
    same("linear weights", got[2:], order)


async def _idle(u: BlockDriver, port: str) -> int:
    """Run until this output is low; return the number of cycles."""
    await u.settle()
    return await u.run_until(port, 0) if u.get(port) else 0


def curve_word(setting: tuple[int, ...]) -> int:
    """Return curve_t for a setting, with base clock 5."""
    start, stop, high, acc, dec, sigmoid, separate = setting
    stop, dec = (stop, dec) if separate else (start, acc)
    return pack(
        (sigmoid, 1), (separate, 1), (5, 3), (start, 16), (stop, 16), (high, 16), (acc, 24), (dec, 24)
    )


async def _read(u: BlockDriver) -> list[list[tuple[int, ...]]]:
    """Return rate, acceleration pulses and deceleration pulses of all stages, read through both ports."""
    words: list[list[tuple[int, ...]]] = []
    for side in (0, 1):
        seen = []
        for i in [*range(STAGES), 0, 0]:
            u.put(read_addr_i=pack((side, 1), (i, 7)), table_addr_i=pack((side, 1), (LAST - i, 7)))
            await u.clk()
            seen.append((*divmod(u.get("read_stage_o"), 1 << 24), *divmod(u.get("stage_o"), 1 << 24)))
        words.append(seen[1:-1])  # the output is read after the edge, so one cycle less is needed
    planner = [(*up[:2], down[1]) for up, down in zip(*words, strict=True)]
    motion = [(*up[2:], down[3]) for up, down in zip(*words, strict=True)]
    return [planner, motion[::-1]]


async def _check(u: BlockDriver, table: Table, what: str, clk: int, pulses: tuple[int, int]) -> None:
    """Check description, look-up results and words of the active table."""
    want = pack(
        (1, 1), (table.separate, 1), (clk, 3), (table.sa, 7), (table.sd, 7), (table.rates[table.sa], 16)
    )
    want = want << 80 | pack((table.rates[table.sd], 16), (table.high, 16), (pulses[0], 24), (pulses[1], 24))
    same(f"{what}: description", f"{u.get('table_o'):x}", f"{want:x}")
    same(
        f"{what}: start_target_o",
        Target.split(u.get("start_target_o")),
        Target.of(table, table.rates[table.sa]),
    )
    for port, got in zip(("planner", "motion"), await _read(u), strict=True):
        for i in range(table.first, STAGES):
            # The pulse numbers below the first stage of a ramp have no meaning.
            rate, acc, dec = got[i]
            seen = (rate, acc if i >= table.sa else 0, dec if i >= table.sd else 0)
            same(f"{what}: stage {i}, port of the {port}", seen, (table.rates[i], table.pa[i], table.pd[i]))


def settings(rand: random.Random, count: int) -> list[tuple[int, ...]]:
    """Return the corner settings, and random settings that can only be rejected because a stage has too few
    pulses.
    """
    found = list(SETTINGS)
    while len(found) < len(SETTINGS) + count:
        high = int(2 ** rand.uniform(1, 15.9))
        start, stop = (min(0xFFFF, high + 128 + int(2 ** rand.uniform(0, 15.9))) for _ in range(2))
        acc, dec = (int(2 ** rand.uniform(9, 24)) for _ in range(2))
        if min(start, stop) - high > 127:
            found.append((start, stop, high, acc, dec, rand.randrange(2), rand.randrange(2)))
    return found


@cocotb.test()
async def stage_tables_exact(dut):
    """For reference and random settings, either all stages equal those of the model, or block and model both
    reject the setting.
    """
    u = BlockDriver(dut, "unit", BLOCKS, limit=BlockDriver.FREE)
    await u.reset()
    thin = longest = 0
    for setting in settings(rng(), 10):
        start, stop, high, acc, dec, sigmoid, separate = setting
        await u.clk(build_i=1, curve_i=curve_word(setting))
        u.put(build_i=0)
        took = await _idle(u, "busy_o")
        assert 0 < took <= LONGEST_BUILD, f"{setting}: {took} cycles"
        longest = max(longest, took)
        try:
            table = build(start, stop, high, acc, dec, 5, bool(sigmoid), bool(separate))
        except SettingError as refused:
            same(f"{setting}: why refused", refused.number, 0x05)
            thin += 1
            same(
                f"{setting}: too few pulses, valid",
                (u.get("too_few_pulses_o"), u.get("table_o") >> 114),
                (1, 0),
            )
            continue
        same(f"{setting}: too few pulses", u.get("too_few_pulses_o"), 0)
        await _check(u, table, str(setting), 5, (acc, dec if separate else acc))
    assert thin >= 2, "no refused setting"
    cocotb.log.info("longest build: %d clk", longest)
    await u.clk(drop_i=1)
    same("valid after drop_i", u.get("table_o") >> 114, 0)


def curves(rand: random.Random) -> Table:
    """Return a random free curve with one table or two, each of 2 to 127 stages.

    In most curves, the rates are sorted, fastest first; in the others, their order is random.
    """
    counts = [rand.choice((2, 3, rand.randint(2, 12), rand.randint(2, 127), 127)) for _ in range(2)]
    split = rand.random() < 0.7
    if rand.random() < 0.2:
        counts[1] = counts[0]
    most = max(counts) if split else counts[0]
    rates = sorted(rand.choices(range(2, rand.choice((most + 2, 400, 0xFFFF))), k=most))
    if rand.random() < 0.3:
        rand.shuffle(rates)
    top = rand.choice((3, 9, 100, 100_000))
    pulses = [[rand.randint(2, top) for _ in range(count)] for count in counts]
    return curve(rates, pulses[0], pulses[1] if split else None, clk=rand.randrange(8))


async def _load(u: BlockDriver, table: Table) -> None:
    """Load a free curve word by word, fastest stage first."""
    await u.clk(
        open_i=1,
        open_acc_i=table.sa,
        open_dec_i=table.sd,
        curve_i=pack((0, 1), (table.separate, 1), (table.clk, 3), (0, 96)),
    )
    u.put(open_i=0)
    columns = [(4, table.rates, table.first), (2, table.pa, table.sa), (1, table.pd, table.sd)]
    if not table.separate:
        columns[1:] = [(3, table.pa, table.sa)]
    for which, values, first in columns:
        for i in range(LAST, first - 1, -1):
            await u.clk(table_write_i=pack((which, 3), (i, 7), (values[i], 24)))
    u.put(table_write_i=0)
    sums = pack((table.na, 24), (table.nd, 24))
    await u.clk(close_i=1, curve_i=pack((0, 1), (table.separate, 1), (table.clk, 3), (0, 48)) << 48 | sums)
    u.put(close_i=0)
    same("busy after close_i", await _idle(u, "busy_o") > 0, True)


def operation(rand: random.Random, table: Table) -> tuple[int, int | None]:
    """Return a rate and a number of pulses (None: endless) near a boundary between the kinds of profiles."""
    used = table.rates[table.first :]
    rate = rand.choice((table.high, rand.choice(used), rand.choice(used) + 1, rand.randint(2, 0xFFFF)))
    if rand.random() < 0.1:
        return rate, None
    plan = ramped(table, rate, None)
    full = plan.up + sum(table.pd[table.sd : table.stage(rate) + 1])
    one_sided = abs(sum(table.pa[: table.sd]) - sum(table.pd[: table.sa]))
    near = rand.choice((full, one_sided, rand.randint(1, max(full, 1)), rand.randint(1, max(full, 1)), 3))
    return rate, max(1, rand.choice((near + rand.randint(-2, 2), near, rand.getrandbits(32))))


@cocotb.test()
async def stage_plans_exact(dut):
    """For random curves, rates and pulse counts, the profiles and rate look-ups equal those of the model."""
    rand = rng()
    u = BlockDriver(dut, "unit", BLOCKS)
    await u.reset()
    kinds: dict[int, int] = {}
    for case in range(24):
        table = curves(rand)
        await _load(u, table)
        await _check(u, table, f"curve {case}", table.clk, (table.na, table.nd))
        for _ in range(14):
            rate, count = operation(rand, table)
            ramp = int(rand.random() < 0.9)
            steady = ((ramp, 1), (count is None, 1), (rate, 16), (count or rand.getrandbits(32), 32))
            await u.clk(profile_req_i=pack((1, 1), *steady))
            u.put(profile_req_i=pack((0, 1), *steady))
            took = await _idle(u, "plan_busy_o")
            where = f"curve {case} {brief(table)}, rate {rate}, {count} pulses"
            assert 0 < took <= LONGEST_PLAN, f"{where}: {took} cycles"
            got = u.get("profile_o")
            same(f"{where}: target", Target.split(got & (1 << 38) - 1), Target.of(table, rate))
            endless, climb = got >> 127, got >> 126 & 1
            same(f"{where}: endless", endless, count is None)
            plan = ramped(table, rate, count)
            if not ramp:
                same(f"{where}: climb, deceleration", (climb, got >> 70 & 0xFFFFFF), (0, 0))
                continue
            kind = 0 if count is None else plan.kind
            same(f"{where}: kind", u.get("plan_kind_o"), kind)
            kinds[kind] = kinds.get(kind, 0) + 1
            if count is None:
                same(f"{where}: climb", climb, plan.up > 0)
                continue
            same(f"{where}: count", got >> 94 & 0xFFFFFFFF, count)
            same(f"{where}: deceleration", got >> 70 & 0xFFFFFF, plan.down)
            if plan.down < count:
                same(f"{where}: climb", climb, plan.up > 0)
            if plan.down:
                stage, left = walk_start(table, plan.down)
                begin = got >> 38 & (1 << 32) - 1
                seen = (begin >> 25, begin & 0xFFFFFF if begin >> 24 & 1 else table.pd[begin >> 25])
                same(f"{where}: where it begins", seen, (stage, left))
    same("kinds of plans", sorted(kinds), [0x00, 0x10, 0x20, 0x40])
