"""Filters of the keys of the PMC006B4: GPI1, GPI2 and FSET (P006-PRG-30, P006-EEP-20)."""

from __future__ import annotations

from collections.abc import Callable

from ...common.blocks import Phase
from ...common.scheduler import Event
from ..pins import Shared


class KeyFilter:
    """An input, active low, that counts only when it has kept its level for a number of µs ticks.

    pressed(t): it has been low that long and was armed. released(t): it has been high that long; a key is
    armed by that. high_ticks 0: by any high level, at once. armed: from the beginning on.
    """

    def __init__(
        self,
        shared: Shared,
        low_ticks: int,
        high_ticks: int,
        pressed: Callable[[int], None],
        released: Callable[[int], None] | None = None,
        armed: bool = False,
    ) -> None:
        self._shared, self._ticks = shared, (low_ticks, high_ticks)
        self._pressed, self._released = pressed, released
        self.armed = armed
        self._level: int | None = None
        self._pending: Event | None = None

    def see(self, t: int, level: int) -> None:
        """Synchronised level from edge t on."""
        if level == self._level:
            return
        self._level = level
        if self._pending:
            self._pending.cancel()
            self._pending = None
        ticks = self._ticks[level]
        if not ticks:
            self._elapsed(t)
            return
        us = self._shared.us
        at = us.edge_of(us.first(t) + ticks - 1)
        self._pending = self._shared.queue.at(at, Phase.QUEUE, self._elapsed)

    def _elapsed(self, t: int) -> None:
        self._pending = None
        if self._level:
            self.armed = True
            if self._released:
                self._released(t)
        elif self.armed:
            self.armed = False
            self._pressed(t)
