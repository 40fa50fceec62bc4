"""Registers MASK, GO and STOP (BANK-GRP-01..04)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

from ..chip import Phase
from ..clock import Scheduler
from ..motion.excitation import ALL_PHASES
from ..ppmc104 import GUARD
from .chopper import GROUP_LEAD, VisitSchedule

# Pins of the bank, with idle and reset levels. A port that exists for all axes is one number: bit i belongs
# to axis i. In `s`, bits 5 i .. 5 i + 4 are S1 .. S5 of axis i.

HOST_PINS = ("a", "cs_n", "rd_n", "wr_n", "d_i")
SWITCHES = GUARD.all
PHASES = 5
AT_REST = {"pout_n": 1, "dir": 0, "hold": 1}
"""The reset levels of the motor pins of one axis, except `s`."""


def inputs(axes: int) -> dict[str, int]:
    """Return the idle levels of the inputs."""
    host = {"rst_n": 1, "a": 0, "cs_n": 1, "rd_n": 1, "wr_n": 1, "d_i": 0}
    return host | dict.fromkeys(SWITCHES, (1 << axes) - 1)


def outputs(axes: int, phase_idle: int) -> dict[str, int]:
    """Return the reset levels of the outputs."""
    motors = {name: ((1 << axes) - 1) * level for name, level in AT_REST.items()}
    phases = sum(ALL_PHASES * phase_idle << PHASES * axis for axis in range(axes))
    return {"d_o": 0, "d_oe": 0, "int_n": 1, **motors, "s": phases}


def widths(axes: int) -> dict[str, int]:
    """Return the widths of all ports with more than one bit."""
    ports = dict.fromkeys((*SWITCHES, *AT_REST), axes)
    return {"a": 10, "d_i": 8, "d_o": 8, "s": PHASES * axes, **ports}


class Member(Protocol):
    """Members of an axis that the registers GO and STOP use."""

    visits: VisitSchedule

    def go(self, t: int, go: int) -> None:
        """Process at visit t the GO that was written at edge `go`."""

    def halt(self, t: int) -> None:
        """Process STOP at edge t."""


class Group:
    """The group registers of a bank.

    Attributes:
        mask: value that a read of MASK returns; bit i = axis i.
    """

    def __init__(self, queue: Scheduler, axes: int, round_clk: int) -> None:
        self._queue = queue
        self._all = (1 << axes) - 1
        self._round = round_clk
        self.mask = 0
        self._visible_mask = 0
        self._go = -round_clk
        self._stopped = -1
        self.members: Sequence[Member] = ()

    def write_mask(self, t: int, k: int, byte: int) -> None:
        """Process a write event of byte k of MASK at edge t."""
        self.mask = mask = (self.mask & ~(0xFF << 8 * k) | byte << 8 * k) & self._all
        self._queue.at(t + GROUP_LEAD, Phase.LEVELS, lambda now: self._update_visible_mask(mask))

    def _update_visible_mask(self, mask: int) -> None:
        self._visible_mask = mask

    def includes(self, axis: int) -> bool:
        """Return the value of an axis's MASK bit that is effective at the current visit of the axis."""
        return bool(self._visible_mask >> axis & 1)

    def go(self, t: int) -> None:
        """Process a write event of GO at edge t.

        This GO is effective from edge t on. If an earlier GO is still active, this GO is effective after the
        end of the earlier GO. If another GO already waits for this end, this GO has no effect (BANK-GRP-03).
        """
        if self._go > t:
            return
        self._go = max(t, self._go + self._round)
        for member in self.members:
            visit = member.visits.first(self._go + GROUP_LEAD)
            self._queue.at(visit, Phase.BEGIN, self._at_visit(member, self._go))

    @staticmethod
    def _at_visit(member: Member, go: int) -> Callable[[int], None]:
        return lambda now: member.go(now, go)

    def stop(self, t: int) -> None:
        """Process a write event of STOP at edge t."""
        self._stopped = t
        for member in self.members:
            self._queue.at(t + 1, Phase.COMMAND, member.halt)

    def stops(self, visit: int) -> bool:
        """Return True if a STOP that was written earlier ends an operation that starts at this visit."""
        return 0 <= self._stopped < visit <= self._stopped + self._round
