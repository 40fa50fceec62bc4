"""When each axis is visited (BANK-GEN-01), and the times between a cause and the visits that know of it."""

from __future__ import annotations

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
