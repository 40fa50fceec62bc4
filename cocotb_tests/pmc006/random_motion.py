"""Motions and programs of random hosts of the PMC006."""

from __future__ import annotations

from .programs import words
from .random_frames import DATA, FrameHost
from .random_program import random_op, random_program

COUNTS = (1, 2, 3, 5, 12, 60, 255, 256, 260, 300, 1000, 0x7FFFFFFF, 0, -1)


class MotionHost(FrameHost):
    """Random host that starts motions and programs."""

    async def start(self) -> None:
        """Start a motion, if the state allows it."""
        rng = self.rng
        if rng.random() < 0.3:
            await self.frame("N", rng.choice((1, 1, 1, 0, 2)))
        else:
            await self.frame("s", rng.choice(COUNTS))
        if rng.random() < 0.4:
            await self.host.pause(rng.choice((500, 4_000, 12_000)))

    async def frame_in_motion(self) -> None:
        """Send an instruction that a host may send during a motion."""
        rng = self.rng
        code = rng.choice("vvvvINNNgissecbbllpmdu")
        data = rng.choice(DATA.get(code, (0, 1, 1))) if code != "s" else rng.choice(COUNTS)
        await self.frame(code, data)
        if code == "g" and data:
            await self.frame("g", 0)

    async def single(self) -> None:
        """Execute one program instruction (instruction E)."""
        rng = self.rng
        place = rng.randrange(100)
        await self.frame("A", 2 * place)
        for word in random_op(rng, 100).words:
            await self.frame("W", word)
        await self.frame("A", 2 * place)
        for _ in range(rng.randint(1, 2)):
            await self.frame("E")
        self.left += 3

    async def program(self) -> None:
        """Load and start a program, in some cases from instruction 1 on."""
        rng = self.rng
        program = random_program(rng)[: rng.choice((3, 5))]
        await self.frame("A", 0)
        for word in words(program):
            await self.frame("W", word)
        await self.frame("A", rng.choice((0, 0, 0, 2)))
        await self.frame("z")
        self.left += len(program)
        if rng.random() < 0.5:
            await self.host.pause(rng.choice((2_000, 9_000)))

    async def analog(self) -> None:
        """Set the voltage on GPI1, let instruction E switch the analog speed on in half of the cases, and
        start a motion.
        """
        rng = self.rng
        t = self.host.t + 1
        self.background.add(t, adc_data=rng.choice((0, 1, 300, 512, 1023)), adc_valid=1)
        self.background.add(t + 1, adc_valid=0)
        if rng.random() < 0.5:
            await self.frame("A", 198)
            for word in (0x08 | 0x100, rng.choice((8000, 3000, 16_000))):
                await self.frame("W", word)
            await self.frame("A", 198)
            await self.frame("E")
            self.left += 3
        await self.start()
