"""Contract of ppmc312_stage_seq: it outputs the rate of the next pulse, or the reason why no pulse
follows.
"""

from __future__ import annotations

import random
from collections import deque

import cocotb

from openppmc.model.ppmc312.codes import Cause
from openppmc.model.ppmc312.motion.sequence import Change, Sequence
from openppmc.model.ppmc312.stages import STAGES, Plan, Table, constant, curve, ramped

from ...harness import BlockDriver, rng, same
from . import stage_types
from .stage_types import Target, brief, pack, walk_start

AREA, GROUPS, BLOCKS = stage_types.AREA, stage_types.GROUPS, stage_types.BLOCKS
LEADS = {"slow": 2, "jump": 5, "ramp": 9}
"""Minimum number of cycles before a boundary at which a request takes effect at this boundary."""
SHORTEST, TARGET_CLK = 4, 2
"""Cycles: minimum length of an interval; time from change_i to the edge that samples the target in
profile_i.
"""
FLAT, SEARCH, FOUND = 7, 129, 3
"""Cycles of constant rate before a ramp can begin; length of a search in cycles; cycles from the end of a
search to the final deceleration.
"""
WATCH = "next_end_o next_low_o next_count_o next_rate_o"


def small_curve(rand: random.Random) -> Table:
    """Return a curve of a few stages with a few pulses each.

    In most curves, the rates are sorted, fastest first. In half of the curves, neighbouring rates may be
    equal. The two ramps may differ.
    """
    counts = [rand.choice((2, 3, 5)), rand.choice((2, 3, 4))]
    split = rand.random() < 0.7
    most = max(counts) if split else counts[0]
    rates = sorted(rand.sample(range(2, 400), most))
    if rand.random() < 0.5:
        rates = sorted(rand.choices(rates, k=most))
    if rand.random() < 0.25:
        rand.shuffle(rates)
    pulses = [[rand.randint(2, 6) for _ in range(count)] for count in counts]
    return curve(rates, pulses[0], pulses[1] if split else None)


def some_rate(rand: random.Random, table: Table) -> int:
    """Return a rate that an instruction may request, often a rate that is in the table, or a neighbouring
    value.
    """
    low, high = sorted((table.high, table.slowest))
    near = rand.choice(table.rates[table.first :]) + rand.choice((0, 0, 1, -1))
    return rand.choice((min(max(near, low), high), rand.randint(low, high)))


