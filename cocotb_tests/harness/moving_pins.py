"""Pins that move by themselves while a random host is at work."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence

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
