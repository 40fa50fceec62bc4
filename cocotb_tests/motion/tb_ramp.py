"""Contracts of the ramp: ppmc_ramp_builder (with ppmc_ramp_serial), ppmc_ramp_table(s), ppmc_ramp_seq."""

from __future__ import annotations

import random
from collections import deque

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, First, ReadOnly, RisingEdge, Timer
from cocotb.utils import get_sim_time

from openppmc.model.motion.ramp import natural_deceleration, next_index, ramp_rate

from ..harness import Block, BlockDriver, rng, same

BUILD_PORTS = "start_i slow_i:8 fast_i:8 steps_i:{0} busy_o we_o addr_o:8 data_o:{0}"
BLOCKS = {
    **{
        f"build{bits}": Block(
            "ppmc_ramp_builder", BUILD_PORTS.format(bits), {"RateBits": 8, "StepBits": bits}
        )
        for bits in (14, 16)
    },
    "table": Block(
        "ppmc_ramp_table",
        "start_i slow_i:8 fast_i:8 steps_i:14 busy_o slow_o:8 fast_o:8 steps_o:14 addr_i:8 data_o:14",
        {"RateBits": 8, "StepBits": 14},
    ),
    "tables": Block(
        "ppmc_ramp_tables",
        "start_i:2 slow_i:16 fast_i:16 steps_i:28 busy_o:2 addr_i:16 data_o:28",
        {"RateBits": 8, "StepBits": 14},
    ),
    "seq": Block(
        "ppmc_ramp_seq",
        "slow_i:8 fast_i:8 lut_addr_o:8 lut_data_i:14 load_i count_i:24 single_i rate_i:8 ramp_i"
        " pulse_i forced_i rate_o:8 lookup_busy_o rising_o last_o final_o top_o at_start_rate_o dec_o"
        " left_o:24",
        {"CountBits": 24, "RateBits": 8, "StepBits": 14, "LutBits": 14},
    ),
    # A step number has one bit more than a word of the table. This is necessary for the longest ramp that the
    # table can store.
    "wide": Block(
        "ppmc_ramp_seq",
        "slow_i:8 fast_i:8 lut_addr_o:8 lut_data_i:4 load_i count_i:24 single_i rate_i:8 ramp_i"
        " pulse_i forced_i rate_o:8 lookup_busy_o rising_o last_o final_o top_o at_start_rate_o dec_o"
        " left_o:24",
        {"CountBits": 24, "RateBits": 8, "StepBits": 5, "LutBits": 4},
    ),
}
LONGEST_BUILD = 40_000
# (slow, fast, steps). In the ramp (4, 0, 8), rounding is a tie (P104-RMP-03).
CORNERS = [
    (255, 0, 1),
    (255, 0, 4),
    (255, 254, 4),
    (1, 0, 4),
    (1, 0, 11220),
    (4, 0, 8),
    (2, 1, 7),
    (128, 127, 1000),
    (254, 0, 11220),
]


def threshold(slow: int, fast: int, steps: int, r: int) -> int:
    """Return the number of the first step whose rate is below r, by bisection of the model's exact rates."""
    low, high = 0, steps  # rate(high) < r <= rate(low)
    while high - low > 1:
        middle = (low + high) // 2
        if ramp_rate(slow, fast, steps, middle) < r:
            high = middle
        else:
            low = middle
    return high


def table(slow: int, fast: int, steps: int) -> dict[int, int]:
    """Return the complete table: r -> thr(r), and the last rate of the ramp -> PA."""
    return {fast: steps, **{r: threshold(slow, fast, steps, r) for r in range(fast + 1, slow + 1)}}


def triples(rand: random.Random, bits: int, count: int) -> list[tuple[int, int, int]]:
    """Return corner cases, the longest ramps for words of `bits` bits, and random ramps, most of them
    short.
    """
    top = 11_220 if bits == 14 else 65_535
    found = [*CORNERS, (255, 0, top), (255, 254, top), (200, 3, top)]
    while len(found) < len(CORNERS) + 3 + count:
        slow = rand.randint(1, 255)
        found.append((slow, rand.randint(0, slow - 1), min(top, int(2 ** rand.uniform(0, bits)))))
    return found


