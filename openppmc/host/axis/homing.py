"""Finding the origin: the same edge from the same side, wherever the search begins."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from ..basis.arguments import side, within
from ..basis.ending import Cause, End, OriginNotFound
from ..basis.kind import Kind
from ..basis.units import Number
from .motion import AnyMotion, Progress

LONGEST_BACK_OFF = 200_000


class Switched(Protocol):
    """Switches; True: active."""

    @property
    def origin(self) -> bool: ...


class Searching(Protocol):
    """What homing needs of an axis, which is an `axis.Axis` or that of a part with other ways."""

    @property
    def kind(self) -> Kind: ...
    @property
    def who(self) -> str: ...
    @property
    def position(self) -> int: ...
    @property
    def search_speed(self) -> Number: ...
    def inputs(self) -> Switched: ...
    def search(self, direction: int, pps: Number | None = None) -> AnyMotion: ...
    def jog(self, direction: int, speed: Number | None = None, high: bool = False) -> AnyMotion: ...
    def move_constant(
        self, pulses: int, pps: Number, progress: Callable[[Progress], None] | None = None
    ) -> End: ...
    def zero(self) -> None: ...


class Homing:
    """One homing run of an axis; see `Axis.home`."""

    def __init__(
        self,
        axis: Searching,
        direction: int,
        search_pps: Number | None,
        back_off: int,
        progress: Callable[[Progress], None] | None,
    ) -> None:
        within(back_off, "back_off", 1, LONGEST_BACK_OFF, "pulses")
        self._axis = axis
        self._towards = side(direction)
        self._pps = search_pps
        self._back_off = back_off
        self._progress = progress

    def run(self, fast: bool, to_limit: bool) -> End:
        """Approach, leave the switch if it is active, search, zero."""
        if (fast or to_limit) and not self._axis.inputs().origin:
            self._approach(to_limit)
            if self._axis.kind.origin_between and not self._axis.inputs().origin:
                self._search(1 - self._towards)
        if self._axis.inputs().origin:
            self._leave()
        end = self._search(self._towards)
        self._axis.zero()
        return replace(end, position=None if end.position is None else 0)

    def _search(self, direction: int) -> End:
        """Search at constant speed."""
        end = self._axis.search(direction, self._pps).wait(progress=self._progress)
        if end.cause & (Cause.LIMIT | Cause.SLOW_LIMIT):
            raise OriginNotFound(
                f"{end.who}a limit switch came before the origin: home in the other direction, or check the "
                "switch",
                end,
            )
        return self.found(end)

    @staticmethod
    def found(end: End) -> End:
        """Return the end of a search that the origin ended. Raises OriginNotFound for a search that made all
        its pulses, and as `End.check`."""
        if end.cause is Cause.ORIGIN:
            return end
        raise OriginNotFound(
            f"{end.who}the search ended after {abs(end.check().pulses or 0)} pulses without the origin; "
            "check the switch",
            end,
        )

    def _approach(self, to_limit: bool) -> None:
        """High speed up to the slow-down limit, or on to the hard limit."""
        end = self._axis.jog(self._towards, high=True).wait(progress=self._progress)
        if to_limit and end.cause == Cause.SLOW_LIMIT:
            end = self._axis.jog(self._towards, speed=self._pps).wait(progress=self._progress)
        if to_limit and end.cause & Cause.LIMIT and not end.cause & (Cause.ALARM | Cause.STOP):
            return
        if end.cause != Cause.SLOW_LIMIT:
            raise OriginNotFound(
                f"{end.who}no limit switch ended the approach after {abs(end.check().pulses or 0)} pulses; "
                "check the switches",
                end,
            )

    def _leave(self) -> None:
        """Away from the switch in small moves until it is released."""
        gone = 0
        step = -self._back_off if not self._towards else self._back_off
        while self._axis.inputs().origin:
            if gone > LONGEST_BACK_OFF:
                end = End(Cause.COMPLETE, gone, 0, self._axis.position, 0)
                raise OriginNotFound(
                    f"{self._axis.who}the origin switch is still active {gone} pulses away from where it "
                    "was: check it",
                    end,
                )
            pps = self._pps if self._pps is not None else self._axis.search_speed
            self._axis.move_constant(step, pps, self._progress)
            gone += self._back_off
