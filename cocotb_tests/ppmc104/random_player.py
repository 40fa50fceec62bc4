"""Carries out the action list of `random_host` on a bench."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator

import cocotb

from cocotb_tests.common.bench import Bench
from cocotb_tests.common.bus import BUSY, DATA, IBF, OBF, HostBus
from cocotb_tests.common.part import PPMC104
from cocotb_tests.ppmc104.random_host import Action, ExternalClock, Scenario


def pauses(rng: random.Random) -> Callable[[], int]:
    """Idle clk before an access: mostly none, sometimes up to 60."""

    def pause() -> int:
        return 0 if rng.random() < 0.7 else rng.randint(1, rng.choice((3, 12, 60)))

    return pause


def clock_levels(clock: ExternalClock, rng: random.Random) -> Iterator[tuple[int, int]]:
    """(clk to wait, level) of the external clock pin; its jitter is drawn from `rng`."""
    for count, period, jitter, high, pause in clock.segments:
        for _ in range(count):
            length = period + rng.randint(-jitter, jitter)
            yield 0, 1
            yield high, 0
            yield length - high, -1
        yield pause, -1


class Player:
    """Plays one scenario: `await Player(bench, scenario).play()`."""

    def __init__(self, bench: Bench, scenario: Scenario) -> None:
        self.bench = bench
        self.scenario = scenario
        self.rng = random.Random(f"player {scenario.seed}")
        self.host = HostBus(bench, pause=pauses(self.rng) if scenario.pauses else None, timeout=400_000)

    async def play(self) -> None:
        """All actions in order, the external clock beside them."""
        if self.scenario.clock.segments:
            cocotb.start_soon(self._clock())
        for action in self.scenario.actions:
            await getattr(self, f"_{action[0]}")(*action[1:])
        await self.host.idle()
        await self.bench.clocks(20)

    async def _clock(self) -> None:
        await self.bench.align()
        for wait, level in clock_levels(self.scenario.clock, random.Random(f"clock {self.scenario.seed}")):
            if wait:
                await self.bench.clocks(wait)
            if level >= 0:
                self.bench.set(clock=level)

    # Polls have a limit and go on: a host that gave up is a legal host, too.

    async def _polled(self, mask: int, value: int, limit: int) -> bool:
        try:
            await self.host.poll(mask, value, limit)
        except TimeoutError:
            return False
        return True

    async def _send(self, code: int, data: list[int]) -> None:
        limit = 1_300_000 if self.scenario.config.datasheet else 50_000
        for reg, byte in [(1, code), *((0, byte) for byte in data)]:
            await self.host.write(reg, byte)
            if not await self._polled(IBF, 0, limit):
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
            await self._polled(OBF, OBF, 40)
            await self.host.read(DATA)

    async def _finish(self, clk: int) -> None:
        if await self._polled(BUSY, 0, clk):
            return
        for _ in range(3):
            await self._send(0x40, [])
            if await self._polled(BUSY, 0, self.bench.config.us(1_000)):
                return
        raise AssertionError(f"P104-BAD-23: BUSY stays 1 after three stop commands\n{self.bench.context()}")

    async def _wait(self, clk: int) -> None:
        await self.bench.clocks(clk)

    async def _pins(self, levels: dict[str, int]) -> None:
        await self.bench.align()
        self.bench.set(**levels)

    async def _blip(self, pin: str, level: int, clk: int) -> None:
        await self._pins({pin: level})
        await self.bench.clocks(clk)
        await self._pins({pin: PPMC104.inputs[pin]})

    async def _raw(self, steps: list[tuple[dict[str, int], int]]) -> None:
        await self.bench.align()
        for levels, clk in steps:
            await self.host.raw(clk, **levels)

    async def _reset(self, clk: int) -> None:
        await self.bench.reset(clk)


def describe(actions: list[Action]) -> str:
    """The action list as text, one action a line."""
    return "\n".join(" ".join(str(part) for part in action) for action in actions)
