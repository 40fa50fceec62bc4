"""Parts of random hosts: seed and weights, random pin changes, noise on the bus, a writer of commands."""

from __future__ import annotations

import random
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Protocol, TypeVar

from cocotb.triggers import Timer

from .bench import Bench
from .config import Config
from .player import Action
from .side import Handle, PinChange, Side


class MovingPins:
    """Schedules pin changes on a side; one that is asked for too late comes at once.

    kept: pins that `stop` leaves alone, beside those of the bus, rst_n and rxd. clock: the external clock.
    """

    def __init__(self, side: Side, kept: Sequence[str] = (), clock: str = "extck") -> None:
        self._side, self._pin = side, clock
        self._kept = {*side.part.bus_pins, *kept, "rst_n", "rxd"}
        self._clock: Handle | None = None
        self._later: list[Handle] = []
        self._level = 0

    def add(self, t: int, **levels: int) -> None:
        """Levels from edge t on."""
        self._later.append(self._side.at(max(t, self._side.now), **levels))

    def blip(self, t: int, pin: str, level: int, clk: int) -> None:
        """A pin at `level` for some clk, then at the other one."""
        self.add(t, **{pin: level})
        self.add(t + clk, **{pin: 1 - level})

    def external(self, t: int, on: bool, rng: random.Random) -> None:
        """The external clock from edge t on: runs with a period of its own, with pauses, or stands."""
        if self._clock:
            self._clock.cancel()
        draw = random.Random(rng.random()) if on else None
        low = rng.choice((2, 3, 8, 20))
        period = (low, rng.choice((2, 3, 8, 20)))
        self._clock = self._side.drive(self._ticks(t, period, draw)) if draw else None

    def _ticks(self, t: int, period: tuple[int, int], draw: random.Random) -> Iterator[PinChange]:
        while True:
            self._level ^= 1
            yield t, {self._pin: self._level}
            t += period[self._level]
            if draw.random() < 0.003:
                t += draw.choice((50, 3_000))

    def stop(self) -> None:
        """Nothing moves any more; everything is at its idle level now."""
        for handle in (*self._later, *([self._clock] if self._clock else [])):
            handle.cancel()
        side = self._side
        side.set(**{pin: level for pin, level in side.part.inputs.items() if pin not in self._kept})


UNCOMPARED = "levels change between two edges of clk, where either of the two may see them first"
"""Why runs with this noise are not compared with the golden model."""


class Noise:
    """Drives random levels; each call of `make` goes on where the last one ended.

    strobes: active-low bus pins, each named as often as it shall be drawn. codes: bytes that shall come
    often. switches: all other pins; still: pins that keep their level.
    """

    def __init__(
        self, bench: Bench, strobes: tuple[str, ...], codes: tuple[int, ...], still: tuple[str, ...] = ()
    ) -> None:
        self.bench = bench
        self.rng = random.Random(f"noise {bench.seed}")
        self.still = {pin: bench.pins[pin] for pin in still}
        self._strobes = strobes
        self._codes = codes
        part = bench.part
        others = [pin for pin in part.inputs if pin not in (*part.bus_pins, part.clock, *still)]
        self._switches = tuple(others)

    def _levels(self) -> dict[str, int]:
        """A few pins with new levels; mostly bus pins, so that many bytes come through."""
        rng, part = self.rng, self.bench.part
        kind = rng.random()
        if kind < 0.75:
            byte = rng.choice((*self._codes, rng.getrandbits(8), 3, 4, 4, 0))
            strobe = rng.choice(self._strobes)
            return {"d_i": byte, "a0": rng.getrandbits(1), "cs_n": 0, strobe: rng.getrandbits(1)}
        if kind < 0.9:
            return {part.clock: rng.getrandbits(part.width(part.clock)), rng.choice(self._strobes): 1}
        pin = rng.choice(self._switches)
        width = part.width(pin)
        if width > 2:
            return {pin: rng.getrandbits(width)}
        return {pin: sum((rng.random() < 0.7) << place for place in range(width))}

    async def make(self, clocks: int) -> None:
        """Noise for about `clocks` clk: changes 0.1 to 60 clk apart, at any moment between edges."""
        rng, bench = self.rng, self.bench
        end = bench.now + clocks
        while bench.now < end:
            bench.set_between_edges(**self._levels())
            gap = rng.choice((0.1, 0.4, 1, 1, 2, 2, 3, 7, 20, 60))
            steps = max(2, int(gap * bench.period * rng.random()))
            # Never on a clk edge itself: which side of it a change falls on would be a race.
            offset = (bench.sim_time() + steps - bench.edge_time(0)) % bench.period
            await Timer(steps + (2 if offset < 2 or offset == bench.period - 1 else 0), "ps")

    async def stop(self) -> None:
        """All inputs to their idle levels; 20 clk for the last byte."""
        await self.bench.align()
        self.bench.set(**{**self.bench.part.inputs, **self.still})
        await self.bench.clocks(20)


T = TypeVar("T")
Weights = Sequence[tuple[Config, int]]


def weighted(rng: random.Random, table: Iterable[tuple[T, float]]) -> T:
    """One of a table of (thing, weight)."""
    things, weights = zip(*table, strict=True)
    return rng.choices(things, weights)[0]


