"""The chopper of an axis of the bank: each edge is ordered at a visit (BANK-CHP-01)."""

from __future__ import annotations

from ..chip import Context, Phase
from ..clock import Event
from ..motion import excitation
from ..motion.excitation import Switching

# When each axis is visited (BANK-GEN-01), and the times between a cause and the visits that know of it.

SHORTEST_ROUND = 8
FIRST = 8

BYTE_LEAD = 7
"""Write event to the first visit that sees the byte (BANK-HSK-01)."""
END_LEAD = 5
"""Decided end of a motion to the first visit that knows (BANK-MOT-03)."""
BUILD_LEAD = 2
"""End of a build to the first visit that may begin the next one (BANK-INI-01)."""
READY_LEAD = 3
"""End of a build to the first visit that completes the initialisation (BANK-INI-02)."""
GROUP_LEAD = 5
"""Write event of MASK or GO to the first visit that sees it (BANK-GRP-01, -02)."""
CONFIG_LEAD = 7
"""Write event of CONFIG to the first visit that sees it (BANK-GEN-04)."""
SWITCH_LEAD = 4
"""Edge on which a switch is seen to the first visit that sees it (BANK-MOT-05)."""


def round_clk(axes: int) -> int:
    """R: length of a round in clk."""
    return max(axes, SHORTEST_ROUND)


class Visits:
    """The visits of axis `axis`, edges axis + 8 + n R after `released`, n = 1, 2, …"""

    def __init__(self, axis: int, axes: int, released: int) -> None:
        self.round = round_clk(axes)
        self._start = released + axis + FIRST + self.round

    def first(self, edge: int) -> int:
        """First visit at or after an edge."""
        return self._start + max(0, -(-(edge - self._start) // self.round)) * self.round

    def last(self, edge: int) -> int:
        """Last visit at or before an edge; what is due on that edge is ordered there."""
        return self._start + (edge - self._start) // self.round * self.round


class Chopper(excitation.Chopper):
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
