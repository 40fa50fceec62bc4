"""Intervals counted in edges of the external base clock.

Rules: P104-INT-01, -03, P104-TIM-05, P104-BCK-04; P2104-BCK-04, P2104-TIM-05.
"""

from __future__ import annotations

from ..clock import Timebase


class ExternalInterval:
    """Counter of effective edges of the base clock between pulses; times are edges of `clk`.

    Args:
        plain: level of vsel during the operation. If it is 1, the next pulse occurs at the base edge with
            number rate + 1, counted from the last pulse. If it is 0, counting begins with the first base edge
            at or after the last pulse, and the next pulse is delayed by 7.5 us minus the time from the last
            pulse to that first edge (P104-INT-03).
    """

    def __init__(self, timebase: Timebase, plain: bool) -> None:
        self._plain = plain
        self._extra = timebase.nearest(120)
        self._slow = timebase.nearest(136)
        self.begin(0, 0, False)

    def begin(self, t: int, rate: int, on_edge: bool) -> None:
        """Begin an interval with a pulse at edge t.

        Args:
            on_edge: True if a base edge is effective at edge t.
        """
        self.edges = 0
        self._edges_needed = rate + 1
        self._pulse = t
        self._wait: int | None = 0 if on_edge else None
        self._delayed = False

    def rise(self, t: int, gap: int | None, low: bool) -> int | None:
        """Process a base edge.

        An edge that would cause a pulse while pout_n is still low is not counted.

        Args:
            gap: number of cycles since the previous base edge, `None` for the first base edge after a reset.

        Returns:
            Number of cycles from this edge to the next pulse, `None` if this edge does not cause a pulse.
        """
        if self._delayed:
            return None
        if self._plain:
            if self.edges + 1 < self._edges_needed:
                self.edges += 1
                return None
            return None if low else 0
        if self._wait is None:
            self._wait = t - self._pulse
            return None
        self.edges += 1
        if self.edges < self._edges_needed:
            return None
        self._delayed = True
        if gap is None or gap > self._slow:
            return 0
        return max(0, self._extra - self._wait)
