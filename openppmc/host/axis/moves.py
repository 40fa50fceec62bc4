"""Moves that are waited for, the same with every part."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ..basis import units
from ..basis.arguments import Checked
from ..basis.ending import End
from .motion import AnyMotion, Progress

OnProgress = Callable[[Progress], None]


class Startable(Protocol):
    """What `Moves` needs of its axis; `nothing_to_move` gives the End of a move of 0 pulses."""

    @property
    def position(self) -> int: ...
    def start_move(self, pulses: int, pulse_only: bool = False) -> AnyMotion: ...
    def start_constant(self, pulses: int, pps: units.Number) -> AnyMotion: ...
    def nothing_to_move(self) -> End: ...
    def move(self, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False) -> End: ...


class Moves(Checked):
    """For an axis that is `Startable`."""

    def move(
        self: Startable, pulses: int, progress: OnProgress | None = None, pulse_only: bool = False
    ) -> End:
        """Move with ramps and wait. Raises LimitReached, AlarmStop, StoppedEarly if it ends early."""
        if pulses == 0:
            return self.nothing_to_move()
        return self.start_move(pulses, pulse_only).wait(progress=progress).check(abs(pulses))

    def move_to(self: Startable, position: int, progress: OnProgress | None = None) -> End:
        """Move with ramps to a reading of the pulse counter, and wait."""
        return self.move(position - self.position, progress)

    def move_constant(
        self: Startable, pulses: int, pps: units.Number, progress: OnProgress | None = None
    ) -> End:
        """Move at constant speed and wait; errors as `move`."""
        return self.start_constant(pulses, pps).wait(progress=progress).check(abs(pulses))
