"""Intervals counted in edges of the external base clock.

P104-INT-01, -03, P104-TIM-05, P104-BCK-04; P2104-BCK-04, P2104-TIM-05.
"""

from __future__ import annotations

from ..clock import Timebase


class ExternalInterval:
    """Counts effective base edges from pulse to pulse; times are clk edges.

    plain: vsel level of the operation. 1: pulse on the (rate+1)-th edge after the last one. 0: the edges
    are counted from the first one at or after the pulse, and the pulse is put off by what 7.5 us leave
    after the wait for that first edge (P104-INT-03).
    """

    def __init__(self, timebase: Timebase, plain: bool) -> None:
        self._plain = plain
        self._extra = timebase.nearest(120)
        self._slow = timebase.nearest(136)
        self.begin(0, 0, False)

    def begin(self, t: int, rate: int, on_edge: bool) -> None:
        """A pulse at edge t opens an interval; on_edge: a base edge is effective on this very edge."""
        self.edges = 0
        self._need = rate + 1
        self._pulse = t
        self._wait: int | None = 0 if on_edge else None
        self._delayed = False

    def rise(self, t: int, gap: int | None, low: bool) -> int | None:
        """A base edge, `gap` clk after the one before (None: the first ever).

        Returns the clk from here to the next pulse, None if this edge makes none. An edge that would
        make a pulse while pout_n is still low is not counted.
        """
        if self._delayed:
            return None
        if self._plain:
            if self.edges + 1 < self._need:
                self.edges += 1
                return None
            return None if low else 0
        if self._wait is None:
            self._wait = t - self._pulse
            return None
        self.edges += 1
        if self.edges < self._need:
            return None
        self._delayed = True
        if gap is None or gap > self._slow:
            return 0
        return max(0, self._extra - self._wait)
