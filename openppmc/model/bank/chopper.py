"""Chopper of an axis of the bank. Each edge of the chopper is scheduled by a visit (BANK-CHP-01).

The bank processes its axes in turn. A visit is an edge of `clk` at which it processes this axis.
"""

from __future__ import annotations

from ..chip import Context, Phase
from ..clock import Event
from ..motion import excitation
from ..motion.excitation import ChopperTimes

# Times of the visits of each axis (BANK-GEN-01), and delays from an event to the first visit at which it is
# effective.

SHORTEST_ROUND = 8
FIRST = 8

BYTE_LEAD = 7
"""Cycles from a write event to the first visit that may accept the byte (BANK-HSK-01)."""
END_LEAD = 5
"""Cycles from the decision to end a motion to the first visit that detects it (BANK-MOT-03)."""
BUILD_LEAD = 2
"""Cycles from the end of a table build to the first visit that may start the next one.

Rule: BANK-INI-01.
"""
READY_LEAD = 3
"""Cycles from the end of a table build to the first visit that may complete the initialisation.

Rule: BANK-INI-02.
"""
GROUP_LEAD = 5
"""Cycles from a write event of MASK or GO to the first visit at which it is effective (BANK-GRP-01, -02)."""
CONFIG_LEAD = 7
"""Cycles from a write event of CONFIG to the first visit at which it is effective (BANK-GEN-04)."""
SWITCH_LEAD = 4
"""Cycles from the edge that samples a switch to the first visit that uses the level (BANK-MOT-05)."""


def round_clk(axes: int) -> int:
    """Return R, the number of cycles in which the bank processes all axes once."""
    return max(axes, SHORTEST_ROUND)


class VisitSchedule:
    """Visits of an axis.

    They are the edges `released` + axis + 8 + n R, for n = 1, 2 and so on. R is the length of a round, see
    `round_clk`.
    """

    def __init__(self, axis: int, axes: int, released: int) -> None:
        self.round = round_clk(axes)
        self._start = released + axis + FIRST + self.round

    def first(self, edge: int) -> int:
        """Return the first visit at or after an edge."""
        return self._start + max(0, -(-(edge - self._start) // self.round)) * self.round

    def last(self, edge: int) -> int:
        """Return the last visit at or before an edge. This visit schedules the events of the edge."""
        return self._start + (edge - self._start) // self.round * self.round


class Chopper(excitation.Chopper):
    """Chopper of the PPMC-104 whose on- and off-times are scheduled at visits.

    The visit that schedules the beginning of an on-time or off-time determines its length.
    """

    def __init__(self, context: Context, times: ChopperTimes, visits: VisitSchedule) -> None:
        super().__init__(context, times)
        self._visits = visits
        self._boundary_edge = -1
        self._latched_length: int | None = None
        self._latch_event: Event | None = None

    def schedules_edge(self, visit: int) -> bool:
        """Return True if this visit schedules an edge of the chopper (BANK-HSK-02)."""
        return self._boundary_edge == visit or (
            self.next_phase_at is not None and self.next_phase_at < visit + self._visits.round
        )

    def stop(self) -> None:
        """Stop the chopper."""
        super().stop()
        if self._latch_event:
            self._latch_event.cancel()
        self._boundary_edge, self._latched_length = -1, None

    def _plan(self) -> None:
        super()._plan()
        assert self.next_phase_at is not None
        self._latch_event = self._context.queue.at(
            self._visits.last(self.next_phase_at), Phase.QUEUE, self._latch_length
        )

    def _latch_length(self, t: int) -> None:
        """Latch the length of the next on-time or off-time (BANK-GEN-04).

        The length depends on vsel and on the chopper times, with their values at this visit.
        """
        self._latched_length = self._times.quanta(not self.on)

    def _length(self) -> int:
        return super()._length() if self._latched_length is None else self._latched_length

    def _boundary(self, t: int) -> None:
        self._boundary_edge = t
        super()._boundary(t)
