"""Carries out the action list of a random host on a part with one axis."""

from __future__ import annotations

from .bus import BUSY
from .player import Player, Scenario
from .side import Side


class SinglePlayer(Player):
    """Plays one scenario: `await SinglePlayer(bench, scenario, rule).run()`.

    Adds ("finish", clk): poll until BUSY = 0; after clk give up and send 0x40, which the rule says must help.
    """

    def __init__(self, bench: Side, scenario: Scenario, rule: str) -> None:
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
