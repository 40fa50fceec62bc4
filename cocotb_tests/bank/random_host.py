"""Random hosts of the bank: all axes at once, bytes, stops, groups, switches that move by themselves.

A seed decides all, `build` the build; `play(dut, seed)` plays. Every fourth seed types much and moves
little; the others keep all axes in quick motions until the golden model has made INTERVALS: where the RTL
makes fewer, the comparison says which one is missing.
"""

from __future__ import annotations

from typing import Any

from cocotb_tests.harness import IBF, Side
from cocotb_tests.harness.random_host import Builds, MovingPins, RandomHost
from openppmc.model.bank.group import SWITCHES

from .bench import B4, B8, B32, B64, F100
from .lab import CONFIG, DATA, GO, MAP, MASK, POSITION, STATUS, STOP, Lab

build = Builds("bank", ((B32, 50), (B8, 18), (B64, 12), (F100, 12), (B4, 8)))
INTERVALS = 50_000
"""From pulse to pulse of an axis; a host in motion goes on until its axes have made so many."""
ACTS = 260
"""Of a host that types much."""
QUICK = (0, 0, 0, 0, 1, 1, 2, 2, 3, 4, 5)
CLK_LIMIT = 3_000_000


async def play(dut: Any, seed: int) -> int:
    """Play one seed; how many intervals all axes have made."""
    host = BankHost(seed)
    await host.begin(dut)
    await host.play()
    return host.intervals


def in_motion(seed: int) -> bool:
    """Whether the host of a seed keeps all axes in motion."""
    return seed % 4 != 0


