"""What a host sees of the outputs of a PMC006: edges, steps, references; with what is asked most often."""

from __future__ import annotations

from abc import ABC, abstractmethod
from fractions import Fraction
from math import ceil

from cocotb_tests.harness import Side

from .frames import signed


class View(ABC):
    """The seeing half of `Host`. `t`: its next free edge; `mark`: where the counting of steps begins."""

    side: Side
    clk_hz: int
    t: int
    mark: int

    # What the other half has.
    @abstractmethod
    async def ask(self, code: str | int, data: int = 0) -> int:
        """See `Host`."""

    @abstractmethod
    async def sync(self) -> None:
        """See `Host`."""

    # ------------------------------------------------------------------ outputs

    def edges(self, signal: str, since: int = 0) -> list[tuple[int, int]]:
        """Changes (t, level) of an output from edge `since` on, up to the present."""
        return self.side.edges(signal, since)

    def level_at(self, signal: str, t: int) -> int:
        """Level of an output after edge t."""
        return self.side.level_at(signal, t)

    async def out(self, signal: str) -> int:
        """Present output level."""
        await self.sync()
        return self.side.level(signal)

    async def busy(self) -> bool:
        """Level of mon_busy."""
        return bool(await self.out("mon_busy"))

    async def until(self, signal: str, level: int, limit_us: float = 1_000_000) -> int:
        """Run until an output has this level; returns the edge on which it took it, the last one."""
        await self.sync()
        self.t = max(self.t, await self.side.level_is(signal, level, self.us(limit_us)))
        return max((t for t, _ in self.edges(signal)[-1:]), default=0)

    # ------------------------------------------------------------------ times

    def us(self, micros: float | Fraction) -> int:
        """clk of so many us, rounded up."""
        return ceil(Fraction(micros) * self.clk_hz / 1_000_000)

    def in_us(self, clk: int) -> int:
        """clk as whole us; AssertionError if it is more than a clk from that."""
        micros = round(Fraction(clk * 1_000_000, self.clk_hz))
        assert abs(clk - Fraction(micros * self.clk_hz, 1_000_000)) <= 1, f"{clk} clk are not whole us"
        return micros

    # ------------------------------------------------------------------ steps

    def steps(self, since: int | None = None) -> list[int]:
        """Edges with mon_step since `mark`."""
        return self.side.rises("mon_step", self.mark if since is None else since)

    def made(self, since: int | None = None) -> int:
        """Their number."""
        return len(self.steps(since))

    def intervals(self, since: int | None = None) -> list[int]:
        """Their distances in us; one that is more than a clk from whole us is an error."""
        edges = self.steps(since)
        return [self.in_us(b - a) for a, b in zip(edges, edges[1:], strict=False)]

    async def next_steps(self, limit: int) -> list[int]:
        """Run to the next step, which comes before edge `limit`, but at least to the present; returns it, or
        all of them."""
        since = self.side.now
        await self.side.edge("mon_step", 1, max(1, limit - since))
        self.t = max(self.t, self.side.now)
        await self.sync()
        return self.steps(since)

    # ------------------------------------------------------------------ references

    async def refs(self) -> tuple[int, int, int, int]:
        """Reference and sign of phase A, of phase B."""
        await self.sync()
        level = self.side.level
        return (
            level("phase_a_ref"),
            level("phase_a_sign"),
            level("phase_b_ref"),
            level("phase_b_sign"),
        )

    # ------------------------------------------------------------------ registers

    async def status(self) -> int:
        """Status 1."""
        return await self.ask("j")

    async def position(self) -> int:
        """POS, signed."""
        return signed(await self.ask("c"))

    async def ok(self, **settings: int) -> None:
        """Write settings by their letters; each reply has to echo what was sent."""
        for code, value in settings.items():
            got = signed(await self.ask(code, value))
            assert got == value, f"{code} {value} -> {got}"
