"""Lines with several stations: master, motions, waiting, stopping, errors.

They are independent of the frame format.
"""

# ruff: noqa: N818

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Generic, Protocol, TypeVar

from .check import exact
from .ending import End, EndUnknown
from .errors import (
    Disconnected,
    LinkError,
    NoAnswer,
    NothingToStop,
    NotInitialised,
    OutOfRange,
    PpmcError,
    Timeout,
)
from .line_port import Counters, Fault, Miss
from .motion import PROGRESS_POLL, AnyMotion, Progress
from .part import Device, Turning
from .port import Port

# Exceptions of a line with several stations.


class StationSilent(NoAnswer):
    """No reply of a station was received after all attempts."""


class GarbledReply(NoAnswer):
    """Bytes were received, but no complete reply.

    The cause is noise, a wrong speed, or two stations with one address.
    """


class DuplicateAddress(LinkError):
    """Two stations of a line seem to have the same address."""


class LineEcho(LinkError):
    """The master receives its own bytes, but was not configured for it."""


class LostReply(LinkError):
    """An instruction that may not be repeated was sent, and it is unknown whether it was executed."""


def unanswered(where: str, misses: Sequence[Miss], attempts: int, check: str, others: str) -> NoAnswer:
    """Return the exception after all attempts to reach a station have failed.

    Args:
        check: what the user should check after silence.
        others: possible causes of corrupt replies.
    """
    if not any(miss.heard for miss in misses):
        if len(misses) < attempts:
            return GarbledReply(f"{where} could not read {attempts} frames: check cable and termination")
        frames = "a frame" if attempts == 1 else f"{attempts} frames"
        return StationSilent(f"{where}: no reply to {frames}: {check}")
    if all(miss.fault is Fault.FOREIGN for miss in misses):
        return GarbledReply(f"{where}: another station replied, {attempts} times: does a second master talk?")
    return GarbledReply(f"{where}: only garbled replies, {attempts} times: {others}")


# Motions of stations on a line. Only a poll detects their ends.

POLL_EVERY = 0.02
"""Seconds between two rounds of polls."""


class LineMotion(AnyMotion, Protocol):
    """Running motion."""

    @property
    def unknown(self) -> EndUnknown | None:
        """Reason why the part does not confirm the end.

        The value is None if the part confirms it, or while the motion is running.
        """

    @property
    def line(self) -> Master[Any]:
        """Line of the station."""

    @property
    def station(self) -> int:
        """Number of the station."""

    def look(self) -> None:
        """Poll the station; set `end` or `unknown` if the motion is over."""

    def now(self) -> Progress:
        """Return the progress now, or at the end of the motion."""