class SequencerRun:
    """The sequencer during a motion, with a table that returns data two cycles after the address."""

    def __init__(self, u: BlockDriver, table: Table, plan: Plan, rand: random.Random) -> None:
        self.u, self.table, self.plan, self.rand = u, table, plan, rand
        self.reads = deque([(0, 0), (0, 0)])
        self.sequence = Sequence(plan)
        self.history: list[str] = []
        self.busy = rand.choice((0.1, 0.4))
        self.flat_for, self.slow, self.searched = SEARCH, 0, 0
        self.what = f"{brief(table)}: {plan.n} pulses at {plan.rate}, {plan.up} up, {plan.down} down"

    async def clk(self, **inputs: int) -> tuple[int, ...]:
        """Run one cycle; return the watched outputs before its edge."""
        out = await self.sample(**inputs)
        self.reads.popleft()
        self.reads.append(divmod(self.u.get("table_addr_o"), 128))
        await self.u.clk()
        return out

    async def sample(self, **inputs: int) -> tuple[int, ...]:
        """Apply the inputs and the data that the table returns in this cycle; return the watched outputs."""
        side, i = self.reads[0]
        table, i = self.table, min(i, STAGES - 1)
        pulses = table.pd if side else table.pa
        self.u.put(stage_i=pack((table.rates[i], 16), (pulses[i], 24)))
        return await self.u.settle(**inputs)

    async def load(self) -> None:
        """Load the operation and wait until its first pulse is prepared."""
        table, plan = self.table, self.plan
        self.u.put(first_acc_i=table.sa, first_dec_i=table.sd, rate_dec_i=table.rates[table.sd])
        self.u.put(slow_i=0, change_i=0)
        stage, left = walk_start(table, plan.down) if plan.down else (0, 0)
        part = int(plan.down > 0 and left != table.pd[stage])
        walk = ((plan.down, 24), (stage, 7), (part, 1), (left * part, 24))
        target = Target.of(table, plan.rate).packed
        begin = pack((plan.n is None, 1), (plan.up > 0, 1), (plan.n or 7, 32), *walk, (target, 38))
        await self.clk(load_i=1, profile_i=begin)
        self.u.put(load_i=0, profile_i=self.plan_word(0))
        for _ in range(12):
            await self.clk()

    def plan_word(self, target: int) -> int:
        """Return profile_t for the time after the load, when only its target is used."""
        return self.rand.getrandbits(90) << 38 | target

    def plan_requests(self) -> dict[int, str]:
        """Return the requests in the next interval; each key is the time before the end of the interval in
        cycles.
        """
        rand, found = self.rand, {}
        if rand.random() < 0.08:
            found[LEADS["slow"] + rand.choice((0, 0, 1, 7))] = "slow"
        if rand.random() < self.busy:
            flat = self.sequence.present.stage is None
            what = rand.choice(["jump"] + ["ramp"] * (flat or self.sequence.running is not None))
            lead = LEADS[what] + rand.choice((0, 0, 1, 6))
            found[lead if lead not in found else lead + 1] = what
        return found

    def aim(self) -> int:
        """Return the rate that a change requests."""
        return some_rate(self.rand, self.table)

    async def interval(self) -> None:
        """Run all cycles of an interval except the last."""
        requests = self.plan_requests()
        longest = max([SHORTEST, *(lead + 3 for lead in requests)]) + self.rand.choice((0, 0, 1, 5))
        if self.sequence.was_searched and self.rand.random() < 0.3:
            # The boundary is either in the last cycle in which it cannot use the result of the search, or one
            # cycle later.
            cycles = SEARCH + self.rand.choice((FLAT, FOUND)) + self.rand.choice((-1, 0))
            longest = max(longest, cycles - self.flat_for)
        self.flat_for += longest
        slow, target = self.slow, {}
        for left in range(longest - 1, 0, -1):
            what = requests.get(left)
            if what:
                self.history.append(f"{what} after pulse {self.sequence.done}")
            if what == "slow":
                slow = 1
                self.sequence.request(Cause.SLOW)
            elif what:
                rate = self.aim()
                self.history[-1] += f" to {rate}"
                self.sequence.change(Change(rate, what == "ramp"))
                plan = self.plan_word(Target.of(self.table, rate).packed)
                target = {left - TARGET_CLK: {"profile_i": plan, "change_ramp_i": what == "ramp"}}
            self.u.put(
                profile_i=self.plan_word(self.rand.getrandbits(38)), change_ramp_i=self.rand.randrange(2)
            )
            await self.clk(slow_i=slow, change_i=bool(what) and what != "slow", **target.get(left, {}))
        self.u.put(change_i=0)

    async def run(self, limit: int = 200) -> str:
        """Output all pulses; return the reason why they end."""
        for _ in range(limit):
            await self.interval()
            where = f"{self.what}, {self.history}, boundary {self.sequence.done + 1}"
            end, low, count, rate = await self.sample()
            self.slow = self.u.get("slow_i") and not self.u.get("next_slow_o")
            flat_for = self.flat_for - SEARCH * self.sequence.was_searched
            was_stage = self.sequence.in_table
            want = self.sequence.boundary(flat_for >= FLAT, flat_for >= FOUND)
            if isinstance(want, Cause):
                why = (1, want is Cause.LOW, want is Cause.NORMAL)
                same(f"{where}: end, low, count", (end, low, count), why)
                return want.name
            same(f"{where}: end, rate", (end, rate), (0, want.rate))
            if was_stage and want.stage is None:
                self.flat_for = 0
            self.searched += self.sequence.was_searched
            await self.clk(step_i=1)
            self.u.put(step_i=0, slow_i=0)
            await self.u.settle()
            got = [self.u.get(name) for name in ("rate_o", "const_rate_o", "first_o", "complete_o")]
            same(f"{where}: rate, flat", got, [want.rate, want.stage is None, 0, self.sequence.complete])
        return "endless"


def some_plan(rand: random.Random, table: Table) -> Plan:
    """Return the plan of instruction 82, 83, 85 or 86 with a number of pulses near the interesting limits."""
    rate = some_rate(rand, table)
    most = table.na + table.nd + 12
    n = rand.choice((None, rand.randint(1, most), rand.randint(1, most), rand.randint(1, 4)))
    return ramped(table, rate, n) if rand.random() < 0.7 else constant(table, rate, n)


