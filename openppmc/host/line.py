"""Several stations on one line, regardless of their frames: master, motions, waiting, stopping, errors."""

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

# What a line with several stations can get wrong, as exceptions.


class StationSilent(NoAnswer):
    """No reply of a station came, however often it was asked."""


class GarbledReply(NoAnswer):
    """Bytes came, but never a whole reply: noise, a wrong speed, or two stations with one address."""


class DuplicateAddress(LinkError):
    """Two stations of a line seem to have the same address."""


class LineEcho(LinkError):
    """The line hears its own bytes, but was not told so."""


class LostReply(LinkError):
    """An instruction that may not be repeated was sent, and nobody knows whether it was carried out."""


def unanswered(where: str, misses: Sequence[Miss], attempts: int, check: str, others: str) -> NoAnswer:
    """What to say when all attempts to ask a station have failed.

    check: what to look at after silence. others: what makes garbled replies.
    """
    if not any(miss.heard for miss in misses):
        if len(misses) < attempts:
            return GarbledReply(f"{where} could not read {attempts} frames: check cable and termination")
        frames = "a frame" if attempts == 1 else f"{attempts} frames"
        return StationSilent(f"{where}: no reply to {frames}: {check}")
    if all(miss.fault is Fault.FOREIGN for miss in misses):
        return GarbledReply(f"{where}: another station replied, {attempts} times: does a second master talk?")
    return GarbledReply(f"{where}: only garbled replies, {attempts} times: {others}")


# Motions of stations on a line: their ends show only when somebody asks.

POLL_EVERY = 0.02
"""Seconds between two rounds of polls."""


class LineMotion(AnyMotion, Protocol):
    """A motion under way."""

    @property
    def unknown(self) -> EndUnknown | None:
        """Why the part does not confirm its end, None if it does or the motion is not over."""

    @property
    def line(self) -> Master[Any]:
        """Where its station is."""

    @property
    def station(self) -> int:
        """Its number."""

    def look(self) -> None:
        """Ask the station; sets `end`, or `unknown`, when the motion is over."""

    def now(self) -> Progress:
        """Where the motor is, or where the motion has ended."""


def wait_all(
    motions: Sequence[LineMotion],
    timeout: float | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> list[End]:
    """Ask the stations until their motions are over; ends in the same order, not judged.

    timeout: s for all of them, None for ever; Timeout leaves the rest running. progress: called about ten
    times a second, with pulses summed up if there are several motions. Raises EndUnknown as soon as one
    motion is over without a confirmed end; the rest run on.
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
            raise Timeout(f"station {who}: not over after {timeout:g} s: wait longer or stop it")
        if progress is not None and line.clock() >= due:
            progress(_sum(motions))
            due = line.clock() + PROGRESS_POLL
        line.pause(POLL_EVERY)


def _sum(motions: Sequence[LineMotion]) -> Progress:
    """Progress of several motions together; position is the first one's that still runs."""
    known = [(motion, motion.now()) for motion in motions]
    asked = [motion.asked for motion in motions]
    first = next(now for motion, now in known if motion.end is None)
    return Progress(
        first.position,
        sum(now.made for _, now in known),
        None if None in asked else sum(filter(None, asked)),
        max(now.seconds for _, now in known),
    )


# The master's end of a line with several stations, whatever their frames are: bytes out, one reply in.

PATIENCE = 0.1
"""Seconds beyond line time until a station counts as silent: it takes 4 ms, a USB adapter up to 16 ms."""
BITS = 10
_GAP_BYTES, _GAP = 5, 0.01
_MOST_NOISE = 400

Answer = TypeVar("Answer", covariant=True)


class Listener(Protocol[Answer]):
    """Takes the bytes of one reply."""

    def take(self, byte: int) -> Answer | Fault | None:
        """The next byte; a reply when it is complete, a Fault when it cannot become one any more."""


class Master(Generic[Answer]):
    """Half duplex: a frame, then the reply to it; faults are counted, nothing is repeated.

    port: open already. baud: line rate in bit/s. echo: the master hears its own bytes. patience: s beyond
    line time until a station is silent, at most 60. counters: one for each station, by its number.
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
        """OutOfRange for one that makes no sense."""
        if not 0 < exact(patience, "patience") <= 60:
            raise OutOfRange(f"patience {patience:g} s is outside 0 to 60 s")

    @property
    def port_patience(self) -> float:
        """What the port needs at least; virtual boards may be slower than real time."""
        return getattr(self.port, "patience", 0.0)

    @property
    def name(self) -> str:
        """The port as the user named it."""
        return self.port.name

    def clock(self) -> float:
        """Time of the port in s; that of `model:` is virtual."""
        return self.port.clock()

    def pause(self, seconds: float) -> None:
        """Let time of the port pass; bytes that come are dropped."""
        end = self.clock() + seconds
        while (left := end - self.clock()) > 0:
            self.stray += len(self.port.read(left))

    def wait_event(self, timeout: float) -> int | None:
        """There are none on a line: None after `timeout` seconds, bytes that come are dropped."""
        self.pause(timeout)
        return None

    def forget_events(self) -> None:
        """There are none on a line."""

    def close(self) -> None:
        """Close the port; allowed twice."""
        self._closed = True
        self.port.close()

    def seconds(self, count: int) -> float:
        """Line time of so many bytes."""
        return count * BITS / self.baud

    # ------------------------------------------------------------------ frames

    def ask(self, station: int, sent: bytes, listener: Listener[Answer], extra: float = 0.0) -> Answer | Miss:
        """Send a frame and await the reply. extra: s that the station may take longer. Raises LineEcho,
        Disconnected."""
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
        """Send a frame, and drop its echo if there is one. What came before is dropped."""
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
            self.stray += 1  # somebody else talks; the reply will show what it has done

    def _await(self, listener: Listener[Answer], seconds: float) -> Answer | Miss:
        """The reply, or what came instead."""
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
        """Silence, perhaps after bytes that were no reply."""
        return Miss(Fault.NOISE if heard else None, heard)

    def _rest(self) -> bytes:
        """What still comes until the line is quiet. Bounded."""
        gap = max(_GAP, self.seconds(_GAP_BYTES))
        rest, end = b"", self.clock() + 20 * gap
        while (data := self.port.read(gap)) and self.clock() < end:
            rest += data
        return rest


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