class Builds:
    """Which build the host of a seed plays on, where it does not matter for what it does.

    name: of the part in the text of its seeds, as "p312". weights: (build, weight).
    """

    def __init__(self, name: str, weights: Weights) -> None:
        self.name, self.weights = name, tuple(weights)

    def __call__(self, seed: int) -> Config:
        """Build of a seed (any int)."""
        return weighted(random.Random(f"{self.name} build {seed}"), self.weights)

    @property
    def names(self) -> set[str]:
        """All of them."""
        return {config.name for config, _ in self.weights}


def in_turn(*builds: Config) -> Callable[[int], Config]:
    """One build after the other, seed by seed."""
    return lambda seed: builds[seed % len(builds)]


class OnSide(Protocol):
    """The host of a part that a random one speaks through."""

    @property
    def side(self) -> Side:
        """What it works on."""


class RandomHost:
    """`rng` is that of a seed; `name` begins the seed's text.

    One that acts on what it is answered has a `host`, and a `background` of pins that move by themselves.
    """

    host: OnSide
    background: MovingPins

    def __init__(self, name: str, seed: int) -> None:
        self.seed = seed
        self.rng = random.Random(f"{name} {seed}")

    @property
    def model(self) -> Any:
        """The golden model beside the part: it tells when to do something, not what was answered."""
        return self.host.side.golden

    def pick(self, acts: Iterable[tuple[Callable[[], Any], float]]) -> Callable[[], Any]:
        """One of a table of (what to do, weight)."""
        return weighted(self.rng, acts)


class HostWriter(RandomHost, ABC):
    """rng, config, scale (clk per XTAL cycle), externals (clock pins in use), limit_clk, actions so far.

    name: begins the seed text. weights: builds of FAST and of DATASHEET, which one host in ten has. external:
    how probable it is that a clock pin is used, one number a pin.
    """

    def __init__(
        self, name: str, seed: int, weights: Weights, datasheet: Weights, external: Sequence[float] = (0.3,)
    ) -> None:
        super().__init__(f"{name} host", seed)
        rng = self.rng
        self.config = weighted(rng, datasheet if rng.random() < 0.1 else weights)
        self.scale = self.config.clk_hz / self.config.xtal_hz
        self.externals = tuple(rng.random() < chance for chance in external)
        self.limit_clk = round(rng.choice((20_000, 30_000, 50_000)) * max(1.0, self.scale / 2))
        self.actions: list[Action] = []

    @property
    def external(self) -> bool:
        """Whether the first clock pin is used."""
        return self.externals[0]

    @abstractmethod
    def random_write(self) -> tuple[int, int]:
        """A register and a byte for it, at random, sensible ones often."""

    def add(self, *action: Any) -> None:
        """One more action."""
        self.actions.append(action)

    def clk(self, low: int, high: int) -> int:
        """A time given in XTAL cycles, as a random count of clk (log-like: short ones are frequent)."""
        spread = self.rng.random() ** 2
        return max(1, round((low + (high - low) * spread) * self.scale))

    def any_bytes(self) -> None:
        """A few bytes of any kind, slowly."""
        rng = self.rng
        for _ in range(rng.randint(1, 4)):
            reg, byte = self.random_write()
            self.add("write", reg, byte, rng.randint(2, 4), rng.randint(8, 30))
            if rng.random() < 0.6:
                self.add("status", 1)

    def blind(self, writes: list[tuple[int, int]]) -> None:
        """Writes without polling, sometimes too fast for the mailbox."""
        gap = self.rng.choice((2, 3, 4, 8, 12))
        for reg, byte in writes:
            self.add("write", reg, byte, self.rng.randint(2, 3), gap)

    def told(self, code: int, data: list[int], polled: float) -> None:
        """A command with its data bytes, polled with that probability, else blind."""
        if self.rng.random() < polled:
            self.add("send", code, data)
        else:
            self.blind([(1, code), *((0, byte) for byte in data)])

    def overrun(self) -> None:
        """Bytes of any kind, as fast as it goes."""
        self.blind([self.random_write() for _ in range(self.rng.randint(2, 5))])

    def bad_bus(self, codes: tuple[int, ...]) -> None:
        """Both strobes together, a strobe cut by cs_n or by the other strobe (P104-BAD-08, STMC-BAD-12)."""
        rng = self.rng
        byte, reg = rng.choice(codes), rng.getrandbits(1)
        on = {"cs_n": 0, "a0": reg, "d_i": byte}
        off = {"cs_n": 1, "rd_n": 1, "wr_n": 1}
        steps = rng.choice(
            (
                [({**on, "rd_n": 0, "wr_n": 0}, rng.randint(2, 10)), (off, 3)],
                [({**on, "wr_n": 0}, 3), ({"rd_n": 0}, 3), (off, 4)],
                [({**on, "wr_n": 0}, 3), ({"cs_n": 1}, 3), (off, 3)],
                [({**on, "rd_n": 0}, 4), ({"wr_n": 0}, 3), (off, 4)],
                [({**on, "rd_n": 0}, 5), ({"cs_n": 1}, 3), (off, 3)],
                [({"wr_n": 0, "d_i": byte}, 4), (off, 3)],
            )
        )
        self.add("raw", steps)