async def _build(u: BlockDriver, slow: int, fast: int, steps: int) -> tuple[dict[int, int], int]:
    """Build one table with a free-running clock.

    Return (words written, cycles from the start to the fall of busy_o).
    """
    busy, enable = u.pins["busy_o"], u.pins["we_o"]
    await u.clk(start_i=1, slow_i=slow, fast_i=fast, steps_i=steps)
    same("busy_o after the start", await u.settle(start_i=0), 1)
    written: dict[int, int] = {}
    clock = Clock(u.pins["clk_i"], 2, "step", impl="gpi")
    clock.start()
    since = get_sim_time("step")
    while True:
        await First(RisingEdge(enable), FallingEdge(busy))
        await ReadOnly()
        if not u.get("busy_o"):
            break
        r = u.get("addr_o")
        assert r not in written, f"{(slow, fast, steps)}: {r} is written twice"
        written[r] = u.get("data_o")
    took = (get_sim_time("step") - since) // 2 + 1
    clock.stop()
    await Timer(1, "step")
    await u.settle(clk_i=0)
    return written, took


@cocotb.test()
@cocotb.parametrize(bits=[14, 16])
async def ramp_builder_exact(dut, bits):
    """For corner-case and random ramps, every threshold is exact, and no build exceeds its maximum time."""
    u = BlockDriver(dut, f"build{bits}", BLOCKS, "busy_o", BlockDriver.FREE)
    await u.reset()
    longest = 0
    for triple in triples(rng(), bits, 30):
        got, took = await _build(u, *triple)
        want = table(*triple)
        wrong = {r: (got.get(r), want.get(r)) for r in got | want if got.get(r) != want.get(r)}
        same(f"(slow, fast, steps) {triple}: r -> (got, want)", wrong, {})
        assert took <= LONGEST_BUILD, f"{triple}: {took} cycles"
        longest = max(longest, took)
    same("PA alone for equal rates", (await _build(u, 77, 77, 100))[0], {77: 100})
    cocotb.log.info("longest build of %d bits: %d clk", bits, longest)


@cocotb.test()
async def ramp_table_read(dut):
    """After a build, thr(r) is valid two cycles after its address, together with the values of the ramp; this
    also holds after further builds.
    """
    u = BlockDriver(dut, "table", BLOCKS, "busy_o data_o slow_o fast_o steps_o")
    await u.reset()
    for slow, fast, steps in ((40, 5, 300), (30, 22, 9), (77, 77, 100)):
        await u.clk(start_i=1, slow_i=slow, fast_i=fast, steps_i=steps)
        clk = 0
        while (await u.clk(start_i=0))[0]:
            clk += 1
            assert clk <= LONGEST_BUILD
        u.put(slow_i=1, fast_i=2, steps_i=3)
        want = table(slow, fast, steps)
        order = list(want)
        rng().shuffle(order)
        got = [(await u.clk(addr_i=r))[1:] for r in [*order, 0, 0]]
        same("table, numbers", got[2:], [(want[r], slow, fast, steps) for r in order])


def build_clk(slow: int, fast: int) -> int:
    """Return the cycles from start_i to the fall of busy_o of ppmc_ramp_tables while the builder is free."""
    return 1955 + 136 * (slow - fast)


