"""Pins that move by themselves while a script's host is at work on the golden model."""

from __future__ import annotations

import heapq
import random
from collections.abc import Sequence
from typing import Any


class Background:
    """Puts scheduled pin changes in front of whatever is done to a model at that time or later.

    kept: pins that `stop` leaves alone, beside those of the bus, rst_n and rxd.
    """

    def __init__(self, model: Any, kept: Sequence[str] = ()) -> None:
        self._kept = {*model.HOST_PINS, *kept, "rst_n", "rxd"}
        self._pins, self._run = model.pins, model.run_until
        self._model = model
        self._heap: list[tuple[int, int, dict[str, int]]] = []
        self._count = 0
        self._clock: random.Random | None = None
        self._level = 0
        self._next = 0
        self._period = (10, 10)
        model.pins, model.run_until = self._pin, self._run_until

    def add(self, t: int, **levels: int) -> None:
        """Levels from edge t on."""
        self._count += 1
        heapq.heappush(self._heap, (t, self._count, levels))

    def blip(self, t: int, pin: str, level: int, clk: int) -> None:
        """A pin at `level` for some clk, then at the other one."""
        self.add(t, **{pin: level})
        self.add(t + clk, **{pin: 1 - level})

    def external(self, t: int, on: bool, rng: random.Random) -> None:
        """extck from edge t on: runs with a period of its own, with pauses, or stands."""
        self._clock = random.Random(rng.random()) if on else None
        self._next = max(t, self._model.now + 1)
        low = rng.choice((2, 3, 8, 20))
        self._period = (low, rng.choice((2, 3, 8, 20)))

    def stop(self, t: int) -> None:
        """Nothing moves any more; everything is at its idle level from edge t on."""
        self._heap.clear()
        self._clock = None
        self._pin(t, **{pin: level for pin, level in self._model.INPUTS.items() if pin not in self._kept})

    def _due(self, t: int) -> None:
        """Everything before edge t, and at it."""
        while True:
            at = self._heap[0][0] if self._heap else t + 1
            clock = self._next if self._clock else t + 1
            first = min(at, clock)
            if first > t:
                return
            levels: dict[str, int] = {}
            while self._heap and self._heap[0][0] == first:
                levels |= heapq.heappop(self._heap)[2]
            if self._clock and clock == first:
                self._level ^= 1
                levels["extck"] = self._level
                self._next += self._period[self._level]
                if self._clock.random() < 0.003:
                    self._next += self._clock.choice((50, 3_000))
            if first > self._model.now:
                self._pins(first, **levels)
            else:
                self._pins(self._model.now + 1, **levels)

    def _pin(self, t: int, **levels: int) -> None:
        self._due(t)
        self._pins(max(t, self._model.now + 1), **levels)

    def _run_until(self, t: int) -> None:
        self._due(t)
        if t >= self._model.now:
            self._run(t)
