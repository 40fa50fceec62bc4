"""Square wave of a phase accumulator: adds twice its frequency every clk, toggles on each wrap."""

from __future__ import annotations


class Square:
    """Toggle n = 1, 2, .. comes ceil(n * clk_hz / (2 * hz)) clk after edge `origin`; low before the first.

    clk_hz and hz in Hz, hz 1..clk_hz/4 (ValueError outside).
    """

    def __init__(self, clk_hz: int, hz: int, origin: int = 0) -> None:
        if not 1 <= hz <= clk_hz // 4:
            raise ValueError(f"a square wave of {hz} Hz from a clk of {clk_hz} Hz")
        self._clk_hz, self._hz, self.origin = clk_hz, hz, origin
        self._n = 1

    @property
    def next_edge(self) -> int:
        """Edge of the next toggle."""
        return self.origin - (-self._n * self._clk_hz // (2 * self._hz))

    @property
    def next_level(self) -> int:
        """Level from that edge on."""
        return self._n & 1

    def advance(self) -> None:
        """The next toggle has been dealt with."""
        self._n += 1

    def restart(self, origin: int) -> None:
        """Begin anew, low, at edge `origin`."""
        self.origin, self._n = origin, 1
