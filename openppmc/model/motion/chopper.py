"""Stop-time switching of the phase outputs (P104-SW-01..07, P2104-SW-01..05)."""

from __future__ import annotations

from typing import Protocol

from ..common.blocks import Context, Phase
from ..common.scheduler import Event


class Switching(Protocol):
    """The times of a part."""

    def quanta(self, on: bool) -> int:
        """Length in quanta of an ON or OFF phase that begins now."""


class Chopper:
    """Alternates ON and OFF phases, counted in ticks of the quantum counter, while it is allowed to run.

    `due`: edge on which the next phase begins, None while it does not run.
    """

    def __init__(self, context: Context, times: Switching) -> None:
        self._context = context
        self._times = times
        self.on = True
        self.due: int | None = None
        self._tick = 0
        self._event: Event | None = None

    def start(self, t: int) -> None:
        """Begin with a complete ON phase at edge t (P104-SW-02)."""
        self.stop()
        self._tick = self._context.counter.last_tick(t)
        self._plan()

    def stop(self) -> None:
        """Full pattern, no switching (P104-SW-03)."""
        if self._event:
            self._event.cancel()
            self._event = None
        self.due = None
        self.on = True

    def _plan(self) -> None:
        self._tick += self._length()
        self.due = self._context.counter.edge_of(self._tick)
        self._event = self._context.queue.at(self.due, Phase.CHOPPER, self._boundary)

    def _length(self) -> int:
        """Quanta of the phase that begins now."""
        return self._times.quanta(self.on)

    def _boundary(self, t: int) -> None:
        self.on = not self.on
        self._plan()
