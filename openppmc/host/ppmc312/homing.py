"""Finding the origin with a PPMC-312: a zero return, if wanted, then the same edge from the same side."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ..axis import homing
from ..axis.motion import AnyMotion, Progress
from ..basis.ending import Cause, End, OriginNotFound
from ..basis.units import Number


class Searching(homing.Searching, Protocol):
    """The same with what only a PPMC-312 can."""

    def search(self, direction: int, pps: Number | None = None, index: bool = False) -> AnyMotion: ...
    def zero_return(self, direction: int, pps: Number | None = None, index: bool = False) -> AnyMotion: ...


class Homing(homing.Homing):
    """One homing run; see `Axis.home`. index: searches end at an index of the encoder."""

    def __init__(
        self,
        axis: Searching,
        direction: int,
        search_pps: Number | None,
        back_off: int,
        progress: Callable[[Progress], None] | None,
        index: bool,
    ) -> None:
        super().__init__(axis, direction, search_pps, back_off, progress)
        self._part = axis
        self._index = index

    def _search(self, direction: int) -> End:
        motion = self._part.search(direction, self._pps, self._index)
        return self._judge(motion.wait(progress=self._progress))

    def _judge(self, end: End) -> End:
        if end.cause & (Cause.LIMIT | Cause.SLOW_LIMIT):
            raise OriginNotFound(
                "a limit switch came before the origin"
                + (" and its index" if self._index else "")
                + ": home in the other direction, or check the switch",
                end,
            )
        return self.found(end)

    def _approach(self, to_limit: bool) -> None:
        if to_limit:
            super()._approach(True)
        else:
            self._judge(self._part.zero_return(self._towards).wait(progress=self._progress))