@cocotb.test()
async def ramp_tables_shared(dut):
    """If two axes request ramps at any times, each axis gets its table; the tables are built one after the
    other.
    """
    rand = rng()
    u = BlockDriver(dut, "tables", BLOCKS, "busy_o data_o")
    await u.reset()
    ramps = [(3, 1, 25), (3, 1, 25)]
    for case in range(9):
        first, gap = rand.randrange(2), (0, 1, 300, 2)[case % 4]
        new = list(ramps)
        for n in (0, 1) if case % 4 < 3 else (first,):
            slow = rand.randint(2, 30)
            new[n] = (slow, rand.randint(0, slow - 2), rand.randint(4, 11_220))
        ramps = new
        pins = {
            name: sum(ramps[n][at] << width * n for n in (0, 1))
            for at, (name, width) in enumerate((("slow_i", 8), ("fast_i", 8), ("steps_i", 14)))
        }
        start, due = {0: 1 << first}, [0, 0]
        due[first] = build_clk(*ramps[first][:2])
        if case % 4 < 3:
            other = 1 - first
            if gap == 0:  # both on the same edge: axis 1 is first
                first, other, start = 0, 1, {0: 3}
                due[first] = build_clk(*ramps[first][:2])
            else:
                start[gap] = 1 << other
            due[other] = due[first] + build_clk(*ramps[other][:2])
        for t in range(max(due) + 3):
            busy, _ = await u.clk(start_i=start.get(t, 0), **pins)
            begun = sum(bits for at, bits in start.items() if at < t)
            want = sum(1 << n for n in (0, 1) if begun >> n & 1 and t <= due[n])
            same(f"case {case}, {ramps}, {gap} cycles apart, cycle {t}: busy_o", busy, want)
        tables = [table(*ramp) for ramp in ramps]
        rates = [list(one) for one in tables]
        for k in range(max(map(len, rates))):
            r = [rates[n][k % len(rates[n])] for n in (0, 1)]
            await u.clk(addr_i=r[0] | r[1] << 8)
            await u.clk()
            _, data = await u.clk()
            want = [tables[n][r[n]] for n in (0, 1)]
            same(f"case {case}: thresholds of {r}", [data & 0x3FFF, data >> 14], want)


class Walker:
    """The sequencer with a look-up table that returns data two cycles after the address."""

    def __init__(self, u: BlockDriver, slow: int, fast: int, steps: int, blank: int = 0x2AAA) -> None:
        """Set the ramp. `blank` is the data for rates that the table does not contain."""
        self.u, self.ramp, self.blank = u, (slow, fast, steps), blank
        self.lut = table(slow, fast, steps)
        self.requested = deque([0, 0])

    async def clk(self, **inputs: int) -> tuple[int, ...]:
        """Make one cycle and return the watched outputs before its edge."""
        answer = self.lut.get(self.requested.popleft(), self.blank)
        out = await self.u.settle(lut_data_i=answer, **inputs)
        self.requested.append(self.u.get("lut_addr_o"))
        await self.u.clk()
        return out

    async def move(self, rand: random.Random, n: int, forced_at: int) -> None:
        """Make n pulses, with a deceleration request at pulse `forced_at`.

        With `forced_at` = 0 the request is before pulse 1; with a value above n there is no request.
        """
        slow, fast, steps = self.ramp
        where = f"{self.ramp}, {n} pulses, forced at {forced_at}"
        self.u.put(slow_i=slow, fast_i=fast, ramp_i=1, forced_i=0)
        await self.clk(load_i=1, count_i=n - 1, single_i=0, rate_i=slow)
        self.u.put(load_i=0)
        kp, dec, turned = -1, False, False
        for j in range(1, n + 1):
            early = j == forced_at and rand.random() < 0.5
            if early or forced_at == 0:
                self.u.put(forced_i=1)
            rest = 0
            while rest < 3 + rand.randrange(3):
                rate, lookup_busy, *_, rising = await self.clk()
                if kp >= 0 and not rising:
                    same(f"{where}, pulse {j}: rate when final", rate, ramp_rate(slow, fast, steps, kp))
                rest = 0 if lookup_busy else rest + 1
            forced = j >= forced_at
            rate, lookup_busy, last, final, top, slows, left, _ = await self.u.settle(forced_i=forced)
            at_start_rate = self.u.get("at_start_rate_o")
            k = next_index(kp, n - j, steps, forced)
            at = f"{where}, pulse {j}"
            same(f"{at}: lookup_busy, last, final", (lookup_busy, last, final), (0, k is None, j == n))
            same(f"{at}: left", left, n - j)
            same(f"{at}: top", top, kp == steps)
            if not forced:
                same(f"{at}: natural deceleration", slows, dec)
                if not dec:
                    want = kp < 0 or ramp_rate(slow, fast, steps, kp) == slow
                    same(f"{at}: still at the start-up rate", at_start_rate, want)
            if kp >= 0:
                same(f"{at}: rate of index {kp}", rate, ramp_rate(slow, fast, steps, kp))
            await self.clk(pulse_i=1)
            rate, *_, left, rising = await self.u.settle(pulse_i=0)
            same(f"{at}: left after it", left, max(n - j - 1, 0))
            if k is None:
                return
            first_down = k < kp and not turned
            turned = turned or k < kp
            if first_down:
                same(f"{at}: the rate of index {k} is on its way", rising, 1)
                await self.clk()
                rate, *_, rising = await self.u.settle()
            if k >= kp or first_down:
                want = (ramp_rate(slow, fast, steps, k), 0)
                same(f"{at}: rate of index {k} at once, rising", (rate, rising), want)
            dec = dec or natural_deceleration(kp, n - j, steps)
            kp = k
        raise AssertionError(f"{where}: no last pulse")


