"""The chopper of an axis of the bank: each edge is ordered at a visit (BANK-CHP-01)."""

from __future__ import annotations

from ..common.blocks import Context, Phase
from ..common.scheduler import Event
from ..motion import chopper
from ..motion.chopper import Switching
from .visits import Visits


class Chopper(chopper.Chopper):
    """As that of the PPMC-104; the length of a phase is found at the visit that orders its first edge."""

    def __init__(self, context: Context, times: Switching, visits: Visits) -> None:
        super().__init__(context, times)
        self._visits = visits
        self._boundary_edge = -1
        self._found: int | None = None
        self._ordering: Event | None = None

    def orders(self, visit: int) -> bool:
        """Whether this visit orders an edge (BANK-HSK-02)."""
        return self._boundary_edge == visit or (
            self.due is not None and self.due < visit + self._visits.round
        )

    def stop(self) -> None:
        """As there."""
        super().stop()
        if self._ordering:
            self._ordering.cancel()
        self._boundary_edge, self._found = -1, None

    def _plan(self) -> None:
        super()._plan()
        assert self.due is not None
        self._ordering = self._context.queue.at(self._visits.last(self.due), Phase.QUEUE, self._order)

    def _order(self, t: int) -> None:
        """BANK-GEN-04: vsel and the parameters as this visit finds them."""
        self._found = self._times.quanta(not self.on)

    def _length(self) -> int:
        return super()._length() if self._found is None else self._found

    def _boundary(self, t: int) -> None:
        self._boundary_edge = t
        super()._boundary(t)
