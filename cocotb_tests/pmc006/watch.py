"""What a script sees of the outputs of a PMC006: edges, steps, references; with what is asked most often."""

from __future__ import annotations

from bisect import bisect_left
from collections import defaultdict
from fractions import Fraction
from typing import Any

from .frames import signed


class Watch:
    """The seeing half of `Host`."""

    clk_hz: int
    mark: int

    def watch(self, model: Any) -> None:
        """From now on."""
        self._log, self._place = model.log, 0
        self._steps: list[int] = []
        self._changes: dict[str, list[tuple[int, int]]] = defaultdict(list)

    # What the other half has.
    def ask(self, code: str | int, data: int = 0) -> int:
        """See `Host`."""
        raise NotImplementedError

    def _scan(self) -> None:
        """Take what the log has got up to the present; what is later may still change."""
        edges, now = self._log.edges, self.model.now  # type: ignore[attr-defined]
        place, last = self._place, len(edges)
        while place < last and edges[place].t <= now:
            t, name, value = edges[place]
            self._changes[name].append((t, value))
            if value and name == "mon_step":
                self._steps.append(t)
            place += 1
        self._place = place

    def edges(self, signal: str, since: int = 0) -> list[tuple[int, int]]:
        """Changes (t, level) of an output from edge `since` on, up to the present."""
        self._scan()
        changes = self._changes[signal]
        return changes[bisect_left(changes, (since, 0)) :]

    def level_at(self, signal: str, t: int) -> int:
        """Level of an output after edge t."""
        changes = [value for at, value in self.edges(signal) if at <= t]
        return changes[-1] if changes else int(self._log.initial[signal])

    # ------------------------------------------------------------------ steps

    def steps(self, since: int | None = None) -> list[int]:
        """Edges with mon_step since `mark`."""
        self._scan()
        return self._steps[bisect_left(self._steps, self.mark if since is None else since) :]

    def made(self, since: int | None = None) -> int:
        """Their number."""
        self._scan()
        return len(self._steps) - bisect_left(self._steps, self.mark if since is None else since)

    def last_steps(self, count: int) -> list[int]:
        """The last ones since `mark`, at most `count`."""
        return self._steps[-min(count, self.made()) :] if self.made() else []

    def intervals(self, since: int | None = None) -> list[int]:
        """Their distances in us; one that is more than a clk from whole us is an error."""
        edges = self.steps(since)
        return [self.in_us(b - a) for a, b in zip(edges, edges[1:], strict=False)]

    def in_us(self, clk: int) -> int:
        """clk as whole us; AssertionError if it is more than a clk from that."""
        micros = round(Fraction(clk * 1_000_000, self.clk_hz))
        assert abs(clk - Fraction(micros * self.clk_hz, 1_000_000)) <= 1, f"{clk} clk are not whole us"
        return micros

    # ------------------------------------------------------------------ references

    def refs(self) -> tuple[int, int, int, int]:
        """Reference and sign of phase A, of phase B."""
        names = ("phase_a_ref", "phase_a_sign", "phase_b_ref", "phase_b_sign")
        self.sync()  # type: ignore[attr-defined]
        levels = self.model.outputs  # type: ignore[attr-defined]
        a, sign_a, b, sign_b = (levels[name] for name in names)
        return a, sign_a, b, sign_b

    # ------------------------------------------------------------------ registers

    def status(self) -> int:
        """Status 1."""
        return self.ask("j")

    @property
    def busy(self) -> bool:
        """Level of mon_busy."""
        return bool(self.out("mon_busy"))  # type: ignore[attr-defined]

    def position(self) -> int:
        """POS, signed."""
        return signed(self.ask("c"))

    def ok(self, **settings: int) -> None:
        """Write settings by their letters; each reply has to echo what was sent."""
        for code, value in settings.items():
            got = signed(self.ask(code, value))
            assert got == value, f"{code} {value} -> {got}"
