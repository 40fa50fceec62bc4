"""`HostWriter`: what the writers of random hosts have in common; each makes the action list of one seed.

Every random decision comes from `rng`, in one order, so that a seed always gives the same list.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

from .player import Action
from .random_host import RandomHost, Weights, weighted


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
