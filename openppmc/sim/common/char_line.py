"""A line with modelled stations, character by character, in virtual time.

Characters of several stations at the same time collide.
"""

from __future__ import annotations

import random
from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from typing import Generic, Protocol, TypeVar

BITS = 10
_STOP_MIDDLE = 9.5
_CLEAN = 0.25
"""Bit times that two stations' equal characters may be apart without spoiling each other."""


class LineOptions(Protocol):
    """What the line itself needs of a spec."""

    @property
    def clk_hz(self) -> int:
        """Clock of the stations."""

    @property
    def echo(self) -> bool:
        """The master hears itself."""

    @property
    def noise(self) -> int:
        """One character in so many is damaged, either way; 0: none."""

    @property
    def seed(self) -> int:
        """Of the noise."""


class Hears(Protocol):
    """What a station needs of its part. sent: (edge in the middle of a stop bit, character)."""

    replies: list[tuple[int, bytes]]
    sent: list[tuple[int, int]]

    @property
    def now(self) -> int:
        """The last edge that was run."""

    @property
    def next_event(self) -> int | None:
        """The next edge on which anything happens by itself."""

    def hear(self, t: int, byte: int) -> None:
        """A character whose stop bit is sampled at edge t."""


H = TypeVar("H", bound=Hears)


class LineStation(ABC, Generic[H]):
    """What stations on a line have. number: address at first."""

    part: H
    clk_hz: int
    number: int
    t: int

    @abstractmethod
    def words(self) -> str:
        """State in words of `StationStatus`."""

    def set_inputs(self, levels: str) -> None:
        """Levels of the general inputs; without such there is nothing to do."""
        del levels

    @property
    def moving(self) -> bool:
        """Something happens by itself soon: time must pass in small steps."""
        event = self.part.next_event
        return event is not None and event < self.part.now + self.clk_hz // 50

    def hear(self, t: int, byte: int) -> None:
        """A character whose stop bit is sampled at edge t."""
        self.part.hear(max(t, self.part.now + 1), byte)

    def taken(self) -> list[tuple[int, int]]:
        """Characters sent since the last call, with the edge in the middle of their stop bits."""
        sent = self.part.sent[:]
        self.part.sent.clear()
        self.part.replies.clear()
        return sent


class Runs(Protocol):
    """A station that a line runs; `Carrier` and `LineStation` together are one."""

    number: int
    t: int

    def run_until(self, t: int) -> None:
        """Let time pass up to edge t."""

    def hear(self, t: int, byte: int) -> None:
        """A character whose stop bit is sampled at edge t."""

    def taken(self) -> list[tuple[int, int]]:
        """Characters sent since the last call, with the edge in the middle of their stop bits."""


S = TypeVar("S", bound=Runs)


class CharLine(Generic[S]):
    """The line with its stations. t: its time in clk; bit: clk of a bit, a fraction. Stations that are not in
    `hearing` may be behind it, up to `settle`: no one can tell, as they have no wires in common but the line.
    """

    def __init__(self, spec: LineOptions, stations: Sequence[S], bit: float) -> None:
        self.spec, self.stations, self.bit = spec, list(stations), bit
        self.t: int = max(one.t for one in stations)
        self.hearing: Sequence[S] = self.stations
        self._free = self.t
        self._random = random.Random(spec.seed)
        self._waiting = bytearray()
        self._late: list[tuple[int, int]] = []

    @property
    def seconds(self) -> float:
        """Virtual time in s."""
        return self.t / self.spec.clk_hz

    def station(self, number: int) -> S:
        """The station with this number, at the time of the line."""
        self.settle()
        return next(one for one in self.stations if one.number == number)

    def heard(self, byte: int) -> None:
        """A character of the master is on its way to the stations `hearing`."""

    # ------------------------------------------------------------------ time

    def run(self, clk: int) -> None:
        """Let time pass for the line and the stations that hear it."""
        self.t += clk
        for one in self.hearing:
            one.run_until(self.t)
        sent = [(t, byte) for one in self.hearing for t, byte in one.taken()]
        if sent:
            self._arrive(sorted(sent))

    def settle(self) -> None:
        """Let all stations come up to the time of the line."""
        for one in self.stations:
            one.run_until(self.t)

    def run_seconds(self, seconds: float) -> None:
        """The same in s; ends early, at a character's end, when one comes."""
        end = self.t + max(1, round(seconds * self.spec.clk_hz))
        step = round(BITS * self.bit)
        while self.t < end and not self._waiting:
            self.run(min(step, end - self.t))

    # ------------------------------------------------------------------ bytes

    def write(self, data: bytes) -> None:
        """Characters of the master, back to back, from now on (or after those that are still going out)."""
        begin = max(self.t, self._free)
        for place, byte in enumerate(data):
            if self.spec.echo:
                self._late.append((begin, byte))
            got = self._noisy(byte)
            if got is None:
                continue
            self.heard(got)
            at = begin + round((place * BITS + _STOP_MIDDLE) * self.bit)
            for one in self.hearing:
                one.hear(at, got)
        self._free = begin + round(len(data) * BITS * self.bit)
        self.run(self._free - self.t)
        self._waiting += bytes(byte for _, byte in self._late)
        self._late.clear()

    def read(self) -> bytes:
        """What has come from the stations so far."""
        data = bytes(self._waiting)
        self._waiting.clear()
        return data

    def _arrive(self, heard: Iterable[tuple[int, int]]) -> None:
        """Characters on their way to the master; those at the same time spoil each other."""
        last, value = -(1 << 62), 0
        for t, byte in heard:
            apart = (t - last) / self.bit
            if apart < BITS - 1:
                if apart > _CLEAN or byte != value:
                    value &= byte >> round(apart) % 8
                    self._waiting[-1:] = bytes([value])
                continue
            last, value = t, byte
            got = self._noisy(byte)
            if got is not None:
                self._waiting.append(got)

    def _noisy(self, byte: int) -> int | None:
        """A character as it arrives: now and then with a wrong bit, or not at all."""
        if not self.spec.noise or self._random.randrange(self.spec.noise):
            return byte
        bit = self._random.randrange(9)
        return None if bit == 8 else byte ^ 1 << bit
