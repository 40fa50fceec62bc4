"""Finding a reference point with a PMC006B4: its EXT switches are the only ones that it has."""

from __future__ import annotations

from collections.abc import Callable

from ..axis.motion import Progress
from ..basis.arguments import within
from ..basis.ending import OriginNotFound
from ..basis.errors import OutOfRange
from .axis import Axis
from .motion import End

LONGEST_WAY_OFF = 200_000
SLOWEST, FASTEST = 65, 3000
_KEPT = ("stops", "direction", "start_speed", "stop_speed", "max_speed")


class Homing:
    """One homing run of a controller; see `pmc006.Pmc006.home`."""

    def __init__(
        self,
        axis: Axis,
        switch: int,
        direction: int,
        speed: int,
        slow: int,
        off: int,
        progress: Callable[[Progress], None] | None,
    ) -> None:
        for name, pps in (("speed", speed), ("slow", slow)):
            within(pps, name, SLOWEST, FASTEST, "steps/s")
        within(off, "off", 1, LONGEST_WAY_OFF, "steps")
        if switch not in (1, 2):
            raise OutOfRange(f"EXT{switch}: there are EXT1 and EXT2")
        self._axis, self._switch, self._direction = axis, switch, direction
        self._speed, self._slow, self._off, self._progress = speed, slow, off, progress

    def run(self) -> End:
        """Off the switch if need be, towards it, off, slowly towards it again, off; zero. Speeds, direction
        and enabled stops are afterwards as they were."""
        axis = self._axis
        before = {name: getattr(axis, name) for name in _KEPT}
        try:
            axis.clear_stops()
            axis.stops = 3  # the other one, too: this may be the wrong way
            if axis.on_switch(self._switch):
                self._leave()
            else:
                self._approach(self._speed)
                self._leave()
            self._approach(self._slow)
            end = self._leave()
            axis.zero()
            return end.at(0)
        finally:
            if axis.motion is None or axis.motion.over:
                for name, value in before.items():
                    setattr(axis, name, value)

    def _pace(self, speed: int) -> None:
        """No ramps: the way from the switch's edge to rest is always the same."""
        self._axis.start_speed = self._axis.stop_speed = self._axis.max_speed = speed

    def _approach(self, speed: int) -> None:
        """Run until the switch stops the motor, and clear its flag."""
        axis = self._axis
        self._pace(speed)
        end = axis.jog(self._direction).wait(progress=self._progress)
        stops = axis.flags().stops
        if self._switch not in stops:
            other = " and ".join(f"EXT{number}" for number in stops) or end.why
            raise OriginNotFound(
                f"{axis.who}{other} came before EXT{self._switch}: home in the other direction, or check the "
                "switch",
                end,
            )
        axis.clear_stops(stops)

    def _leave(self) -> End:
        """Away from the switch in moves of the same length until it is released."""
        axis, gone = self._axis, 0
        self._pace(self._slow)
        while True:
            end = axis.move(-self._direction * self._off, progress=self._progress)
            gone += self._off
            if not axis.on_switch(self._switch):
                return end
            if gone > LONGEST_WAY_OFF:
                raise OriginNotFound(
                    f"{axis.who}EXT{self._switch} is still active {gone} steps away from where it was: check "
                    "it",
                    end,
                )
