"""Carries out the action list of `random_host` on a bench."""

from __future__ import annotations

import cocotb

from cocotb_tests.common.bench import Bench
from cocotb_tests.common.bus import BUSY
from cocotb_tests.common.player import Player
from cocotb_tests.ppmc104.random_host import Scenario


class Player104(Player):
    """Plays one scenario: `await Player104(bench, scenario).run()`.

    Adds ("finish", clk): poll until BUSY = 0; after clk give up and send 0x40.
    """

    def __init__(self, bench: Bench, scenario: Scenario) -> None:
        super().__init__(bench, scenario.seed, scenario.pauses)
        self.scenario = scenario

    async def run(self) -> None:
        """All actions in order, the external clock beside them."""
        clock = self.scenario.clock
        if clock.segments:
            cocotb.start_soon(self.run_clock("clock", clock, self.scenario.seed))
        await self.play(self.scenario.actions)

    async def _finish(self, clk: int) -> None:
        if await self.polled(BUSY, 0, clk):
            return
        for _ in range(3):
            await self._send(0x40, [])
            if await self.polled(BUSY, 0, self.bench.config.us(1_000)):
                return
        raise AssertionError(f"P104-BAD-23: BUSY stays 1 after three stop commands\n{self.bench.context()}")
