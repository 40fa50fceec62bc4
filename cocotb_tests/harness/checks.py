"""Checks that several parts share: moves on an external clock, limit and alarm on the same edge."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, cycle, islice
from random import Random

from .axis_driver import NO_PULSES_DONE, AxisDriver, Ramp, differences, forced, indices, rates
from .dut_bench import DutBench

# Intervals of this number of cycles or more must be exact to the cycle (P104-BCK-05).
EXACT = 16
# If edges of the clock are at least this number of cycles apart, low times are also exact (chapter 9.2 of the
# manuals).
EXACT_LOW = 6
# If the clock period is below this number of crystal cycles, a pulse of rate 0 ends with the high time of the
# clock (P104-TIM-05).
BRISK = 128
# Reason why a `sweep` is not also compared with the golden model.
TOO_MANY = "each pulse is compared with the formula; 800,000 changes of a clock are too many for the model"

RateOf = Callable[[Ramp, Sequence[int]], list[int]]


@dataclass(frozen=True)
class Move:
    """A move of n pulses on `ramp` (RL, RH, PA), or at constant speed with `rate`.

    Attributes:
        gaps: numbers of cycles from edge to edge of the clock; the list is repeated indefinitely.
        high: high time of the clock in cycles.
        slowed: number of the pulse after which a slow-down limit is asserted (0: never).
    """

    n: int
    gaps: tuple[int, ...]
    high: int
    ramp: Ramp = (0, 0, 4)
    rate: int | None = None
    slowed: int = 0

    def rates(self, rate_of: RateOf) -> list[int]:
        """Return the rate of each interval."""
        if self.rate is not None:
            return [self.rate] * (self.n - 1)
        pa = self.ramp[2]
        return rate_of(self.ramp, forced(self.n, pa, self.slowed) if self.slowed else indices(self.n, pa))


@dataclass(frozen=True)
class Train:
    """A recorded move: edges of the clock, pulses, and low times if any.

    `edges` and `falls` are the times when the rising and falling edges of the clock take effect at the pins.
    """

    edges: list[int]
    falls: list[int]
    pulses: list[int]
    lows: list[int] | None


def faults(train: Train, rate_list: Sequence[int], w: int, brisk: int) -> Iterator[str]:
    """Yield each violation of the rules; `w` and `brisk` are CYC(80) and CYC(128).

    An interval whose length by the formula is EXACT or more must match the formula to the cycle. The low time
    at the start of such an interval must match, too; if edges are closer than EXACT_LOW, the low time may be
    longer, up to W. A shorter interval may be longer than the formula by whole base periods.
    """
    edges, pulses, lows = train.edges, train.pulses, train.lows
    at = [bisect_left(edges, t) for t in pulses]
    if len(pulses) != len(rate_list) + 1:
        yield f"{len(pulses)} pulses instead of {len(rate_list) + 1}"
        return
    if [edges[i] for i in at] != pulses:
        yield "a pulse is on no edge of the clock"
        return
    for j, (i, end, rate) in enumerate(zip(at, at[1:], rate_list, strict=False), 1):
        length = edges[i + rate + 1] - edges[i]
        if end - i < rate + 1 or (end - i > rate + 1 and length >= EXACT):
            yield f"interval {j} is {edges[end] - edges[i]} instead of {length} cycles"
        if lows and length >= EXACT:
            quick = rate == 0 and edges[i] - edges[i - 1] < brisk
            high = max(2, train.falls[i] - edges[i])
            cut = edges[i + (rate + 1) // 2] - edges[i] if rate else high if quick else w
            most = w if rate and min(differences(edges[i : end + 1])) < EXACT_LOW else cut
            if not min(w, cut) <= lows[j - 1] <= min(w, most):
                yield f"pulse {j} is low for {lows[j - 1]} instead of {min(w, cut)} cycles"
    if lows and lows[-1] != w:
        yield f"the last pulse is low for {lows[-1]} instead of {w} cycles"


class ExtMoves:
    """An axis whose external clock is driven edge by edge. Create one with `await ExtMoves.of(axis, …)`.

    Args:
        slow_pin: slow-down limit of the direction CW, active low.
        lows: True if the device has a pulse output.
        rate_of: function that returns the rates of ramp indices.
        delay: cycles from an edge at the clock pin to the pulse that it causes.
    """

    def __init__(self, axis: AxisDriver, slow_pin: str, lows: bool, rate_of: RateOf, delay: int) -> None:
        self.axis = axis
        self.slow_pin = slow_pin
        self.lows = lows
        self.rate_of = rate_of
        self.delay = delay

    @classmethod
    async def of(
        cls, axis: AxisDriver, ramp: Ramp, slow_pin: str, lows: bool = True, rate_of: RateOf = rates
    ) -> ExtMoves:
        """Return an object for this axis, whose `delay` was measured with a move on the active ramp.

        The delay is 2 to 3 cycles until an edge acts, plus the delay to the pin.
        """
        moves = cls(axis, slow_pin, lows, rate_of, 0)
        train = await moves._train(Move(2, (64,), 32, ramp))
        moves.delay = train.pulses[0] - max(t for t in train.edges if t < train.pulses[0] - 1)
        axis.window("P104-BCK-04", "an edge of the clock to its pulse", moves.delay, 2, 5)
        return moves

    async def check(self, move: Move) -> None:
        """Make the move and check it against the rules.

        With JITTER=1, moves with a slow-down limit are omitted: it may act before either of two edges.
        """
        axis = self.axis
        if move.slowed and axis.bench.slack:
            return
        train = await self._train(move)
        found = list(faults(train, move.rates(self.rate_of), axis.cfg.w, axis.cfg.cyc(BRISK)))
        axis.check("BCK-05", f"{move}: intervals {differences(train.pulses)}", found, [])

    async def _train(self, move: Move) -> Train:
        axis, bench = self.axis, self.axis.bench
        expected = move.rates(self.rate_of)
        await axis.go(0x43 if move.rate is None else 0x44, move.n, move.rate)
        # Enough edges for the set-up time, and for short intervals, which may be longer than the formula
        # states.
        count = axis.cfg.w // min(move.gaps) + sum(expected) + 8 * move.n + 8
        start = await bench.align() + 1
        rises = list(accumulate(islice(cycle(move.gaps), count), initial=start))
        clock = bench.drive(
            (t + after, {axis.clock: level}) for t in rises for after, level in ((0, 1), (move.high, 0))
        )
        if move.slowed:
            await axis.pulse(move.slowed)
            bench.set(**{self.slow_pin: 0})
        await clock
        await bench.until(rises[-1] + move.gaps[0])
        await axis.idle()
        bench.set(**{self.slow_pin: 1})
        edges = [t + self.delay for t in bench.pin_edges(axis.clock, 1, start)]
        falls = [t + self.delay for t in bench.pin_edges(axis.clock, 0, start)]
        return Train(edges, falls, axis.pulses, axis.low_times if self.lows else None)


def sweep(ramp: Ramp, rng: Random, rate_of: RateOf = rates) -> Iterator[Move]:
    """Yield moves on a ramp with edges 4 to 17 cycles apart; some moves have a plateau or a slow-down limit.

    N determines where a move begins to decelerate and whether it holds its index before that (P104-PRO-03). A
    slow-down limit occurs where the move can still decelerate.
    """
    rl, _, pa = ramp
    fast = [j for j in range(2, pa + 3) if rate_of(ramp, [min(j - 1, pa)]) != [rl]]
    for period in range(4, 18):
        for n in range(2, 2 * pa + 5):
            yield Move(n, (period,), rng.randint(2, period - 2), ramp)
        if fast:
            yield Move(99, (period,), 2, ramp, slowed=rng.choice(fast))
        uneven = tuple(rng.randint(period, 2 * period) for _ in range(7))
        yield Move(rng.randint(2, 2 * pa + 4), uneven, rng.randint(2, period - 2), ramp)


def shortest_levels(ramp: Ramp, rng: Random) -> Iterator[Move]:
    """Yield moves on a ramp with an external clock that the device samples high or low for 1, 2 or 3 cycles.

    A pin level of 2 cycles, the shortest that P104-BCK-04 permits, may be sampled as 1 to 3 cycles.
    """
    pa = ramp[2]
    for period in (EXACT, EXACT + 8, BRISK - 8):
        for level in (1, 2, 3):
            for high in (level, period - level):
                for n in (pa, pa + 1, 2 * pa + 4):
                    yield Move(n, (period,), high, ramp)
                yield Move(5, (period,), high, rate=rng.choice((0, 1)))


async def clock_delays(axis: AxisDriver, code: int = 0x44, rate: int | None = 0) -> list[int]:
    """Return, for each of 40 pulses, the cycles from the edge of the external clock pin to the pulse."""
    await axis.go(code, 40, rate)
    rises = []
    while len(axis.pulses) < 40:
        rises.append(await axis.bench.align())
        await axis.ticks(1, 32)
    await axis.idle()
    return [t - max(edge for edge in rises if edge < t) for t in axis.pulses]


def check_delays(bench: DutBench, rule: str, what: str, delays: Sequence[int], low: int, high: int) -> None:
    """Check that the delays from pin changes to their effects are equal, and `low` to `high` cycles.

    With JITTER=1, two delays that differ by one cycle must occur instead.
    """
    spread = max(delays) - min(delays)
    bench.check(rule, f"difference of the delays {what}", spread, bench.slack)
    bench.check_window(rule, f"shortest delay {what}", min(delays), low, high)


def check_intervals(bench: DutBench, rule: str, intervals: Sequence[int], expected: Sequence[int]) -> None:
    """Check intervals of outputs that follow the edges of a clock pin.

    With JITTER=1, each interval may differ by one cycle.
    """
    wrong = [
        f"{got} instead of {want} cycles"
        for got, want in zip(intervals, expected, strict=False)
        if abs(got - want) > bench.slack
    ]
    bench.check(rule, f"{len(expected)} intervals", (len(intervals), wrong), (len(expected), []))


BOTH = 0xB0
"""Bits of the finish status after a limit and an alarm have ended an operation; without its code."""
MOVES = (
    (0x43, 24, None, (2, 10, 22)),
    (0x44, 24, 9, (6,)),
    (0x45, None, 9, (6,)),
    (0x46, None, None, (2, 10)),
    (0x47, None, 9, (6,)),
)
"""Operation code, number of pulses, rate, and the numbers of the pulses after which both causes occur.

These pulses lie in the acceleration, the constant speed and the deceleration of a ramp of 4 steps.
"""


async def two_causes(axis: AxisDriver, rule: str, pins: Sequence[str]) -> None:
    """Check that limit and alarm on the same edge are both reported, for all CW operations.

    Args:
        pins: names of the limit pin and the alarm pin on the bench, both active low.
    """
    for code, n, rate, places in MOVES:
        for made in places:
            await axis.go(code, n, rate)
            await axis.pulse(made, 100)
            axis.bench.set(**dict.fromkeys(pins, 0))
            await axis.idle()
            axis.bench.set(**dict.fromkeys(pins, 1))
            what = f"{rule}: {code:#x} after pulse {made}"
            await axis.result(what, made, BOTH | code & 7, (n or NO_PULSES_DONE) - made - 1)