@cocotb.test()
async def ramp_seq_walks(dut):
    """For random ramps, pulse counts and times of stops, the rates and the counts are those of the model."""
    rand = rng()
    u = BlockDriver(dut, "seq", BLOCKS, "rate_o lookup_busy_o last_o final_o top_o dec_o left_o rising_o")
    await u.reset()
    for case in range(60):
        steps = rand.randint(4, 24)
        slow = rand.choice((1, 9, 40, 40, 120, 255)) if case else 255
        walker = Walker(u, slow, rand.randint(0, slow) if case else 0, steps)
        n = rand.choice((1, 2, 3, steps, 2 * steps, 2 * steps + 1, 2 * steps + 2, 2 * steps + 3, 3 * steps))
        await walker.move(rand, n, rand.choice((n + 1, n + 1, 0, rand.randint(1, n))))


@cocotb.test()
async def ramp_seq_longest(dut):
    """A move on the longest ramp that the table can store has the correct rates in all three phases."""
    rand = rng()
    u = BlockDriver(dut, "wide", BLOCKS, "rate_o lookup_busy_o last_o final_o top_o dec_o left_o rising_o")
    await u.reset()
    for n, forced_at in ((33, 34), (40, 41), (60, 25), (31, 32), (60, 17)):
        slow = rand.choice((20, 90, 254))
        await Walker(u, slow, rand.randint(0, slow - 1), 15, 0xA).move(rand, n, forced_at)


@cocotb.test()
async def ramp_seq_constant(dut):
    """For constant speed and single steps, the rate is the loaded rate, and each pulse decreases the count of
    remaining pulses by one.
    """
    rand = rng()
    u = BlockDriver(dut, "seq", BLOCKS, "rate_o lookup_busy_o last_o final_o top_o dec_o left_o rising_o")
    await u.reset(slow_i=200, fast_i=10, ramp_i=0)
    for n, single in ((1, 0), (2, 0), (40, 0), (16_777_216, 1), (70_000, 0)):
        rate = rand.getrandbits(8)
        await u.clk(load_i=1, count_i=n - 1, rate_i=rate, single_i=single)
        n = 1 if single else n
        for j in range(1, min(n, 100) + 1):
            for _ in range(3):
                await u.clk(load_i=0, pulse_i=0)
            want = (rate, 0, j == n, j == n, 0, 0, n - j, 0)
            same(f"pulse {j} of {n}", await u.clk(pulse_i=1), want)
        await u.clk(pulse_i=0)
