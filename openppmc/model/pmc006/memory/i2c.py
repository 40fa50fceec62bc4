"""I2C master of the PMC006B4 on the level of quarter bits (P006 chapter 13.1).

What a master does is told by generators: each `yield` waits for the next quarter tick, and what follows it
happens on that tick's edge.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from fractions import Fraction
from math import ceil
from typing import TypeVar

from ...common.blocks import Phase
from ..pins import Shared, Ticks

R = TypeVar("R")
Course = Generator[None, None, R]
LOW = Fraction(55, 100)
"""Part of a period for which SCL is low: two quarters and a little."""


class BusError(Exception):
    """SCL was held low for too long, or nobody answered."""


class Bus:
    """The two lines. levels: their synchronised levels. hz: of SCL. tick: number of the present quarter tick.

    per_ms: quarter ticks of a millisecond.
    """

    def __init__(self, shared: Shared, levels: Mapping[str, int], hz: int) -> None:
        self._shared, self._levels = shared, levels
        self._ticks = Ticks(shared.clk_hz, 4 * hz, shared.us.origin)
        self._late = ceil(Fraction(LOW * shared.clk_hz, hz)) - shared.clk_hz // (2 * hz)
        self.hz = hz
        self.tick = 0

    @property
    def per_ms(self) -> int:
        """Quarter ticks of a millisecond."""
        return 4 * self.hz // 1000

    # ------------------------------------------------------------------ time

    def begin(self, t: int, course: Course[None], ended: Callable[[int], None]) -> None:
        """A course whose first tick is the first one at or after edge t. ended(t): on its last tick."""
        next(course)
        self._wait(self._ticks.first(t), course, ended)

    def _wait(self, tick: int, course: Course[None], ended: Callable[[int], None]) -> None:
        at = self._ticks.edge_of(tick)
        self._shared.queue.at(at, Phase.FLAG, lambda now: self._resume(now, tick, course, ended))

    def _resume(self, t: int, tick: int, course: Course[None], ended: Callable[[int], None]) -> None:
        self.tick, self._now = tick, t
        try:
            next(course)
        except StopIteration:
            ended(t)
        else:
            self._wait(tick + 1, course, ended)

    # ------------------------------------------------------------------ lines

    def level(self, pin: str) -> int:
        """What a pin is like."""
        return self._levels[pin]

    def let_go(self) -> None:
        """Both lines are high as far as this side is concerned."""
        self._drive("scl", 1)
        self._drive("sda", 1)

    def _drive(self, line: str, level: int) -> None:
        self._shared.log.set(self._now, f"{line}_oe", int(not level))

    def _release(self) -> None:
        """SCL may go high, once it was low for long enough."""
        at = self._now + self._late
        self._shared.queue.at(at, Phase.PIN, lambda now: self._shared.log.set(now, "scl_oe", 0))

    def _rise(self) -> Course[None]:
        """Wait until SCL is high; it may be held low for a millisecond."""
        for _ in range(self.per_ms + 1):
            yield
            if self._levels["scl_i"]:
                return
        raise BusError

    # ------------------------------------------------------------------ what a master can do

    def start(self) -> Course[None]:
        """START, also a repeated one."""
        yield
        self._drive("sda", 1)
        yield
        self._release()
        yield from self._rise()
        yield
        self._drive("sda", 0)
        yield
        yield
        self._drive("scl", 0)

    def stop(self) -> Course[None]:
        """STOP."""
        yield
        self._drive("scl", 0)
        self._drive("sda", 0)
        yield
        self._release()
        yield from self._rise()
        yield
        self._drive("sda", 1)
        yield
        yield

    def bit(self, level: int) -> Course[int]:
        """Send a bit, or receive one (level 1)."""
        yield
        got = yield from self._bit_now(level)
        yield
        self._drive("scl", 0)
        return got

    def _bit_now(self, level: int) -> Course[int]:
        """The same from its first tick to the one that samples."""
        self._drive("scl", 0)
        self._drive("sda", level)
        yield
        self._release()
        yield from self._rise()
        return self._levels["sda_i"]

    def write(self, byte: int | Callable[[], int]) -> Course[bool]:
        """Send a byte; whether it was acknowledged. A function is asked for it on its first tick."""
        yield
        value = byte if isinstance(byte, int) else byte()
        for place in reversed(range(8)):
            if place < 7:
                yield
            yield from self._bit_now(value >> place & 1)
            yield
            self._drive("scl", 0)
        return not (yield from self.bit(1))

    def read(self, last: bool) -> Course[int]:
        """Receive a byte; the last one is not acknowledged."""
        byte = 0
        for _ in range(8):
            byte = byte << 1 | (yield from self.bit(1))
        yield from self.bit(int(last))
        return byte

    def clear(self) -> Course[None]:
        """Up to 9 pulses of SCL for a device that holds SDA, then STOP (13.2, step 2)."""
        for _ in range(8):
            if (yield from self.bit(1)):
                break
        else:
            yield
            got = yield from self._bit_now(1)
            yield
            if not got:
                raise BusError
            self._drive("scl", 0)
        yield from self.stop()
