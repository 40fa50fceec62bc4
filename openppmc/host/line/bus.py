"""Several stations at once, whatever they are: waiting, stopping, letting time pass."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Generic, Protocol, TypeVar

from ..axis.device import Device, Turning
from ..axis.motion import Progress
from ..basis.ending import End
from ..basis.errors import OutOfRange, PpmcError
from ..basis.refusals import NothingToStop, NotInitialised
from .master import Master
from .motion import POLL_EVERY, LineMotion, wait_all


class Station(Turning, Protocol):
    """One of the line."""

    @property
    def number(self) -> int: ...
    @property
    def motion(self) -> LineMotion | None: ...


LineT = TypeVar("LineT", bound=Master[Any])
StationT = TypeVar("StationT", bound=Station)


class LineBus(Device, Generic[LineT, StationT]):
    """A line with its stations, which `axis` gives; see `device.Device`.

    Leaving its `with` block by an exception decelerates motions that this object started.
    """

    link: LineT
    line: LineT

    def __init__(self, line: LineT) -> None:
        self.line = self.link = line
        self._stations: dict[int, StationT] = {}

    @abstractmethod
    def make(self, station: int) -> StationT:
        """The driver of a station."""

    @abstractmethod
    def look_at(self, axis: StationT) -> None:
        """Read what a station has to say."""

    def axis(self, station: int) -> StationT:
        """The station with this number, whether it is there or not; always the same object."""
        made = self._stations.get(station)
        if made is None:
            made = self.make(station)
            self._stations[made.number] = made
        return made

    @property
    def axes(self) -> tuple[StationT, ...]:
        """The stations in use so far."""
        return tuple(self._stations[number] for number in sorted(self._stations))

    def wait(
        self,
        motions: Sequence[LineMotion | StationT] | None = None,
        timeout: float | None = None,
        progress: Callable[[Progress], None] | None = None,
    ) -> list[End]:
        """Wait until motions, or the motions of stations (default: of all in use), are over; does not judge.

        timeout: s, None for ever; Timeout leaves the rest running. progress: called about ten times a second.
        """
        wanted = self.axes if motions is None else motions
        chosen = [one.motion if hasattr(one, "motion") else one for one in wanted]
        if motions is not None and None in chosen:
            raise OutOfRange("this station was started by nobody: start it first")
        return wait_all([one for one in chosen if one is not None], timeout, progress)

    def stop(self, stations: Iterable[int] | None = None, now: bool = False) -> list[End]:
        """Stop stations (default: those in use) and wait; all are told before an error is raised. Those at
        rest are passed over."""
        errors: list[PpmcError] = []
        moving = []
        for axis in self._chosen(stations):
            try:
                (axis.halt if now else axis.stop)(wait=False)
                moving.append(axis)
            except (NothingToStop, NotInitialised):
                pass
            except PpmcError as error:
                errors.append(error)
        ends = self.wait(moving)
        if errors:
            raise errors[0]
        return ends

    def attend(self, seconds: float) -> None:
        """Let time pass, and look at the stations in use."""
        end = self.line.clock() + seconds
        while (left := end - self.line.clock()) > 0:
            for axis in self.axes:
                self.look_at(axis)
            self.line.pause(min(left, POLL_EVERY))

    def _chosen(self, stations: Iterable[int] | None) -> list[StationT]:
        return list(self.axes) if stations is None else [self.axis(number) for number in stations]
