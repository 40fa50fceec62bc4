"""A reply was lost: was the instruction carried out? Found out by looking, so that nothing moves twice.

Repeating is harmless for what reads, sets a value or stops. A start is judged by state and position, a toggle
and a registration by what the station shows before and after. What cannot be seen is told: LostReply.
"""

from __future__ import annotations

from typing import Protocol

from ....model.ppmc312.codes import MOTION_STARTS, OV, Code
from ...basis.errors import NoAnswer
from ...basis.refusals import CommandRefused
from ...line.errors import LostReply
from ..motion import Motion
from ..registers import Status

_TOGGLES = {Code.INTERLOCK: "interlock", Code.RUN_MONITOR: "run_monitored"}
_REGISTERED = (Code.STOP, Code.SLOW_STOP, Code.RAMP_CHANGE, Code.CHANGE)
_DELETE = 2


class Asking(Protocol):
    """The way to a station, which is a `talk.Talk`. answers: of the station so far. busy: a motion, says the
    last poll."""

    answers: int
    busy: bool

    def status(self) -> Status: ...
    def collect(self) -> None: ...


class Reporting(Protocol):
    """What is known of a station, which is a `station.Station312`."""

    @property
    def who(self) -> str: ...
    @property
    def window(self) -> Asking: ...
    @property
    def motion(self) -> Motion | None: ...
    @property
    def position(self) -> int: ...


class Doubt:
    """One instruction block to a station. repeated: a reply to it was lost."""

    def __init__(self, station: Reporting, block: bytes) -> None:
        self._station = station
        self._block = block
        self.repeated = False
        motion = station.motion
        self._motion = motion if motion is not None and not motion.over else None
        self._was_busy = station.window.busy
        self._before: Status | None = None
        if block[2] in _TOGGLES or block[2] == Code.EVENT_SET or self._is_override:
            self._before = station.window.status()

    @property
    def _is_override(self) -> bool:
        return self._block[2] in _REGISTERED and bool(self._block[3] & OV)

    def settle(self) -> bool:
        """Whether it was carried out. Raises LostReply if nobody can know."""
        self.repeated = True
        code = self._block[2]
        try:
            if code in MOTION_STARTS:
                return self._started()
            if self._before is None:
                return False
            now = self._station.window.status()
            if code in _TOGGLES:
                toggled = _TOGGLES[Code(code)]
                return bool(getattr(now, toggled) != getattr(self._before, toggled))
            if code == Code.EVENT_SET:
                return self._buffered(now)
            return self._registered(now)
        except NoAnswer as error:
            raise self._lost("the station has been silent since") from error

    def explain(self, refusal: CommandRefused) -> Exception:
        """What to raise for a refusal: of a repeated change of speed it says nothing about the first one."""
        if self.repeated and self._block[2] == Code.RAMP_CHANGE:
            return self._lost(f"sent again, it was refused ({refusal})")
        return refusal

    def _started(self) -> bool:
        """Motions are known by the state, by the report of their end, or by the position."""
        station, motion = self._station, self._motion
        if motion is None or self._was_busy:
            raise self._lost("it is not known what the motor did before")
        if station.window.status().busy:
            return True
        station.window.answers += 1  # the end of this motion may be reported now
        station.window.collect()
        return motion.over or station.position != motion.begin

    def _registered(self, now: Status) -> bool:
        assert self._before is not None
        added = now.overrides - self._before.overrides
        if added == 1:
            return True
        if added == 0 and not now.busy and not now.override_events:
            return False  # nothing can have happened meanwhile
        raise self._lost("overrides may have happened meanwhile")

    def _buffered(self, now: Status) -> bool:
        assert self._before is not None
        number = (self._block[3] & 1) + 1
        filled, was = number in now.events, number in self._before.events
        if self._block[3] & _DELETE:
            if was and filled:
                raise self._lost(f"event buffer {number} still holds something")
            return was
        if was:
            raise self._lost(f"event buffer {number} held something before")
        return filled

    def _lost(self, why: str) -> LostReply:
        return LostReply(
            f"{self._station.who}the reply to an instruction was lost, it may have been carried out; {why}: "
            "look at the station (status) before you repeat it"
        )
