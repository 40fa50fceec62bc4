"""Random hosts of the PMC006: valid and invalid frames, motions, stops, programs, changing pins.

`build(seed)` returns the build of a seed, and `play(dut, seed)` plays the seed.
"""

from __future__ import annotations

from collections import Counter
from math import ceil
from typing import Any

from cocotb_tests.harness.random_host import Builds, MovingPins

from .builds import D8E, F8B, ODD
from .chip import Chip
from .host import Host
from .programs import image, page
from .random_collisions import CollisionHost
from .random_faults import FaultHost
from .random_pins import PinHost
from .random_program import random_program

build = Builds("p006", ((F8B, 80), (ODD, 12), (D8E, 8)))


async def play(dut: Any, seed: int) -> Counter[str]:
    """Play one seed; return the counts of the host's actions and results.

    Raises AssertionError if the part hangs or sends an invalid reply.
    """
    talker = RandomSerialHost(seed)
    await talker.begin(dut)
    await talker.play()
    return talker.seen


def with_chip(seed: int) -> bool:
    """Return whether the host of a seed has an EEPROM; one that does not respond also counts."""
    return RandomSerialHost(seed).chip is not None


class RandomSerialHost(CollisionHost, PinHost, FaultHost):
    """One random host. Its actions depend on the data that it receives; it uses the golden model only to
    decide when to act.
    """

    def __init__(self, seed: int) -> None:
        super().__init__("p006", seed)
        rng = self.rng
        self.chip: Chip | None = None
        if rng.random() < 0.08:
            self.chip = Chip(self._content(), write_us=rng.choice((300, 2_000, 12_000)))
        elif rng.random() < 0.03:
            self.chip = Chip(missing=True)

    async def begin(self, dut: Any) -> None:
        """Start a part and let it boot."""
        rng = self.rng
        levels: dict[str, int] = {}
        if rng.random() < 0.2:
            levels = {"ext1": rng.getrandbits(1), "ext2": rng.getrandbits(1), "gpi": rng.randrange(32)}
        error = rng.choice((0, 0, 0, 0.02, -0.02))
        self.host = await Host.start(dut, levels=levels, boot=False, error=error, chip=self.chip)
        self.background = MovingPins(self.host.bench, ("sda_i", "scl_i", "fset_n", "ee_on"))
        await self.host.boot()
        self.seen = Counter()
        self.left = rng.randint(12, 19) if not self.chip else 12
        self.noisy = rng.random() < 0.25

    def _content(self) -> bytes:
        """Return the content of an EEPROM, such as a program that starts automatically or a damaged page."""
        rng = self.rng
        params = page(a0B=rng.getrandbits(1), a04=rng.choice((4, 16, 3)), a0A=rng.randrange(4), a06=5, a07=5)
        content = bytearray(image(params, random_program(rng), mark=rng.choice((0x5A, 0x5A, 0x5A, 0))))
        if rng.random() < 0.2:
            content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
        return bytes(content)

    async def play(self) -> None:
        """Perform actions of all kinds; check that the part answers a valid frame afterwards."""
        rng = self.rng
        for code, value in (("L", 3000), ("S", 3000), ("v", 3000), ("u", 5), ("o", 5)):
            if rng.random() < 0.9:
                await self.frame(code, value)
        await self.frame("f", rng.choice((3, 3, 2, 0)))
        for code, data in (("m", (0, 2, 4, 8)), ("d", (0,)), ("J", (1, 2, 3))):
            if rng.random() < 0.45:
                await self.frame(code, rng.choice(data))
        actions = (
            (self.setting, 12),
            (self.start, 22),
            (self.collision, 11),
            (self.frame_in_motion, 14),
            (self.read, 6),
            (self.ext, 8),
            (self.stall, 4),
            (self.analog, 4),
            (self.keys, 2),
            (self.chopper, 8),
            (self.single, 4),
            (self.program, 6),
            (self.outputs, 7),
            (self.bad_frame, 6),
            (self.foreign, 4),
            (self.talk_out_of_turn, 3),
            (self.noise, 3),
            (self.unknown, 2),
            (self.save, 1),
            (self.pause, 4),
            (self.reset, 0.7),
        )
        while self.left > 0:
            act = self.pick(actions)
            self.seen[act.__name__] += 1
            await act()
        await self.recover()

    async def recover(self) -> None:
        """Check that the part accepts a frame again after the host has sent nothing for a time."""
        host = self.host
        await host.pause(1)
        self.background.stop()
        host.error *= 0
        await host.pause(1)
        await host.pause(ceil(215 * host.bit))
        await host.ignore_replies()
        for code in "FI":
            await host.send_frame(code)
            await self.await_reply()
            await host.ignore_replies()
        assert await host.ask("R") == 0x123 and not await host.busy()
        self.seen["steps"] += host.step_count(0)
        self.seen["halts"] += sum(not level for _, level in host.edges("mon_busy"))
        for pin in ("gpo", "bridge_a_en", "mon_dir", "m11", "ext1_pu", "phase_a_sign"):
            self.seen[pin] += len(host.edges(pin))
