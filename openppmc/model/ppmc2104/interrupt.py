"""INT* of the PPMC-2104: four cause latches and the release window (P2104-INT-01..05)."""

from __future__ import annotations

from enum import Enum

from ..common.blocks import Context, Phase


class Cause(Enum):
    """Kinds of causes; each axis has one latch of each."""

    END = "end"
    ERROR = "error"


class Interrupt:
    """The latches. `level(t)` is what the pin register takes from the state after edge t."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._set: set[tuple[Cause, int]] = set()
        self._quiet_until = -1

    def raise_(self, cause: Cause, axis: int) -> None:
        """Set a latch."""
        self._set.add((cause, axis))

    def release(self, t: int, cause: Cause, axis: int) -> None:
        """A read clears a latch at edge t; if it was set, INT* is H for W (P2104-INT-03, -04)."""
        if (cause, axis) not in self._set:
            return
        self._set.remove((cause, axis))
        self._quiet_until = t + self._context.timebase.w
        # Something must happen on that edge so that the pins are looked at again.
        self._context.queue.at(self._quiet_until, Phase.END, lambda now: None)

    def level(self, t: int) -> int:
        """Level of int_n by the latches after edge t."""
        return 0 if self._set and t >= self._quiet_until else 1

    @property
    def pending(self) -> frozenset[tuple[Cause, int]]:
        """Latches that are set."""
        return frozenset(self._set)
