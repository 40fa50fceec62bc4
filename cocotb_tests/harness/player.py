"""Executes the action list of a random host on a bench: the actions that all devices share.

Actions are tuples; the first element is the kind:

    ("write", reg, byte, strobe, gap)     one write access, not polled
    ("send", code, [data])                code and data, each polled until IBF = 0
    ("status", n)                         n status reads
    ("read",)                             one data read, regardless of OBF
    ("fetch", code, count)                read code, then count data reads (OBF polled, with a limit)
    ("wait", clk)                         wait for clk cycles
    ("pins", {pin: level})                set pins
    ("blip", pin, level, clk)             set a pin for clk cycles, then restore the idle level
    ("raw", [({pin: level}, clk), ...])   illegal bus accesses
    ("reset", clk)                        rst_n low for clk cycles

The player of a device adds ("finish", ...): wait for the end of motion, and stop it if that takes too long.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from .bus import BUSY, DATA, IBF, OBF, HostBus
from .config import Config
from .dut_bench import DutBench, PinChange

Action = tuple[Any, ...]

SETTING_CLK = 50_000
SETTING_CLK_DATASHEET = 1_300_000


@dataclass(frozen=True)
class ExternalClock:
    """Sequence of segments for a clock pin, each with five numbers.

    A segment is (number of periods, period, jitter, high time, pause after it), with times in cycles.
    """

    segments: tuple[tuple[int, int, int, int, int], ...] = ()

    def changes(self, pin: str, start: int, rng: random.Random) -> Iterator[PinChange]:
        """Yield the changes of the pin from edge `start` on; the jitter is drawn from `rng`."""
        t = start
        for count, period, jitter, high, pause in self.segments:
            for _ in range(count):
                yield t, {pin: 1}
                yield t + high, {pin: 0}
                t += period + rng.randint(-jitter, jitter)
            t += pause


def random_clock(rng: random.Random, scale: float, near: tuple[int, ...]) -> ExternalClock:
    """Return a steady clock, or one that jitters, pauses or changes its period (at least 16 cycles).

    Args:
        near: preferred periods in XTAL cycles.
        scale: number of cycles of `clk` per XTAL cycle.
    """
    segments, total = [], 0
    while total < 250_000:
        period = max(20, round(rng.choice(near) * scale) + rng.randint(-1, 1))
        jitter = rng.choice((0, 0, 0, 1, min(3, (period - 16) // 2)))
        count = rng.choice((5, 40, 200, 2000))
        high = rng.choice((2, period // 2, period // 2, period - jitter - 2))
        high = max(2, min(high, period - jitter - 2))
        pause = rng.choice((0, 0, 0, 300, 5_000))
        segments.append((count, period, jitter, high, pause))
        total += count * period + pause
    return ExternalClock(tuple(segments))


def pauses(rng: random.Random) -> Callable[[], int]:
    """Return a function that draws the idle cycles before an access: mostly 0, sometimes up to 60."""

    def pause() -> int:
        return 0 if rng.random() < 0.7 else rng.randint(1, rng.choice((3, 12, 60)))

    return pause


@dataclass(frozen=True)
class Scenario:
    """Stimulus of one random host: build, initial pin levels, actions, segments of each clock pin.

    If `pauses` is set, the host inserts idle cycles before accesses.
    """

    seed: int
    config: Config
    pins: dict[str, int]
    actions: list[Action]
    clocks: tuple[ExternalClock, ...]
    pauses: bool
    limit_clk: int = field(default=60_000)

    @property
    def clocked(self) -> bool:
        """Whether a clock pin is used."""
        return any(clock.segments for clock in self.clocks)


class Player:
    """Plays a scenario on a bench.

    When a poll reaches its time limit, the player continues, because a host may do so.
    """

    def __init__(self, bench: DutBench, scenario: Scenario) -> None:
        self.bench = bench
        self.scenario = scenario
        self.rng = random.Random(f"player {scenario.seed}")
        self.host = HostBus(bench, pause=pauses(self.rng) if scenario.pauses else None, timeout=400_000)

    async def run(self) -> None:
        """Execute all actions in order while the external clocks run."""
        bench, clocks = self.bench, self.scenario.clocks
        running = []
        for number, clock in enumerate(clocks, 1):
            if clock.segments:
                pin = f"{bench.part.clock}[{number}]" if len(clocks) > 1 else bench.part.clock
                seed = (number, self.scenario.seed) if len(clocks) > 1 else self.scenario.seed
                changes = clock.changes(pin, bench.now, random.Random(f"clock {seed}"))
                running.append(bench.drive(changes))
        for action in self.scenario.actions:
            await getattr(self, f"_{action[0]}")(*action[1:])
        await self.host.idle()
        await bench.clocks(20)
        for handle in running:
            handle.cancel()

    async def polled(self, mask: int, value: int, limit: int) -> bool:
        """Return whether the status has had this value within `limit` cycles."""
        try:
            await self.host.poll(mask, value, limit)
        except TimeoutError:
            return False
        return True

    async def _send(self, code: int, data: list[int]) -> None:
        limit = SETTING_CLK_DATASHEET if self.bench.config.datasheet else SETTING_CLK
        for reg, byte in [(1, code), *((0, byte) for byte in data)]:
            await self.host.write(reg, byte)
            if not await self.polled(IBF, 0, limit):
                return

    async def _write(self, reg: int, byte: int, strobe: int, gap: int) -> None:
        await self.host.write(reg, byte, strobe, gap)

    async def _status(self, count: int) -> None:
        for _ in range(count):
            await self.host.status()

    async def _read(self) -> None:
        await self.host.read(DATA)

    async def _fetch(self, code: int, count: int) -> None:
        await self._send(code, [])
        for _ in range(count):
            await self.polled(OBF, OBF, 40)
            await self.host.read(DATA)

    async def _wait(self, clk: int) -> None:
        await self.bench.clocks(clk)

    async def _pins(self, levels: dict[str, int]) -> None:
        await self.bench.align()
        self.bench.set(**levels)

    async def _blip(self, pin: str, level: int, clk: int) -> None:
        await self._pins({pin: level})
        await self.bench.clocks(clk)
        port, place = self.bench.part.locate(pin)
        idle = self.bench.part.inputs[port]
        await self._pins({pin: idle if place is None else idle >> place & 1})

    async def _raw(self, steps: list[tuple[dict[str, int], int]]) -> None:
        await self.bench.align()
        for levels, clk in steps:
            await self.host.raw(clk, **levels)

    async def _reset(self, clk: int) -> None:
        await self.bench.reset(clk)


def describe(actions: list[Action]) -> str:
    """Return the action list as text, one action per line."""
    return "\n".join(" ".join(str(part) for part in action) for action in actions)


class SinglePlayer(Player):
    """Plays one scenario: `await SinglePlayer(bench, scenario, rule).run()`.

    Adds the action ("finish", clk): poll until BUSY = 0; after clk cycles without success send 0x40, which
    must clear BUSY according to the rule.
    """

    def __init__(self, bench: DutBench, scenario: Scenario, rule: str) -> None:
        super().__init__(bench, scenario)
        self.rule = rule

    async def _finish(self, clk: int) -> None:
        if await self.polled(BUSY, 0, clk):
            return
        for _ in range(3):
            await self._send(0x40, [])
            if await self.polled(BUSY, 0, self.bench.config.us(1_000)):
                return
        raise AssertionError(f"{self.rule}: BUSY stays 1 after three stop commands\n{self.bench.context()}")
