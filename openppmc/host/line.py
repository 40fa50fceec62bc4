"""Lines with several stations: the master, motions and errors. The code supports any frame format."""

# ruff: noqa: N818

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeVar

from ..lazy import renamed
from .check import exact
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
from .line_port import Counters, Fault, MissingReply
from .motion import PROGRESS_POLL, AnyMotion, Progress
from .motion_result import EndUnknown, MotionResult
from .part import Device, Stoppable
from .port import Port

# Exceptions of a line with several stations.


class StationNotResponding(NoAnswer):
    """No reply of a station was received after all attempts."""


class CorruptReply(NoAnswer):
    """Bytes were received, but they contain no valid reply.

    The cause is noise, a wrong speed, or two stations with one address.
    """


class DuplicateAddress(LinkError):
    """Two stations of a line seem to have the same address."""


class LineEcho(LinkError):
    """The master receives its own bytes, although it is not configured for an echo."""


class LostReply(LinkError):
    """It is unknown whether an instruction was executed, and it must not be executed twice."""


def unanswered(
    where: str, misses: Sequence[MissingReply], attempts: int, check: str, others: str
) -> NoAnswer:
    """Return the exception for a station after all attempts have failed.

    Args:
        check: advice to the user for the case that no bytes were received.
        others: possible causes of corrupt replies, as text.
    """
    if not any(miss.received for miss in misses):
        if len(misses) < attempts:
            return CorruptReply(f"{where} could not read {attempts} frames: check cable and termination")
        frames = "a frame" if attempts == 1 else f"{attempts} frames"
        return StationNotResponding(f"{where}: no reply to {frames}: {check}")
    if all(miss.fault is Fault.FOREIGN for miss in misses):
        return CorruptReply(f"{where}: another station replied, {attempts} times: check for a second master")
    return CorruptReply(f"{where}: only garbled replies, {attempts} times: {others}")


# Motions of stations on a line. Only a poll detects their ends.

POLL_EVERY = 0.02
"""Seconds between two rounds of polls."""


class LineMotion(AnyMotion, Protocol):
    """Motion of a station; see `motion.AnyMotion`."""

    @property
    def result_error(self) -> EndUnknown | None:
        """EndUnknown error if the part does not confirm how the motion ended.

        The value is `None` while the motion is running, and also if the part has confirmed how it ended.
        """

    @property
    def line(self) -> Master[Any]:
        """Line of the station."""

    @property
    def station(self) -> int:
        """Number of the station."""

    def _update(self) -> None:
        """Poll the station; set `result` or `result_error` if the motion is over."""

    def _current_progress(self) -> Progress:
        """Return the current progress; after the end of the motion, the progress at its end."""


