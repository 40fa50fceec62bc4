"""Player for the action lists of `random_host` on a test bench."""

from __future__ import annotations

from cocotb_tests.harness.player import Player

BUSY = {1: 0x04, 2: 0x08}


class HostPlayer(Player):
    """Plays one scenario: `await HostPlayer(bench, scenario).run()`.

    Adds the action ("finish", axes, cycles): poll until BUSY of these axes is 0; after this number of cycles
    without success, stop them.
    """

    async def _finish(self, axes: list[int], clk: int) -> None:
        mask = sum(BUSY[axis] for axis in axes)
        if await self.polled(mask, 0, clk):
            return
        for _ in range(3):
            for axis in axes:
                await self._send(0x40 | (axis - 1) << 5, [])
            if await self.polled(mask, 0, self.bench.config.us(1_000)):
                return
        raise AssertionError(f"P2104-BAD-26: BUSY stays 1 after three stops\n{self.bench.context()}")
