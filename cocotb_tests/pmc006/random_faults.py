"""A random host of the PMC006 that sends faulty frames, disturbs the line, and resets the part."""

from __future__ import annotations

from math import ceil

from .frames import checked, command, reply
from .random_frames import FrameHost


class FaultHost(FrameHost):
    """Random host that sends invalid frames, disturbs the line, pauses, or resets the part."""

    async def bad_frame(self) -> None:
        """Send an invalid frame: wrong check byte, too short, too long, random bytes, or wrong first byte."""
        rng, host = self.rng, self.host
        self.left -= 1
        good = command(host.address, rng.choice("ysivI"), rng.choice((0xF8, 3, 0xA5A5A5A5)))
        kind = rng.randrange(5)
        if kind == 0:
            place = rng.randrange(8)
            line = good[:place] + bytes([good[place] ^ 1 << rng.randrange(8)]) + good[place + 1 :]
        elif kind == 1:
            line = good[: rng.randrange(1, 8)]
        elif kind == 2:
            line = good + rng.randbytes(rng.randint(1, 3))
        elif kind == 3:
            line = rng.randbytes(rng.randint(1, 9))
        else:
            line = checked(0xA5, host.address, rng.randrange(256), *rng.randbytes(4))
        await self.put(line)
        if kind == 1 and rng.random() < 0.5:
            await host.pause(ceil(192 * host.bit) + rng.choice((-40, -36, -35, -34, -33, -3, 0, 40)))
        await self.await_reply()

    async def foreign(self) -> None:
        """Send frames and replies of other nodes."""
        rng = self.rng
        self.left -= 1
        other = rng.choice((1, 5, 0x78, 0, 0x7A))
        data = rng.choice((0, 0xA5FFA5FF, 7))
        await self.put(command(other, rng.choice("jsI"), data) + reply(other, data))
        await self.await_reply()

    async def talk_out_of_turn(self) -> None:
        """Send another frame while the part sends a reply."""
        rng, host = self.rng, self.host
        self.left -= 2
        await host.send_frame(rng.choice("cjy"), 0)
        host.back_to(host.e + rng.choice((0, 1, 30, 60, 100, 400, 4_000)))
        await self.put(command(host.address, rng.choice("yj"), 0xF8))
        await host.ignore_replies()
        if rng.random() < 0.7:
            await host.pause(ceil(200 * host.bit))

    async def noise(self) -> None:
        """Apply short low levels and breaks to an idle line."""
        rng, host = self.rng, self.host
        for _ in range(rng.randint(1, 5)):
            await host.low(rng.choice((0.01, 0.1, 0.48, 0.5, 0.52, 1, 3, 9.3, 9.6, 12, 30)))
            host.t += rng.choice((0, 3, 50, 1_000))
        await self.await_reply()

    async def pause(self) -> None:
        """Send nothing for a while."""
        await self.host.pause(self.rng.choice((100, 3_000, 9_000)))
        self.left -= 0.5

    async def reset(self) -> None:
        """Reset the part with rst_n at any time."""
        rng, host = self.rng, self.host
        if rng.random() < 0.5:
            await host.send_frame("s", 100)
            await host.pause(rng.choice((0, 10, 500, 3_000)))
        await host.reset(rng.choice((3, 12, 300)))
        await host.boot()
        await host.ignore_replies()
        self.left -= 2
        for code in "LSv":
            await self.frame(code, 3000)
