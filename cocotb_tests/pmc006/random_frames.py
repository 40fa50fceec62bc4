"""Frames of random hosts of the PMC006: settings, reads, outputs and saves; and the wait for the reply."""

from __future__ import annotations

from collections import Counter
from math import ceil

from cocotb_tests.harness.random_host import RandomHost

from .frames import command
from .host import Host
from .random_program import SPEEDS

EDGES = (-1, 0x100, 0x10000, 0x7FFFFFFF, -0x80000000)
DATA: dict[str, tuple[int, ...]] = {
    "F": (0, 0, 1, 2),
    "J": (0, 1, 2, 3, 4),
    "L": (3000, 3000, 2500, 65, 64, 3001, 0),
    "M": (100, 300, 1200, 1201, 0),
    "P": (300, 1250, 2000, 0),
    "Q": (1, 2, 3, 4, 0, 5),
    "S": (3000, 3000, 2000, 65, 0),
    "T": (0, 1, 2, 5, 63, 64),
    "Y": (1, 3, 5, 7, 0, 8),
    "Z": (200, 511, 100, 0, 512),
    "a": (0, 1, 1),
    "d": (0, 1, 2),
    "e": (400, 800, 1075, 2000, 4000, 4001),
    "f": (3, 3, 1, 2, 0, 4),
    "g": (0, 0, 0, 1),
    "i": (0, 5, -5, 0x7FFFFFFF, -0x80000000),
    "m": (0, 2, 4, 8, 16, 32, 64, 128, 3),
    "o": (5, 5, 4, 0, 6),
    "u": (5, 5, 4, 0, 6),
    "v": SPEEDS,
    "y": (0x08, 0xF8, 0x50, 0, 7),
}
READS = "cjOxXKRknqrhU"


class FrameHost(RandomHost):
    """Random host that sends frames.

    `seen` counts its actions and their results; `left` is the number of actions that remain.
    """

    host: Host
    seen: Counter[str]
    left: float
    noisy: bool

    async def frame(self, code: str | int, data: int = 0) -> None:
        """Send a valid frame, then wait for the reply. If the host is noisy, spikes may damage the frame."""
        rng, host = self.rng, self.host
        self.left -= 1
        if rng.random() < 0.5:
            await host.pause(rng.choice((1, 3, 20, 100, 700, 3_000)))
        await host.send_frame(code, data) if not self.noisy else await self.put(
            command(host.address, code, data)
        )
        self.seen[f"code {code}"] += 1
        await self.await_reply()

    async def put(self, line: bytes) -> None:
        """Send bytes, some of them followed by a gap; if the host is noisy, some with a spike or a low stop
        bit.
        """
        rng, host = self.rng, self.host
        for byte in line:
            spikes = []
            if self.noisy and rng.random() < 0.1:
                spikes = [(rng.uniform(0, 9.4), rng.randint(1, int(host.bit * 0.9)))]
            await host.character(byte, spikes=spikes, stop=int(not self.noisy or rng.random() > 0.01))
            if rng.random() < 0.04:
                await host.pause(rng.choice((5, 70, 900)))

    async def await_reply(self) -> None:
        """Wait for the end of the reply, if there is one; in a few cases do not wait, so that the next action
        may occur during the reply.
        """
        host = self.host
        await host.go(max(host.t, host.e + ceil(host.bit) + 9))
        if await host.out("de"):
            self.seen["reply"] += 1
        if self.rng.random() < 0.97:
            await host.ignore_replies()
        host.address = self.model.context.settings.addr

    async def setting(self) -> None:
        """Write a register, mostly with legal data."""
        code = self.rng.choice(list(DATA))
        data = self.rng.choice(DATA[code]) if self.rng.random() < 0.93 else self.rng.choice(EDGES)
        await self.frame(code, data)

    async def read(self) -> None:
        """Send an instruction that changes nothing."""
        await self.frame(self.rng.choice(READS), self.rng.choice((0, 0, -1)))

    async def unknown(self) -> None:
        """Send any code."""
        await self.frame(self.rng.choice((0, 0x40, 0x48, 0x5B, 0x7B, 0xA5, 0xFF, self.rng.randrange(256))), 1)

    async def outputs(self) -> None:
        """Write GPO."""
        await self.frame("y", self.rng.choice((0x08, 0xF8, 0x50, 0x87, 0, -1)))

    async def save(self) -> None:
        """Send instruction t (save settings) or B (burn program)."""
        await self.frame(self.rng.choice("ttB"))
