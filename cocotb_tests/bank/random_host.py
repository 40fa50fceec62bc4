"""Constrained-random hosts of the bank: bytes, stops and groups on all axes, and random movements of
switches.

`build(seed)` returns the build of a seed, and `play(dut, seed)` runs the seed. In one of four seeds the host
sends many instructions and starts few motions. In all other seeds the host keeps all axes in fast motions
until the golden model has output INTERVALS intervals. If the RTL outputs fewer intervals, the comparison with
the golden model reports the first missing one.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import IBF, DutBench
from cocotb_tests.harness.random_host import Builds, MovingPins, RandomHost
from openppmc.model.bank.group import SWITCHES

from .bench import B4, B8, B32, B64, F100
from .env import CONFIG, DATA, GO, MAP, MASK, POSITION, STATUS, STOP, Env

build = Builds("bank", ((B32, 50), (B8, 18), (B64, 12), (F100, 12), (B4, 8)))
INTERVALS = 50_000
"""A host that keeps the axes in motion ends after this number of pulse intervals, summed over all axes."""
ACTS = 260
"""A host that sends many instructions ends after this number of actions."""
QUICK = (0, 0, 0, 0, 1, 1, 2, 2, 3, 4, 5)
CLK_LIMIT = 3_000_000


async def play(dut: Any, seed: int) -> int:
    """Run one seed and return the number of intervals that all axes together have output."""
    host = BankHost(seed)
    await host.begin(dut)
    await host.play()
    return host.intervals


def in_motion(seed: int) -> bool:
    """Return whether the host of this seed keeps all axes in motion."""
    return seed % 4 != 0


class BankHost(RandomHost):
    """Constrained-random host.

    Its actions depend on the data that it reads. It uses the golden model only to find axes at standstill.
    """

    def __init__(self, seed: int) -> None:
        super().__init__("bank", seed)
        self.quick = in_motion(seed)

    async def begin(self, dut: Any) -> None:
        """Start a bank and release its reset."""
        self.env = await Env.start(dut)
        self.bench: DutBench = self.env.bench
        rng = self.rng
        self.env.host.pause = self._pause if rng.random() < 0.5 else None
        for axis in self.env.axes:
            axis.host.pause = self.env.host.pause
        self.background = MovingPins(self.bench)
        self._counted, self._last, self.intervals = 0, self.bench.initial["pout_n"], -self.env.size

    @property
    def host(self) -> BankHost:  # type: ignore[override]
        """Host through which the methods of `RandomHost` make accesses: this object itself."""
        return self

    def _pause(self) -> int:
        return 0 if self.rng.random() < 0.7 else self.rng.randint(1, self.rng.choice((3, 12, 60)))

    async def play(self) -> None:
        """Initialise axes, perform actions, and wait for the ends of all motions."""
        rng, env = self.rng, self.env
        for n in rng.sample(range(env.size), env.size):
            if rng.random() < (0.95 if self.quick else 0.7):
                await self.init(n)
        if self.quick:
            await self._in_motion()
        else:
            for _ in range(ACTS):
                await self.pick(self._typing())()
                await env.bench.clocks(rng.choice((0, 0, 5, 50, 500, rng.randrange(40 * env.round))))
        self.background.stop()
        await env.bench.clocks(1)
        await env.host.write(STOP, 0)
        await env.bench.clocks(4_000)
        for axis in rng.sample(env.axes, min(8, env.size)):
            await axis.position()
            await axis.command(0x83, poll=False)
        self.count()

    async def _in_motion(self) -> None:
        env, rng = self.env, self.rng
        end = env.bench.now + CLK_LIMIT
        while self.count() < INTERVALS and env.bench.now < end:
            await self.keep_moving()
            for _ in range(rng.choice((0, 1, 1, 2, 4))):
                await self.pick(self._meddling())()
            await env.bench.clocks(rng.choice((50, 200, 500, 1_500, 3_000)))

    def _typing(self) -> tuple[tuple[Any, float], ...]:
        return (
            (self.some_init, 11), (self.some_move, 33), (self.stop, 7), (self.read, 8), (self.switching, 3),
            (self.off, 1.5), (self.any_byte, 3), (self.config, 4), (self.position, 4), (self.mask, 3),
            (self.go, 3), (self.stop_all, 0.5), (self.look, 2), (self.switch, 14), (self.calm, 3),
            (self.overrun, 2), (self.reset, 0.3),
        )  # fmt: skip

    def _meddling(self) -> tuple[tuple[Any, float], ...]:
        return (
            (self.stop, 10), (self.read, 8), (self.any_byte, 4), (self.config, 4), (self.position, 14),
            (self.mask, 3), (self.go, 6), (self.stop_all, 0.2), (self.look, 4), (self.switch, 25),
            (self.calm, 8), (self.overrun, 5), (self.some_init, 3), (self.some_move, 6),
        )  # fmt: skip

    # ------------------------------------------------------------ pulses counted

    def count(self) -> int:
        """Return the number of intervals that the golden model has output so far."""
        edges = self.model.edges
        for edge in edges[self._counted :]:
            if edge.signal == "pout_n":
                self.intervals += (self._last & ~edge.value).bit_count()
                self._last = edge.value
        self._counted = len(edges)
        return self.intervals

    # ------------------------------------------------------------ instructions

    def axis(self) -> int:
        """Return the number of a random axis."""
        return self.rng.randrange(self.env.size)

    async def send(self, n: int, code: int, *data: int) -> None:
        """Send an instruction. Before nine of ten bytes, poll until IBF = 0, at most 30 times.

        A host that does not poll, or that stops polling, is legal, too.
        """
        bus = self.env.axes[n].host
        for reg, byte in ((STATUS, code), *((DATA, byte) for byte in data)):
            if self.rng.random() < 0.9:
                for _ in range(30):
                    if not await bus.status() & IBF:
                        break
            await bus.write(reg, byte, self.rng.choice((2, 2, 3)), self.rng.choice((3, 3, 4, 9)))

    async def init(self, n: int) -> None:
        """Initialise an axis; seeds that keep all axes in motion use a short ramp, other seeds also unusual
        settings.
        """
        rng = self.rng
        if self.quick:
            rl, rh, pa = rng.choice((5, 5, 9, 19)), rng.choice((0, 0, 1, 2, 4)), rng.choice((4, 6, 10, 40))
        else:
            rl = rng.choice((3, 9, 20, 60, 255, rng.randrange(256)))
            rh = rng.choice((0, 0, 1, 2, rl, rng.randrange(rl + 1)))
            pa = rng.choice((4, 4, 5, 8, 20, 100, rng.randrange(3, 300)))
            if rng.random() < 0.05:
                rl, rh = rh, rl
        code = rng.choice((1, 2, 3)) | rng.choice((0, 4)) | rng.choice((0, 8)) | rng.choice((0, 0x20))
        if rng.random() < 0.03:
            code |= 0x10
        await self.send(n, code, rl, rh, pa & 255, pa >> 8)

    async def some_init(self) -> None:
        """Initialise a random axis."""
        await self.init(self.axis())

    async def move(self, n: int) -> None:
        """Start any operation on an axis."""
        rng = self.rng
        code = rng.choice((0x40, 0x60)) if rng.random() < 0.3 else 0x40
        code |= rng.choice((0, 8)) | rng.choice((0, 0, 0x10)) | rng.choice((0, 0x80))
        if self.quick:
            count = rng.choice((60, 300, 1_000, 3_000)) - 1
            low, rate = rng.choice((3, 3, 4, 4, 4, 5, 6, 7)), rng.choice(QUICK)
        else:
            count = rng.choice((0, 1, 2, 3, 5, 8, 9, 10, 20, 50, rng.randrange(300)))
            low, rate = rng.choice((2, 3, 3, 3, 4, 4, 5, 6, 7)), rng.choice((0, 0, 1, 2, 3, 4, 9, 10, 40))
        if low not in (3, 6):
            code &= 0x7F
        data = [count & 255, count >> 8, 0] if low in (3, 4) else []
        await self.send(n, code | low, *([rate] if low in (4, 5, 7) else []), *data)

    async def some_move(self) -> None:
        """Start any operation on a random axis."""
        await self.move(self.axis())

    async def keep_moving(self) -> None:
        """Start operations on some axes at standstill."""
        rng, model = self.rng, self.model
        resting = [n for n in range(self.env.size) if not model.busy(n)]
        for n in rng.sample(resting, min(len(resting), 6)):
            if not self.model.initialised(n):
                await self.init(n)
            await self.move(n)

    async def stop(self) -> None:
        """Send a stop command (0x40 or 0x41)."""
        await self.send(self.axis(), self.rng.choice((0x40, 0x41, 0x41)))

    async def read(self) -> None:
        """Send a read command and read some bytes of its answer."""
        n = self.axis()
        await self.send(n, self.rng.choice((0x80, 0x81, 0x82, 0x83)))
        for _ in range(self.rng.randrange(4)):
            await self.env.axes[n].host.read(DATA)

    async def switching(self) -> None:
        """Set the parameters of the chopper."""
        await self.send(self.axis(), 0x84, self.rng.choice((0, 1, 3, 20)), self.rng.choice((0, 1, 3, 20)))

    async def off(self) -> None:
        """Send Excitation OFF (0xC0)."""
        await self.send(self.axis(), 0xC0)

    async def any_byte(self) -> None:
        """Send any byte."""
        n = self.axis()
        if self.rng.random() < 0.5:
            await self.send(n, self.rng.randrange(256))
        else:
            await self.env.axes[n].host.write(DATA, self.rng.randrange(256))

    async def overrun(self) -> None:
        """Send bytes to many axes, or several bytes to one axis, without polling."""
        one = self.axis()
        for n in self.rng.choices(range(self.env.size), k=6) if self.rng.random() < 0.5 else [one] * 3:
            byte = self.rng.choice((0x80, 0x83, 0x42, 0x4A, 0x41, 0x81))
            await self.env.axes[n].host.write(STATUS, byte)

    # ------------------------------------------------------------ registers

    async def config(self) -> None:
        """Write CONFIG; a host that keeps the axes in motion seldom selects slow clocks."""
        rng, n = self.rng, self.axis()
        await self.env.axes[n].host.write(
            CONFIG, rng.choice((3, 3, 3, 3, 1)) if self.quick else rng.randrange(4)
        )
        await self.env.axes[n].host.read(CONFIG)

    async def position(self) -> None:
        """Read the complete position register or a part of it."""
        n = self.axis()
        for k in range(self.rng.choice((1, 1, 4))):
            await self.env.axes[n].host.read(POSITION + k)

    async def mask(self) -> None:
        """Write a byte of MASK."""
        k = self.rng.randrange(max(1, self.env.size // 8))
        few = 1 << self.rng.randrange(8)
        await self.env.host.write(k << 4 | MASK, self.rng.choice((0, few, few, 255, self.rng.randrange(256))))

    async def go(self) -> None:
        """Write GO one or more times.

        A host that keeps the axes in motion seldom lets a held operation wait for long.
        """
        for _ in range(self.rng.choice((1, 1, 1, 2, 3))):
            await self.env.host.write(GO, 0)
        if self.quick and self.rng.random() < 0.7:
            for k in range(max(1, self.env.size // 8)):
                await self.env.host.write(k << 4 | MASK, 0)

    async def stop_all(self) -> None:
        """Write STOP."""
        await self.env.host.write(STOP, 0)

    async def look(self) -> None:
        """Read the interrupt map or any register."""
        k = self.rng.randrange(max(1, self.env.size // 8))
        await self.env.host.read(self.rng.choice((k << 4 | MAP, self.rng.randrange(1024))))

    # ------------------------------------------------------------ pins

    async def switch(self) -> None:
        """Schedule changes of some switches; most switches return to the idle level."""
        rng, bench = self.rng, self.bench
        for _ in range(rng.choice((1, 1, 2, 6))):
            pin, n = rng.choice(SWITCHES), self.axis()
            t = bench.now + rng.randrange(1, 300)
            if rng.random() < 0.85:
                self.background.blip(t, f"{pin}[{n}]", 0, rng.choice((1, 1, 2, 3, 17, 100)))
            else:
                self.background.add(t, **{f"{pin}[{n}]": rng.getrandbits(1)})

    async def calm(self) -> None:
        """Set all switches to their idle level."""
        await self.bench.align()
        self.bench.set(**{pin: (1 << self.env.size) - 1 for pin in SWITCHES})

    async def reset(self) -> None:
        """Reset the bank at any moment."""
        await self.env.reset(self.rng.choice((2, 3, 9)))