def wait_all(
    motions: Sequence[LineMotion],
    timeout: float | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> list[End]:
    """Poll the stations until their motions are over.

    The call returns the ends in the same order, for any cause.

    Args:
        timeout: longest wait for all motions in s, `None` for no limit.
        progress: called about ten times a second, with the sum of the pulses of several motions.

    Raises:
        Timeout: the time is over; the other motions continue.
        EndUnknown: a motion is over without a confirmed end; the other motions continue.
    """
    if not motions:
        return []
    line = motions[0].line
    limit = None if timeout is None else line.clock() + timeout
    due = line.clock() + PROGRESS_POLL
    while True:
        for motion in motions:
            if not motion.over:
                motion.look()
        running = [motion for motion in motions if not motion.over]
        for motion in motions:
            if motion.unknown is not None:
                raise motion.unknown
        if not running:
            return [motion.end for motion in motions if motion.end is not None]
        if limit is not None and line.clock() >= limit:
            who = ", ".join(str(motion.station) for motion in running)
            raise Timeout(
                f"station {who}: motion still in progress after {timeout:g} s; "
                "increase timeout or stop the motion"
            )
        if progress is not None and line.clock() >= due:
            progress(_sum(motions))
            due = line.clock() + PROGRESS_POLL
        line.pause(POLL_EVERY)


def _sum(motions: Sequence[LineMotion]) -> Progress:
    """Return the progress of several motions together.

    Its position is that of the first running motion.
    """
    known = [(motion, motion.now()) for motion in motions]
    asked = [motion.asked for motion in motions]
    first = next(now for motion, now in known if motion.end is None)
    return Progress(
        first.position,
        sum(now.made for _, now in known),
        None if None in asked else sum(filter(None, asked)),
        max(now.seconds for _, now in known),
    )


# Master of a line with several stations, for any frame format. It sends a frame and receives one reply.

PATIENCE = 0.1
"""Seconds beyond line time until a station counts as silent.

A station needs 4 ms, a USB adapter up to 16 ms.
"""
BITS = 10
_GAP_BYTES, _GAP = 5, 0.01
_MOST_NOISE = 400

Answer = TypeVar("Answer", covariant=True)


class Listener(Protocol[Answer]):
    """Receiver for the bytes of one reply."""

    def take(self, byte: int) -> Answer | Fault | None:
        """Process a byte; return the reply if it is complete.

        The call returns a Fault if no reply is possible any more.
        """


class Master(Generic[Answer]):
    """Half-duplex master: it sends a frame and receives the reply.

    It counts faults and repeats nothing.

    Attributes:
        port: open port.
        baud: line rate in bit/s.
        echo: True if the master receives its own bytes.
        patience: seconds beyond line time until a station counts as silent, at most 60.
        counters: counters of each station, by its number.
    """

    def __init__(self, port: Port, baud: int, echo: bool, patience: float) -> None:
        self.port, self.baud, self.echo = port, baud, echo
        self.patience = max(patience, self.port_patience)
        self.counters: dict[int, Counters] = {}
        self.stray = 0
        self._closed = False
        self._early = b""

    @staticmethod
    def check_patience(patience: float) -> None:
        """Raise OutOfRange if the patience is not more than 0 s and at most 60 s."""
        if not 0 < exact(patience, "patience") <= 60:
            raise OutOfRange(f"patience {patience:g} s is outside 0 to 60 s")

    @property
    def port_patience(self) -> float:
        """Least patience of the port in s; virtual boards may be slower than real time."""
        return getattr(self.port, "patience", 0.0)

    @property
    def name(self) -> str:
        """Port as the user named it."""
        return self.port.name

    def clock(self) -> float:
        """Return the time of the port in s; the time of `model:` is virtual."""
        return self.port.clock()

    def pause(self, seconds: float) -> None:
        """Wait on the clock of the port; discard received bytes."""
        end = self.clock() + seconds
        while (left := end - self.clock()) > 0:
            self.stray += len(self.port.read(left))

    def wait_event(self, timeout: float) -> int | None:
        """Return `None` after `timeout` seconds, because a line has no events; discard received bytes."""
        self.pause(timeout)
        return None

    def forget_events(self) -> None:
        """Do nothing, because a line has no events."""

    def close(self) -> None:
        """Close the port; a second call is allowed."""
        self._closed = True
        self.port.close()

    def seconds(self, count: int) -> float:
        """Return the line time of this number of bytes in s."""
        return count * BITS / self.baud

    # ------------------------------------------------------------------ frames

    def ask(self, station: int, sent: bytes, listener: Listener[Answer], extra: float = 0.0) -> Answer | Miss:
        """Send a frame and wait for the reply.

        Args:
            extra: additional time in s that the station may need.

        Raises:
            LineEcho, Disconnected: the line or the port failed.
        """
        self.send(station, sent)
        counters = self.counters[station]
        got = self._await(listener, self.seconds(len(sent)) + extra)
        if isinstance(got, Miss):
            if got.fault is Fault.FOREIGN:
                counters.foreign += 1
            elif got.heard:
                counters.garbled += 1
            else:
                counters.silent += 1
        return got

    def send(self, station: int, sent: bytes) -> None:
        """Send a frame and discard its echo, if any. Bytes received earlier are discarded."""
        if self._closed:
            raise Disconnected(f"{self.name}: the line is closed: open it again")
        self.stray += len(self.port.read(0))
        self.counters.setdefault(station, Counters()).sent += 1
        self.port.write(sent)
        if self.echo:
            self._drop_echo(sent)

    def _drop_echo(self, sent: bytes) -> None:
        heard = b""
        end = self.clock() + self.seconds(len(sent)) + self.patience
        while len(heard) < len(sent) and (left := end - self.clock()) > 0:
            heard += self.port.read(left)
        if not heard:
            raise LineEcho(f"{self.name}: the line does not hear its own bytes: leave the option echo out")
        self._early = heard[len(sent) :]
        if heard[: len(sent)] != sent:
            self.stray += 1  # another device sends at the same time; the reply will show the effect

    def _await(self, listener: Listener[Answer], seconds: float) -> Answer | Miss:
        """Return the reply, or a Miss with the bytes received instead."""
        heard = bytearray()
        deadline = self.clock() + seconds + self.patience
        early, self._early = self._early, b""
        while True:
            data = early or self.port.read(max(0.0, deadline - self.clock()))
            early = b""
            if not data:
                return self._missed(listener, bytes(heard))
            deadline = self.clock() + self.patience
            for place, byte in enumerate(data):
                heard.append(byte)
                got = listener.take(byte)
                if got is not None and not isinstance(got, Fault):
                    self.stray += len(data) - place - 1
                    return got
                if got in (Fault.FOREIGN, Fault.BROKEN) or len(heard) > _MOST_NOISE:
                    fault = got if isinstance(got, Fault) else Fault.NOISE
                    return Miss(fault, bytes(heard) + data[place + 1 :] + self._rest())

    def _missed(self, listener: Listener[Answer], heard: bytes) -> Miss:
        """Return the Miss for silence, possibly after bytes that were no reply."""
        return Miss(Fault.NOISE if heard else None, heard)

    def _rest(self) -> bytes:
        """Return the bytes that arrive until the line is quiet; the time is limited."""
        gap = max(_GAP, self.seconds(_GAP_BYTES))
        rest, end = b"", self.clock() + 20 * gap
        while (data := self.port.read(gap)) and self.clock() < end:
            rest += data
        return rest


class Station(Turning, Protocol):
    """Station of the line."""

    @property
    def number(self) -> int: ...
    @property
    def motion(self) -> LineMotion | None: ...


LineT = TypeVar("LineT", bound=Master[Any])
StationT = TypeVar("StationT", bound=Station)


class LineBus(Device, Generic[LineT, StationT]):
    """Line with stations, which `axis` returns; see `part.Device`.

    If its `with` block is left by an exception, motions that this object started decelerate.
    """

    link: LineT
    line: LineT

    def __init__(self, line: LineT) -> None:
        self.line = self.link = line
        self._stations: dict[int, StationT] = {}

    @abstractmethod
    def make(self, station: int) -> StationT:
        """Create the driver of a station."""

    @abstractmethod
    def look_at(self, axis: StationT) -> None:
        """Read the unsolicited reports of a station."""

    def axis(self, station: int) -> StationT:
        """Return the station with this number, connected or not; the object is always the same."""
        made = self._stations.get(station)
        if made is None:
            made = self.make(station)
            self._stations[made.number] = made
        return made

    @property
    def axes(self) -> tuple[StationT, ...]:
        """Stations used so far."""
        return tuple(self._stations[number] for number in sorted(self._stations))

    def wait(
        self,
        motions: Sequence[LineMotion | StationT] | None = None,
        timeout: float | None = None,
        progress: Callable[[Progress], None] | None = None,
    ) -> list[End]:
        """Wait until motions, or the motions of stations, are over; return the ends for any cause.

        Args:
            motions: motions or stations; default: all stations in use.
            timeout: longest wait in s, `None` for no limit.
            progress: called about ten times a second.

        Raises:
            Timeout: the time is over; the other motions continue.
        """
        wanted = self.axes if motions is None else motions
        chosen = [one.motion if hasattr(one, "motion") else one for one in wanted]
        if motions is not None and None in chosen:
            raise OutOfRange("this station has no motion to wait for; start one first")
        return wait_all([one for one in chosen if one is not None], timeout, progress)

    def stop(self, stations: Iterable[int] | None = None, now: bool = False) -> list[End]:
        """Stop stations (default: those in use) and wait.

        All stations receive the stop command before an error is raised. Stopped stations are skipped.
        """
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
        """Wait on the clock of the line and poll the stations in use."""
        end = self.line.clock() + seconds
        while (left := end - self.line.clock()) > 0:
            for axis in self.axes:
                self.look_at(axis)
            self.line.pause(min(left, POLL_EVERY))

    def _chosen(self, stations: Iterable[int] | None) -> list[StationT]:
        return list(self.axes) if stations is None else [self.axis(number) for number in stations]