def wait_all(
    motions: Sequence[LineMotion],
    timeout: float | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> list[MotionResult]:
    """Poll the stations until their motions are over; return the results in the same order.

    A motion that ended early is not an error.

    Args:
        timeout: longest wait for all motions together in s, `None` for no limit.
        progress: called about ten times a second with the common progress of all motions, in which their
            pulses are added.

    Raises:
        Timeout: the time limit is exceeded; the running motions continue.
        EndUnknown: the end of a motion is not confirmed; the other motions continue.
    """
    if not motions:
        return []
    line = motions[0].line
    limit = None if timeout is None else line.clock() + timeout
    due = line.clock() + PROGRESS_POLL
    while True:
        for motion in motions:
            if not motion.over:
                motion._update()
        running = [motion for motion in motions if not motion.over]
        for motion in motions:
            if motion.result_error is not None:
                raise motion.result_error
        if not running:
            return [motion.result for motion in motions if motion.result is not None]
        if limit is not None and line.clock() >= limit:
            numbers = ", ".join(str(motion.station) for motion in running)
            raise Timeout(
                f"station {numbers}: motion still in progress after {timeout:g} s; "
                "increase timeout or stop the motion"
            )
        if progress is not None and line.clock() >= due:
            progress(_sum(motions))
            due = line.clock() + PROGRESS_POLL
        line.pause(POLL_EVERY)


def _sum(motions: Sequence[LineMotion]) -> Progress:
    """Return the total progress of several motions; the position is that of the first running motion."""
    known = [(motion, motion._current_progress()) for motion in motions]
    requested = [motion.requested for motion in motions]
    first = next(now for motion, now in known if motion.result is None)
    return Progress(
        first.position,
        sum(now.done for _, now in known),
        None if None in requested else sum(filter(None, requested)),
        max(now.seconds for _, now in known),
    )


# Master of a line with several stations, for any frame format. It sends a frame and receives one reply.

PATIENCE = 0.1
"""Time in s that the master waits for a reply in addition to the transmission time on the line.

A station needs 4 ms for a reply, and a USB adapter delays it by up to 16 ms.
"""
BITS = 10
_GAP_BYTES, _GAP = 5, 0.01
_MOST_NOISE = 400

Answer = TypeVar("Answer", covariant=True)


class ReplyReceiver(Protocol[Answer]):
    """Receiver for the bytes of one reply."""

    def feed(self, byte: int) -> Answer | Fault | None:
        """Process a byte; return the reply if this byte completes it.

        The call returns a Fault if no further byte can make the received bytes a reply.
        """


class Master(Generic[Answer]):
    """Half-duplex master: it sends a frame and receives the reply.

    The master counts faults, but does not repeat frames.

    Attributes:
        port: open port.
        baud: line rate in bit/s.
        echo: True if the master receives its own bytes.
        patience: time in s that the master waits for a reply in addition to the transmission time on the
            line; at most 60.
        counters: counters of each station, by its number.
    """

    def __init__(self, port: Port, baud: int, echo: bool, patience: float) -> None:
        self.port, self.baud, self.echo = port, baud, echo
        self.patience = max(patience, self.port_patience)
        self.counters: dict[int, Counters] = {}
        self.stray_bytes = 0
        self._closed = False
        self._early_bytes = b""

    @staticmethod
    def check_patience(patience: float) -> None:
        """Check that `patience` is more than 0 s and at most 60 s. Raises OutOfRange."""
        if not 0 < exact(patience, "patience") <= 60:
            raise OutOfRange(f"patience {patience:g} s is outside 0 to 60 s")

    @property
    def port_patience(self) -> float:
        """Smallest value of `patience` in s for this port; virtual lines, which may be slow, need more."""
        return getattr(self.port, "patience", 0.0)

    @property
    def name(self) -> str:
        """Port as the user named it."""
        return self.port.name

    def clock(self) -> float:
        """Return the time of the port in s; the time of `model:` is virtual."""
        return self.port.clock()

    def pause(self, seconds: float) -> None:
        """Wait for a number of seconds, measured with the clock of the port; discard received bytes."""
        end = self.clock() + seconds
        while (left := end - self.clock()) > 0:
            self.stray_bytes += len(self.port.read(left))

    def wait_event(self, timeout: float) -> int | None:
        """Wait `timeout` seconds and return `None`, because a line has no events; discard received bytes."""
        self.pause(timeout)
        return None

    def forget_events(self) -> None:
        """Do nothing, because a line has no events."""

    def close(self) -> None:
        """Close the port; a second call is allowed."""
        self._closed = True
        self.port.close()

    def seconds(self, count: int) -> float:
        """Return the transmission time of this number of bytes in s."""
        return count * BITS / self.baud

    # ------------------------------------------------------------------ frames

    def request(
        self, station: int, sent: bytes, listener: ReplyReceiver[Answer], extra: float = 0.0
    ) -> Answer | MissingReply:
        """Send a frame and wait for the reply.

        Args:
            extra: additional time in s that the station may need.

        Raises:
            LineEcho, Disconnected: the line or the port failed.
        """
        self.send(station, sent)
        counters = self.counters[station]
        got = self._await(listener, sent, self.seconds(len(sent)) + extra)
        if isinstance(got, MissingReply):
            if got.fault is Fault.FOREIGN:
                counters.foreign += 1
            elif got.received:
                counters.garbled += 1
            else:
                counters.silent += 1
        return got

    def send(self, station: int, sent: bytes) -> None:
        """Discard bytes received earlier, send a frame, and discard its echo, if any."""
        if self._closed:
            raise Disconnected(f"{self.name}: the line is closed: open it again")
        self.stray_bytes += len(self.port.read(0))
        self.counters.setdefault(station, Counters()).sent += 1
        self.port.write(sent)
        if self.echo:
            self._drop_echo(sent)

    def _drop_echo(self, sent: bytes) -> None:
        received = b""
        end = self.clock() + self.seconds(len(sent)) + self.patience
        while len(received) < len(sent) and (left := end - self.clock()) > 0:
            received += self.port.read(left)
        if not received:
            raise LineEcho(f"{self.name}: the master does not receive its own bytes: remove the option echo")
        self._early_bytes = received[len(sent) :]
        if received[: len(sent)] != sent:
            self.stray_bytes += 1  # another device sends at the same time; the reply will show the effect

    def _await(self, listener: ReplyReceiver[Answer], sent: bytes, seconds: float) -> Answer | MissingReply:
        """Return the reply, or a MissingReply with the bytes that were received instead."""
        received = bytearray()
        deadline = self.clock() + seconds + self.patience
        early, self._early_bytes = self._early_bytes, b""
        while True:
            data = early or self.port.read(max(0.0, deadline - self.clock()))
            early = b""
            if not data:
                return self._missing_reply(listener, bytes(received))
            deadline = self.clock() + self.patience
            for place, byte in enumerate(data):
                received.append(byte)
                got = listener.feed(byte)
                if got is not None and not isinstance(got, Fault):
                    self.stray_bytes += len(data) - place - 1
                    return got
                if got in (Fault.FOREIGN, Fault.BROKEN) or len(received) > _MOST_NOISE:
                    fault = got if isinstance(got, Fault) else Fault.NOISE
                    received += data[place + 1 :]
                    return MissingReply(fault, self._read_until_idle(bytes(received), sent))

    def _missing_reply(self, listener: ReplyReceiver[Answer], received: bytes) -> MissingReply:
        """Return the MissingReply for a wait in which no byte, or no valid reply, was received."""
        return MissingReply(Fault.NOISE if received else None, received)

    def _read_until_idle(self, received: bytes, sent: bytes) -> bytes:
        """Return `received` and the bytes that arrive until the line is idle; the wait is limited.

        The wait for the rest of an echo is longer, because a USB adapter may deliver an echo in pieces.
        """
        gap = max(_GAP, self.seconds(_GAP_BYTES))
        end = self.clock() + 20 * gap
        while (echo := sent.startswith(received) and received != sent) or self.clock() < end:
            data = self.port.read(self.patience if echo else gap)
            if not data:
                break
            received += data
        return received


class Station(Stoppable, Protocol):
    """Members of a station that the line needs."""

    @property
    def number(self) -> int: ...
    @property
    def motion(self) -> LineMotion | None: ...


LineT = TypeVar("LineT", bound=Master[Any])
StationT = TypeVar("StationT", bound=Station)


class LineBus(Device, Generic[LineT, StationT]):
    """Line with stations; `axis` returns a station. See `part.Device`.

    If an exception leaves the `with` block of the line, the motions that this object started decelerate.
    """

    link: LineT
    line: LineT

    def __init__(self, line: LineT) -> None:
        self.line = self.link = line
        self._stations: dict[int, StationT] = {}

    @abstractmethod
    def _make_station(self, station: int) -> StationT:
        """Create the driver of a station."""

    @abstractmethod
    def _collect_reports(self, axis: StationT) -> None:
        """Read the unsolicited reports of a station."""

    def axis(self, station: int) -> StationT:
        """Return the station with this number. The station does not have to be connected.

        Each call returns the same object.
        """
        driver = self._stations.get(station)
        if driver is None:
            driver = self._make_station(station)
            self._stations[driver.number] = driver
        return driver

    @property
    def axes(self) -> tuple[StationT, ...]:
        """Stations that `axis` has returned so far."""
        return tuple(self._stations[number] for number in sorted(self._stations))

    def wait(
        self,
        motions: Sequence[LineMotion | StationT] | None = None,
        timeout: float | None = None,
        progress: Callable[[Progress], None] | None = None,
    ) -> list[MotionResult]:
        """Wait until motions are over; return their results.

        Motions that ended early are included.

        Args:
            motions: motions, or stations whose last motions are waited for; default: all stations in use.
            timeout: longest wait in s, `None` for no limit.
            progress: called about ten times a second.

        Raises:
            Timeout: the time limit is exceeded; the running motions continue.
        """
        waiting = self.axes if motions is None else motions
        chosen = [one.motion if hasattr(one, "motion") else one for one in waiting]
        if motions is not None and None in chosen:
            raise OutOfRange("this station has no motion to wait for; start one first")
        return wait_all([one for one in chosen if one is not None], timeout, progress)

    def stop(self, stations: Iterable[int] | None = None, now: bool = False) -> list[MotionResult]:
        """Stop stations (default: those in use) and wait for the end of their motions.

        All stations receive the stop command before an error is raised. Stations whose motor is stopped are
        skipped.
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

    def process_reports(self, seconds: float) -> None:
        """Poll the stations in use for `seconds`, measured with the clock of the line."""
        end = self.line.clock() + seconds
        while (left := end - self.line.clock()) > 0:
            for axis in self.axes:
                self._collect_reports(axis)
            self.line.pause(min(left, POLL_EVERY))

    def _chosen(self, stations: Iterable[int] | None) -> list[StationT]:
        return list(self.axes) if stations is None else [self.axis(number) for number in stations]


if not TYPE_CHECKING:
    __getattr__ = renamed(
        __name__,
        {
            "GarbledReply": "CorruptReply",
            "StationSilent": "StationNotResponding",
        },
    )
