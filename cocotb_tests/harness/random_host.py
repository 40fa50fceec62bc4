"""Building blocks of random hosts: seeds, weights, random pin changes, bus noise, a writer of commands."""

from __future__ import annotations

import random
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Protocol, TypeVar

from cocotb.triggers import Timer

from .config import Config
from .dut_bench import DutBench, Handle, PinChange
from .player import Action
from .rtl_bench import RtlBench


class MovingPins:
    """Schedules pin changes on a bench; a change in the past is made immediately.

    Args:
        kept: pins that `stop` does not change, in addition to those of the bus, rst_n and rxd.
        clock: name of the pin of the external clock.
    """

    def __init__(self, bench: DutBench, kept: Sequence[str] = (), clock: str = "extck") -> None:
        self._bench, self._pin = bench, clock
        self._kept = {*bench.part.bus_pins, *kept, "rst_n", "rxd"}
        self._clock: Handle | None = None
        self._later: list[Handle] = []
        self._level = 0

    def add(self, t: int, **levels: int) -> None:
        """Schedule levels of pins for edge t."""
        self._later.append(self._bench.at(max(t, self._bench.now), **levels))

    def blip(self, t: int, pin: str, level: int, clk: int) -> None:
        """Hold a pin at `level` for `clk` cycles, then set the opposite level."""
        self.add(t, **{pin: level})
        self.add(t + clk, **{pin: 1 - level})

    def external(self, t: int, on: bool, rng: random.Random) -> None:
        """Start or stop the external clock at edge t.

        A running clock has a random period and random pauses.
        """
        if self._clock:
            self._clock.cancel()
        draw = random.Random(rng.random()) if on else None
        low = rng.choice((2, 3, 8, 20))
        period = (low, rng.choice((2, 3, 8, 20)))
        self._clock = self._bench.drive(self._ticks(t, period, draw)) if draw else None

    def _ticks(self, t: int, period: tuple[int, int], draw: random.Random) -> Iterator[PinChange]:
        while True:
            self._level ^= 1
            yield t, {self._pin: self._level}
            t += period[self._level]
            if draw.random() < 0.003:
                t += draw.choice((50, 3_000))

    def stop(self) -> None:
        """Stop all changes and set all pins to their idle levels."""
        for handle in (*self._later, *([self._clock] if self._clock else [])):
            handle.cancel()
        bench = self._bench
        bench.set(**{pin: level for pin, level in bench.part.inputs.items() if pin not in self._kept})


UNCOMPARED = "levels change between two edges of clk, and either edge may sample them first"
"""Reason why runs with this noise are not compared with the golden model."""


