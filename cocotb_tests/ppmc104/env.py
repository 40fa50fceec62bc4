"""`Env`: a PPMC-104 on the test bench with its host, and the functions that all tests of this part use."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, AxisDriver, DutBench, HostBus, start_bench

from .bench import PPMC104
from .expected_timing import INIT_A

Init = tuple[int, int, int, int]

# Limits of the rules in cycles, counted from edge 0 of a host write.
WRITE_EVENT = 2
C_EVENT_LATEST = 10
PINS_LATEST = 12


class Env(AxisDriver):
    """The test bench and its host; create it with `await Env.start(dut, INIT_A)`.

    With `None` instead of INIT_A, the core stays in its reset state.
    """

    def __init__(self, bench: DutBench) -> None:
        super().__init__(bench, HostBus(bench))

    @classmethod
    async def start(cls, dut: Any, init: Init | None = INIT_A, **pins: int) -> Env:
        """Reset with the input levels `pins`, then initialise with (code, RL, RH, PA) unless this is None."""
        env = cls(await start_bench(dut, PPMC104, **pins))
        if init:
            await env.init(*init)
        return env

    async def init(self, code: int, rl: int, rh: int, pa: int) -> None:
        """Initialise and wait for the end of the table build."""
        await self.host.init(code, rl, rh, pa)
        await self.built()

    async def built(self) -> None:
        """Wait until the mailbox is open again, by means of a command that changes no state."""
        await self.host.command(0xC2 if self.bench.level("aux_n") else 0xC1)
        if self.cfg.datasheet:
            # This command closes the mailbox again for 14 us.
            await self.bench.clocks(self.cfg.us(14) + 20)

    async def move(self, code: int, n: int | None = None, rate: int | None = None) -> list[int]:
        """Call `go`, wait for the end of the motion, and return the pulses."""
        await self.go(code, n, rate)
        if self.cfg.datasheet:
            # In DATASHEET, BUSY rises long after IBF has fallen (P104-DS-03).
            await self.host.poll(BUSY, BUSY, timeout=self.cfg.us(150), dense=1000)
        await self.idle()
        return self.pulses
