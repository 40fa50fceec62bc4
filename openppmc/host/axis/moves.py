"""Moves that are waited for, the same with every part."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..basis import units
from ..basis.arguments import Checked
from ..basis.ending import End
from .motion import Progress

OnProgress = Callable[[Progress], None]


class Moves(Checked):
    """For an axis that has these; `nothing_to_move` gives the End of a move of 0 pulses."""

    position: int
    start_move: Callable[..., Any]
    start_constant: Callable[..., Any]
    nothing_to_move: Callable[[], End]

    def move(self, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False) -> End:
        """Move with ramps and wait. Raises LimitReached, AlarmStop, StoppedEarly if it ends early."""
        if pulses == 0:
            return self.nothing_to_move()
        end: End = self.start_move(pulses, pulse_only).wait(progress=progress).check(abs(pulses))
        return end

    def move_to(self, position: int, progress: OnProgress | None = None) -> End:
        """Move with ramps to a reading of the pulse counter, and wait."""
        return self.move(position - self.position, progress)

    def move_constant(self, pulses: int, pps: units.Number, progress: OnProgress | None = None) -> End:
        """Move at constant speed and wait; errors as `move`."""
        end: End = self.start_constant(pulses, pps).wait(progress=progress).check(abs(pulses))
        return end