class PinNoise:
    """Drives random levels. Each call of `make` continues the sequence of the previous call.

    Args:
        strobes: active-low bus pins; a pin that is listed more often is drawn more often.
        codes: bytes that are drawn often.
        still: pins that keep their level. All other pins except the bus and the clock are driven as switches.
    """

    def __init__(
        self, bench: RtlBench, strobes: tuple[str, ...], codes: tuple[int, ...], still: tuple[str, ...] = ()
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
        """Draw new levels for a few pins, mostly bus pins so that the device accepts many bytes."""
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
        """Drive noise for about `clocks` cycles, with changes at any time between edges.

        The changes are up to 60 cycles apart.
        """
        rng, bench = self.rng, self.bench
        end = bench.now + clocks
        while bench.now < end:
            bench.set_between_edges(**self._levels())
            gap = rng.choice((0.1, 0.4, 1, 1, 2, 2, 3, 7, 20, 60))
            steps = max(2, int(gap * bench.period * rng.random()))
            # No change coincides with an edge of `clk`: the edge could sample the level before or after the
            # change.
            offset = (bench.sim_time() + steps - bench.edge_time(0)) % bench.period
            await Timer(steps + (2 if offset < 2 or offset == bench.period - 1 else 0), "ps")

    async def stop(self) -> None:
        """Set all inputs to their idle levels; wait 20 cycles, in which the device accepts the last byte."""
        await self.bench.align()
        self.bench.set(**{**self.bench.part.inputs, **self.still})
        await self.bench.clocks(20)


T = TypeVar("T")
Weights = Sequence[tuple[Config, int]]


def weighted(rng: random.Random, table: Iterable[tuple[T, float]]) -> T:
    """Draw a random entry of a table of (entry, weight)."""
    things, weights = zip(*table, strict=True)
    return rng.choices(things, weights)[0]


class Builds:
    """Selects the build of a seed, for hosts whose actions do not depend on the build.

    Args:
        name: name of the device in the text of its seeds, such as "p312".
        weights: pairs (build, weight).
    """

    def __init__(self, name: str, weights: Weights) -> None:
        self.name, self.weights = name, tuple(weights)

    def __call__(self, seed: int) -> Config:
        """Return the build of a seed (any int)."""
        return weighted(random.Random(f"{self.name} build {seed}"), self.weights)

    @property
    def names(self) -> set[str]:
        """Names of all builds that seeds can select."""
        return {config.name for config, _ in self.weights}


def in_turn(*builds: Config) -> Callable[[int], Config]:
    """Return a function that assigns the builds in turn to successive seeds."""
    return lambda seed: builds[seed % len(builds)]


class HostProtocol(Protocol):
    """Host of a device, through which a random host makes its accesses."""

    @property
    def bench(self) -> DutBench:
        """Bench on which the host works."""


class RandomHost:
    """A host whose random numbers `rng` depend on a seed; `name` is the first word of the seed's text.

    A host that reacts to responses has a `host`, which makes its accesses, and a `background` of pins that
    move independently.
    """

    host: HostProtocol
    background: MovingPins

    def __init__(self, name: str, seed: int) -> None:
        self.seed = seed
        self.rng = random.Random(f"{name} {seed}")

    @property
    def model(self) -> Any:
        """Golden model of the device.

        The host uses it only to decide when to act; it reads responses from the device.
        """
        return self.host.bench.golden

    def pick(self, actions: Iterable[tuple[Callable[[], Any], float]]) -> Callable[[], Any]:
        """Draw a function from a table of (function, weight) and return it."""
        return weighted(self.rng, actions)


class HostWriter(RandomHost, ABC):
    """Writes action lists.

    Attributes: rng, config, scale (cycles of `clk` per XTAL cycle), externals (for each clock pin: True if it
    is used), limit_clk (time limit of a poll in cycles), actions (appended so far).

    Args:
        name: first word of the seed text.
        weights: weights of the FAST builds.
        datasheet: weights of the DATASHEET builds, which one host in ten uses.
        external: probability that a clock pin is used, one number per pin.
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
        """Draw a register and a byte for it, often a sensible byte."""

    def add(self, *action: Any) -> None:
        """Append an action."""
        self.actions.append(action)

    def clk(self, low: int, high: int) -> int:
        """Draw a time of `low` to `high` XTAL cycles; return it in cycles of `clk`.

        Short times are frequent.
        """
        spread = self.rng.random() ** 2
        return max(1, round((low + (high - low) * spread) * self.scale))

    def any_bytes(self) -> None:
        """Write a few arbitrary bytes, slowly."""
        rng = self.rng
        for _ in range(rng.randint(1, 4)):
            reg, byte = self.random_write()
            self.add("write", reg, byte, rng.randint(2, 4), rng.randint(8, 30))
            if rng.random() < 0.6:
                self.add("status", 1)

    def blind(self, writes: list[tuple[int, int]]) -> None:
        """Write without polling; some writes are too fast for the mailbox."""
        gap = self.rng.choice((2, 3, 4, 8, 12))
        for reg, byte in writes:
            self.add("write", reg, byte, self.rng.randint(2, 3), gap)

    def send_command(self, code: int, data: list[int], polled: float) -> None:
        """Send a command with its data bytes.

        With the probability `polled` the host polls IBF = 0 after each byte; otherwise it does not poll.
        """
        if self.rng.random() < polled:
            self.add("send", code, data)
        else:
            self.blind([(1, code), *((0, byte) for byte in data)])

    def overrun(self) -> None:
        """Write arbitrary bytes as fast as possible."""
        self.blind([self.random_write() for _ in range(self.rng.randint(2, 5))])

    def bad_bus(self, codes: tuple[int, ...]) -> None:
        """Assert both strobes, or end a strobe by cs_n or by the other strobe (P104-BAD-08, STMC-BAD-12)."""
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
