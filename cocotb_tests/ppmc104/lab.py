"""`Lab`: a PPMC-104 on the bench with its host, and the shortcuts that all part tests use."""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import BUSY, Drive, HostBus, Side, start_bench

from .bench import PPMC104
from .figures import INIT_A

Init = tuple[int, int, int, int]

# Windows of the rules, in clk, counted from edge 0 of a host write.
WRITE_EVENT = 2
C_EVENT_LATEST = 10
PINS_LATEST = 12


class Lab(Drive):
    """Bench plus host. Make one with `await Lab.start(dut, INIT_A)`; `None` leaves the core as reset does."""

    def __init__(self, bench: Side) -> None:
        super().__init__(bench, HostBus(bench))

    @classmethod
    async def start(cls, dut: Any, init: Init | None = INIT_A, **pins: int) -> Lab:
        """Reset, input levels `pins`, then an initialisation (code, RL, RH, PA) if one is given."""
        lab = cls(await start_bench(dut, PPMC104, **pins))
        if init:
            await lab.init(*init)
        return lab

    async def init(self, code: int, rl: int, rh: int, pa: int) -> None:
        """Initialise and wait for the end of the table build."""
        await self.host.init(code, rl, rh, pa)
        await self.built()

    async def built(self) -> None:
        """Wait until the mailbox is open again: a command without effect on the state is taken."""
        await self.host.command(0xC2 if self.bench.level("aux_n") else 0xC1)
        if self.cfg.datasheet:
            # That command closes the mailbox again, for 14 us.
            await self.bench.clocks(self.cfg.us(14) + 20)

    async def move(self, code: int, n: int | None = None, rate: int | None = None) -> list[int]:
        """`go`, then wait for the end; returns the pulses."""
        await self.go(code, n, rate)
        if self.cfg.datasheet:
            # BUSY rises long after IBF has fallen (P104-DS-03).
            await self.host.poll(BUSY, BUSY, timeout=self.cfg.us(150), dense=1000)
        await self.idle()
        return self.pulses