class BankHost(RandomHost):
    """One random host. It acts on what it reads; the golden model tells it which axes are at rest."""

    def __init__(self, seed: int) -> None:
        super().__init__("bank", seed)
        self.quick = in_motion(seed)

    async def begin(self, dut: Any) -> None:
        """A bank out of reset."""
        self.lab = await Lab.start(dut)
        self.side: Side = self.lab.bench
        rng = self.rng
        self.lab.host.pause = self._pause if rng.random() < 0.5 else None
        for axis in self.lab.axes:
            axis.host.pause = self.lab.host.pause
        self.background = MovingPins(self.side)
        self._counted, self._last, self.intervals = 0, self.side.initial["pout_n"], -self.lab.size

    @property
    def host(self) -> BankHost:  # type: ignore[override]
        """It has its side itself."""
        return self

    def _pause(self) -> int:
        return 0 if self.rng.random() < 0.7 else self.rng.randint(1, self.rng.choice((3, 12, 60)))

    async def play(self) -> None:
        """Set up, act, let it end."""
        rng, lab = self.rng, self.lab
        for n in rng.sample(range(lab.size), lab.size):
            if rng.random() < (0.95 if self.quick else 0.7):
                await self.init(n)
        if self.quick:
            await self._in_motion()
        else:
            for _ in range(ACTS):
                await self.pick(self._typing())()
                await lab.bench.clocks(rng.choice((0, 0, 5, 50, 500, rng.randrange(40 * lab.round))))
        self.background.stop()
        await lab.bench.clocks(1)
        await lab.host.write(STOP, 0)
        await lab.bench.clocks(4_000)
        for axis in rng.sample(lab.axes, min(8, lab.size)):
            await axis.position()
            await axis.command(0x83, poll=False)
        self.count()

    async def _in_motion(self) -> None:
        lab, rng = self.lab, self.rng
        end = lab.bench.now + CLK_LIMIT
        while self.count() < INTERVALS and lab.bench.now < end:
            await self.keep_moving()
            for _ in range(rng.choice((0, 1, 1, 2, 4))):
                await self.pick(self._meddling())()
            await lab.bench.clocks(rng.choice((50, 200, 500, 1_500, 3_000)))

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

    # ------------------------------------------------------------ what it has seen

    def count(self) -> int:
        """Intervals of the golden model up to now."""
        edges = self.model.edges
        for edge in edges[self._counted :]:
            if edge.signal == "pout_n":
                self.intervals += (self._last & ~edge.value).bit_count()
                self._last = edge.value
        self._counted = len(edges)
        return self.intervals

    # ------------------------------------------------------------ instructions

    def axis(self) -> int:
        """Any of them."""
        return self.rng.randrange(self.lab.size)

    async def send(self, n: int, code: int, *data: int) -> None:
        """Mostly polled; a host that gives up polling is a legal host, too."""
        bus = self.lab.axes[n].host
        for reg, byte in ((STATUS, code), *((DATA, byte) for byte in data)):
            if self.rng.random() < 0.9:
                for _ in range(30):
                    if not await bus.status() & IBF:
                        break
            await bus.write(reg, byte, self.rng.choice((2, 2, 3)), self.rng.choice((3, 3, 4, 9)))

    async def init(self, n: int) -> None:
        """Quick ramps; one that types also has strange ones."""
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
        """Of any axis."""
        await self.init(self.axis())

    async def move(self, n: int) -> None:
        """Any operation."""
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
        """Of any axis."""
        await self.move(self.axis())

    async def keep_moving(self) -> None:
        """New operations for axes at rest."""
        rng, model = self.rng, self.model
        resting = [n for n in range(self.lab.size) if not model.busy(n)]
        for n in rng.sample(resting, min(len(resting), 6)):
            if not self.model.initialised(n):
                await self.init(n)
            await self.move(n)

    async def stop(self) -> None:
        """0x40 or 0x41."""
        await self.send(self.axis(), self.rng.choice((0x40, 0x41, 0x41)))

    async def read(self) -> None:
        """A read command and some of its answers."""
        n = self.axis()
        await self.send(n, self.rng.choice((0x80, 0x81, 0x82, 0x83)))
        for _ in range(self.rng.randrange(4)):
            await self.lab.axes[n].host.read(DATA)

    async def switching(self) -> None:
        """Parameters of the chopper."""
        await self.send(self.axis(), 0x84, self.rng.choice((0, 1, 3, 20)), self.rng.choice((0, 1, 3, 20)))

    async def off(self) -> None:
        """Excitation OFF."""
        await self.send(self.axis(), 0xC0)

    async def any_byte(self) -> None:
        """Any byte."""
        n = self.axis()
        if self.rng.random() < 0.5:
            await self.send(n, self.rng.randrange(256))
        else:
            await self.lab.axes[n].host.write(DATA, self.rng.randrange(256))

    async def overrun(self) -> None:
        """Bytes to many axes, or to one, without a poll."""
        one = self.axis()
        for n in self.rng.choices(range(self.lab.size), k=6) if self.rng.random() < 0.5 else [one] * 3:
            byte = self.rng.choice((0x80, 0x83, 0x42, 0x4A, 0x41, 0x81))
            await self.lab.axes[n].host.write(STATUS, byte)

    # ------------------------------------------------------------ registers

    async def config(self) -> None:
        """CONFIG; a quick host seldom makes an axis slow."""
        rng, n = self.rng, self.axis()
        await self.lab.axes[n].host.write(
            CONFIG, rng.choice((3, 3, 3, 3, 1)) if self.quick else rng.randrange(4)
        )
        await self.lab.axes[n].host.read(CONFIG)

    async def position(self) -> None:
        """Position register, whole or in part."""
        n = self.axis()
        for k in range(self.rng.choice((1, 1, 4))):
            await self.lab.axes[n].host.read(POSITION + k)

    async def mask(self) -> None:
        """A byte of MASK."""
        k = self.rng.randrange(max(1, self.lab.size // 8))
        few = 1 << self.rng.randrange(8)
        await self.lab.host.write(k << 4 | MASK, self.rng.choice((0, few, few, 255, self.rng.randrange(256))))

    async def go(self) -> None:
        """GO, once or more; a quick host lets none wait for long."""
        for _ in range(self.rng.choice((1, 1, 1, 2, 3))):
            await self.lab.host.write(GO, 0)
        if self.quick and self.rng.random() < 0.7:
            for k in range(max(1, self.lab.size // 8)):
                await self.lab.host.write(k << 4 | MASK, 0)

    async def stop_all(self) -> None:
        """STOP."""
        await self.lab.host.write(STOP, 0)

    async def look(self) -> None:
        """Interrupt map, or any register."""
        k = self.rng.randrange(max(1, self.lab.size // 8))
        await self.lab.host.read(self.rng.choice((k << 4 | MAP, self.rng.randrange(1024))))

    # ------------------------------------------------------------ pins

    async def switch(self) -> None:
        """Some switches move, soon; most go back."""
        rng, side = self.rng, self.side
        for _ in range(rng.choice((1, 1, 2, 6))):
            pin, n = rng.choice(SWITCHES), self.axis()
            t = side.now + rng.randrange(1, 300)
            if rng.random() < 0.85:
                self.background.blip(t, f"{pin}[{n}]", 0, rng.choice((1, 1, 2, 3, 17, 100)))
            else:
                self.background.add(t, **{f"{pin}[{n}]": rng.getrandbits(1)})

    async def calm(self) -> None:
        """All switches idle."""
        await self.side.align()
        self.side.set(**{pin: (1 << self.lab.size) - 1 for pin in SWITCHES})

    async def reset(self) -> None:
        """In the middle of everything."""
        await self.lab.reset(self.rng.choice((2, 3, 9)))
