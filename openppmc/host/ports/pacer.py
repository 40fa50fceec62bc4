"""Keeps the virtual time of a model beside the clock on the wall."""

from __future__ import annotations

import time

SLICE = 0.01
"""Seconds of wall time between two looks."""
_LAG = 0.25


class Pacer:
    """speed: virtual seconds a second; None: as fast as it goes."""

    def __init__(self, speed: float | None) -> None:
        self.speed = speed
        self._origin = time.monotonic()

    def step(self, left: float) -> float:
        """How much of `left` virtual seconds may pass before the next look."""
        return left if self.speed is None else min(left, SLICE * self.speed)

    def wait(self, seconds: float) -> None:
        """Do not run ahead of the wall clock; forget the lag of a model that cannot keep up."""
        if self.speed is None:
            return
        ahead = seconds / self.speed - (time.monotonic() - self._origin)
        if ahead > 0:
            time.sleep(ahead)
        elif ahead < -_LAG:
            self._origin -= ahead

    def behind(self, seconds: float) -> float:
        """Virtual seconds that went by on the wall while the program did something else, 0 if few."""
        if self.speed is None:
            return 0.0
        behind = (time.monotonic() - self._origin) * self.speed - seconds
        return behind if behind > SLICE else 0.0
