"""Carries out the action list of a random host on a part with one axis."""

from __future__ import annotations

from dataclasses import dataclass, field

from .bus import BUSY
from .config import Config
from .player import Action, ExternalClock, Player
from .side import Side


@dataclass(frozen=True)
class Scenario:
    """One random host: build, initial pin levels, actions, clock programme, bus manners."""

    seed: int
    config: Config
    pins: dict[str, int]
    actions: list[Action]
    clock: ExternalClock
    pauses: bool
    limit_clk: int = field(default=60_000)


class SinglePlayer(Player):
    """Plays one scenario: `await SinglePlayer(bench, scenario, rule).run()`.

    Adds ("finish", clk): poll until BUSY = 0; after clk give up and send 0x40, which the rule says must help.
    """

    def __init__(self, bench: Side, scenario: Scenario, rule: str) -> None:
        super().__init__(bench, scenario.seed, scenario.pauses)
        self.scenario = scenario
        self.rule = rule

    async def run(self) -> None:
        """All actions in order, the external clock beside them."""
        clock = self.scenario.clock
        if clock.segments:
            self.start_clock(self.bench.part.clock, clock, self.scenario.seed)
        await self.play(self.scenario.actions)

    async def _finish(self, clk: int) -> None:
        if await self.polled(BUSY, 0, clk):
            return
        for _ in range(3):
            await self._send(0x40, [])
            if await self.polled(BUSY, 0, self.bench.config.us(1_000)):
                return
        raise AssertionError(f"{self.rule}: BUSY stays 1 after three stop commands\n{self.bench.context()}")
