"""Input pins of the PMC006 that random hosts change while they send frames."""

from __future__ import annotations

from math import ceil

from .random_frames import FrameHost


class PinHost(FrameHost):
    """Random host with changing input pins."""

    async def ext(self) -> None:
        """Operate emergency switches (presses, bounces, an edge near the end of a frame); in most cases,
        clear the flags afterwards.
        """
        rng, t = self.rng, self.host.t
        pin = rng.choice(("ext1", "ext2"))
        level = self.host.bench.pin(pin)
        near = ceil(79.5 * self.host.bit) + rng.randint(-12, 40)
        first = t + rng.choice((near, near, rng.randrange(1, 12_000)))
        for number in range(rng.choice((1, 1, 2, 5))):
            level ^= 1
            self.background.add(first + number * rng.choice((1, 2, 50)), **{pin: level})
        await self.frame(rng.choice("jjsNfb"), rng.choice((0, 1, 3)))
        if rng.random() < 0.7:
            await self.frame("b")
            await self.frame("l")

    async def stall(self) -> None:
        """Apply samples of the back EMF, in some cases during a motion."""
        rng = self.rng
        if rng.random() < 0.6:
            await self.frame("Y", rng.choice((1, 3, 5, 7)))
            await self.frame("Z", rng.choice((511, 200)))
            await self.frame("T", rng.choice((1, 2, 4)))
        if rng.random() < 0.7:
            await self.frame("N", 1)
        t = self.host.t + rng.randrange(1, 2_000)
        for _ in range(rng.randint(1, 8)):
            self.background.add(t, bemf_level=rng.choice((0, 100, 199, 200, 600)), bemf_valid=1)
            t += rng.choice((1, 1, 3))
            self.background.add(t, bemf_valid=0)
            t += rng.choice((5, 100, 3_000))
        await self.frame(rng.choice("jXpI"))

    async def keys(self) -> None:
        """Press keys at the GPI pins, briefly or long."""
        rng, t = self.rng, self.host.t + 1
        for number in range(rng.randint(1, 3)):
            low = rng.choice((0b11110, 0b11101, 0b11100, rng.randrange(32)))
            self.background.add(t + number * 40, gpi=low)
        await self.host.pause(self.host.us(rng.choice((300, 1_010, 1_100))))
        self.background.add(self.host.t + 1, gpi=0x1F)
        await self.host.pause(self.host.us(rng.choice((10, 990, 1_050))))
        await self.frame("x")

    async def chopper(self) -> None:
        """Toggle the comparators for a while."""
        rng, t = self.rng, self.host.t + 1
        for _ in range(rng.randint(5, 60)):
            self.background.add(t, **{rng.choice(("cmp_a", "cmp_b")): rng.getrandbits(1)})
            t += rng.choice((1, 2, 9, 60, 170, 400))
        await self.frame(rng.choice("jeg"), rng.choice((0, 4000)))
