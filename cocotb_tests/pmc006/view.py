"""Outputs of a PMC006 as the hosts of tests use them: edges, steps, references, frequently read registers."""

from __future__ import annotations

from abc import ABC, abstractmethod
from fractions import Fraction
from math import ceil

from cocotb_tests.harness import DutBench

from .frames import signed


class View(ABC):
    """Functions of `Host` that read outputs and registers.

    Attributes:
        t: next free edge.
        mark: edge from which steps count.
    """

    bench: DutBench
    clk_hz: int
    t: int
    mark: int

    # Methods of `Host`.
    @abstractmethod
    async def ask(self, code: str | int, data: int = 0) -> int:
        """Send a frame and return its reply data (see `Host`)."""

    @abstractmethod
    async def sync(self) -> None:
        """Run the part to the present edge (see `Host`)."""

    # ------------------------------------------------------------------ outputs

    def edges(self, signal: str, since: int = 0) -> list[tuple[int, int]]:
        """Return the changes (t, level) of an output from edge `since` to the present edge."""
        return self.bench.edges(signal, since)

    def level_at(self, signal: str, t: int) -> int:
        """Return the level of an output after edge t."""
        return self.bench.level_at(signal, t)

    async def out(self, signal: str) -> int:
        """Return the current level of an output."""
        await self.sync()
        return self.bench.level(signal)

    async def busy(self) -> bool:
        """Return the level of mon_busy."""
        return bool(await self.out("mon_busy"))

    async def until(self, signal: str, level: int, limit_us: float = 1_000_000) -> int:
        """Run until an output has this level; return the edge of its last change."""
        await self.sync()
        self.t = max(self.t, await self.bench.level_is(signal, level, self.us(limit_us)))
        return max((t for t, _ in self.edges(signal)[-1:]), default=0)

    # ------------------------------------------------------------------ times

    def us(self, micros: float | Fraction) -> int:
        """Return the cycles of `micros` microseconds, rounded up."""
        return ceil(Fraction(micros) * self.clk_hz / 1_000_000)

    def in_us(self, clk: int) -> int:
        """Convert cycles to whole us.

        Raises AssertionError if the cycles deviate from whole us by more than one cycle.
        """
        micros = round(Fraction(clk * 1_000_000, self.clk_hz))
        assert abs(clk - Fraction(micros * self.clk_hz, 1_000_000)) <= 1, f"{clk} cycles are not whole us"
        return micros

    # ------------------------------------------------------------------ steps

    def steps(self, since: int | None = None) -> list[int]:
        """Return the edges of steps (rising edges of mon_step) since `mark`."""
        return self.bench.rises("mon_step", self.mark if since is None else since)

    def step_count(self, since: int | None = None) -> int:
        """Return the number of steps since `mark`."""
        return len(self.steps(since))

    def intervals(self, since: int | None = None) -> list[int]:
        """Return the intervals of the steps in us; each must be a whole number of us within one cycle."""
        edges = self.steps(since)
        return [self.in_us(b - a) for a, b in zip(edges, edges[1:], strict=False)]

    async def next_steps(self, limit: int) -> list[int]:
        """Run to the next step, which must occur before edge `limit`; process at least the present edge.

        Returns:
            The new steps, one or more.
        """
        since = self.bench.now
        await self.bench.edge("mon_step", 1, max(1, limit - since))
        self.t = max(self.t, self.bench.now)
        await self.sync()
        return self.steps(since)

    # ------------------------------------------------------------------ references

    async def refs(self) -> tuple[int, int, int, int]:
        """Return the reference and the sign of phase A, then of phase B."""
        await self.sync()
        level = self.bench.level
        return (
            level("phase_a_ref"),
            level("phase_a_sign"),
            level("phase_b_ref"),
            level("phase_b_sign"),
        )

    # ------------------------------------------------------------------ registers

    async def status(self) -> int:
        """Return status 1."""
        return await self.ask("j")

    async def position(self) -> int:
        """Return the signed position POS."""
        return signed(await self.ask("c"))

    async def ok(self, **settings: int) -> None:
        """Write settings, which are named by their letters; each reply must echo the data."""
        for code, value in settings.items():
            got = signed(await self.ask(code, value))
            assert got == value, f"{code} {value} -> {got}"