@cocotb.test()
async def stage_seq_walks(dut):
    """For random curves, operations and requests, each pulse and the end equal those of the model."""
    rand = rng()
    u = BlockDriver(dut, "seq", BLOCKS, WATCH)
    await u.reset()
    ends: dict[str, int] = {}
    for _ in range(220):
        table = small_curve(rand)
        run = SequencerRun(u, table, some_plan(rand, table), rand)
        await run.load()
        end = await run.run(60)
        ends[end] = ends.get(end, 0) + 1
    same("ends that occurred", sorted(ends), ["LOW", "NORMAL", "SLOW", "endless"])


class CollisionRun(SequencerRun):
    """A ramp of instruction 87 reaches the deceleration point; random requests follow."""

    def plan_requests(self) -> dict[int, str]:
        """Request instruction 88 (change) some pulses before the deceleration point, and 87 (ramp) closer to
        it.
        """
        plan = self.plan
        before = (plan.n or 0) - plan.down - self.sequence.done
        if before in (self.jump, self.ramp):
            return {LEADS["ramp"]: "jump" if before == self.jump else "ramp"}
        return {} if 0 < before else super().plan_requests()

    def aim(self) -> int:
        """Return the rate of the next request.

        It is the rate of the first stage, so that a later ramp has stages, or the high speed for the ramp
        itself. Sometimes, and after the two requests, it is the rate that the base class returns.
        """
        before = (self.plan.n or 0) - self.plan.down - self.sequence.done
        if self.rand.random() < 0.2 or before < 1:
            return super().aim()
        return self.table.high if before == self.ramp else self.table.rates[self.table.first]

    @classmethod
    def some(cls, u: BlockDriver, rand: random.Random) -> CollisionRun:
        """Return a table and an operation whose deceleration has enough pulses for several requests."""
        while True:
            table = small_curve(rand)
            rate = some_rate(rand, table)
            plan = ramped(table, rate, None)
            n = plan.up + sum(table.pd[table.sd : table.stage(rate) + 1]) + rand.randint(12, 18)
            plan = ramped(table, rate, n)
            if plan.down > 3 and table.sd >= table.sa + rand.randrange(3):
                # in many of these tables, the first stages belong only to the acceleration ramp, so no final
                # deceleration starts in them
                break
        run = cls(u, table, plan, rand)
        run.jump, run.ramp, run.busy = rand.randint(6, 10), rand.randint(1, 5), 0.4
        return run


@cocotb.test()
async def stage_seq_searches(dut):
    """When a ramp ends and the rate of its last stage becomes constant, t(rate) is found in time for the
    requests that follow.
    """
    rand = rng()
    u = BlockDriver(dut, "seq", BLOCKS, WATCH)
    await u.reset()
    searched = 0
    for _ in range(240):
        run = CollisionRun.some(u, rand)
        await run.load()
        await run.run(120)
        searched += run.searched
    assert searched > 100, f"a search ran in {searched} intervals only"


class LateStopRun(SequencerRun):
    """A change is decided during a search, and a deceleration stop follows.

    In the acceleration ramp, the rate of a stage becomes constant. Instruction 88 is decided during the
    search for t of this rate, and instruction 81 arrives before the boundary.
    """

    def plan_requests(self) -> dict[int, str]:
        """Request instructions 88 and 87, which begin the search, then 88 and 81 during the search."""
        if self.sequence.was_searched and self.jump:
            requests = {self.jump: "jump", LEADS["slow"]: "slow"}
            self.jump = 0
            return requests
        return {37: {LEADS["jump"]: "jump"}, 44: {LEADS["ramp"]: "ramp"}}.get(self.sequence.done, {})

    def aim(self) -> int:
        """Return a rate that is slower than all stages, then the rate of the first stage."""
        return 169 if self.sequence.done == 44 else 363


@cocotb.test()
async def stage_seq_stop_during_a_search_for_a_change(dut):
    """If a search has ended, instruction 81 discards an instruction 88 that was decided during this search.

    If the search has not ended, instruction 81 waits until instruction 88 has taken effect.
    """
    rand = rng()
    u = BlockDriver(dut, "seq", BLOCKS, WATCH)
    await u.reset()
    table = curve([169, 250, 332, 169, 363], [5, 5, 6, 6, 6], [4, 2])
    ends = set()
    for before in (*range(-8, 4), 40):
        run = LateStopRun(u, table, ramped(table, 169, 52), rand)
        run.jump = SEARCH + FOUND + before
        await run.load()
        end = await run.run(80)
        ends.add((end, run.searched > 0))
    # If instruction 81 waits for instruction 88, the rate 363 is loaded, at which no deceleration is left;
    # the final deceleration then lasts until the end of the count.
    same("ends, each behind a search", sorted(ends), [("LOW", True), ("NORMAL", True)])
