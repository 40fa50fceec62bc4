"""Line with modelled stations, simulated character by character in virtual time.

Characters that several stations send at the same time collide.
"""

from __future__ import annotations

import random
from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from typing import Generic, Protocol, TypeVar

BITS = 10
_STOP_MIDDLE = 9.5
_CLEAN = 0.25
"""Largest distance in bit times at which equal characters of two stations do not corrupt each other."""


class LineOptions(Protocol):
    """Fields of a requested line (spec) that the simulated line itself uses."""

    @property
    def clk_hz(self) -> int:
        """Clock of the stations in Hz."""

    @property
    def echo(self) -> bool:
        """True if the master receives its own characters."""

    @property
    def noise(self) -> int:
        """Average number of characters, in both directions, of which one is corrupted; 0 for no noise."""

    @property
    def seed(self) -> int:
        """Seed of the noise."""


class CharReceiver(Protocol):
    """Model that receives characters.

    Attributes:
        sent: (edge in the middle of a stop bit, character).
    """

    replies: list[tuple[int, bytes]]
    sent: list[tuple[int, int]]

    @property
    def now(self) -> int:
        """The last simulated edge."""

    @property
    def next_event(self) -> int | None:
        """The next edge at which the state changes without input; None without such an edge."""

    def on_char(self, t: int, byte: int) -> None:
        """Receive a character whose stop bit is sampled at edge t."""


H = TypeVar("H", bound=CharReceiver)


class LineStation(ABC, Generic[H]):
    """Station on a line.

    Attributes:
        number: initial address of the station.
    """

    part: H
    clk_hz: int
    number: int
    t: int

    @abstractmethod
    def status_text(self) -> str:
        """Return the state in the format of `StationStatus`."""

    def set_inputs(self, levels: str) -> None:
        """Set the levels of the general inputs.

        The call has no effect on a station without general inputs.
        """
        del levels

    @property
    def moving(self) -> bool:
        """True if the state will change soon without input, so that time must advance in small steps."""
        event = self.part.next_event
        return event is not None and event < self.part.now + self.clk_hz // 50

    def on_char(self, t: int, byte: int) -> None:
        """Receive a character whose stop bit is sampled at edge t."""
        self.part.on_char(max(t, self.part.now + 1), byte)

    def pop_sent(self) -> list[tuple[int, int]]:
        """Return new characters since the last call, as (edge in the middle of a stop bit, byte)."""
        sent = self.part.sent[:]
        self.part.sent.clear()
        self.part.replies.clear()
        return sent


class SimulatedStation(Protocol):
    """Station that a line simulates. `Carrier` and `LineStation` together implement this protocol."""

    number: int
    t: int

    def run_until(self, t: int) -> None:
        """Simulate up to edge t."""

    def on_char(self, t: int, byte: int) -> None:
        """Receive a character whose stop bit is sampled at edge t."""

    def pop_sent(self) -> list[tuple[int, int]]:
        """Return new characters since the last call, as (edge in the middle of a stop bit, byte)."""


S = TypeVar("S", bound=SimulatedStation)


class CharLine(Generic[S]):
    """Line with its stations.

    Until `settle` is called, the simulation of stations that are not in `listeners` may lag behind the time t
    of the line. This has no visible effect, because the line is the only connection of the stations.

    Args:
        bit: duration of a bit in cycles, which may be a fraction.

    Attributes:
        t: time of the line in cycles.
    """

    def __init__(self, spec: LineOptions, stations: Sequence[S], bit: float) -> None:
        self.spec, self.stations, self.bit = spec, list(stations), bit
        self.t: int = max(one.t for one in stations)
        self.listeners: Sequence[S] = self.stations
        self._free = self.t
        self._random = random.Random(spec.seed)
        self._waiting = bytearray()
        self._echo: list[tuple[int, int]] = []

    @property
    def seconds(self) -> float:
        """Virtual time in s."""
        return self.t / self.spec.clk_hz

    def station(self, number: int) -> S:
        """Return the station with this number, simulated up to the time of the line."""
        self.settle()
        return next(one for one in self.stations if one.number == number)

    def select_listeners(self, byte: int) -> None:
        """Set `listeners` to the stations that receive this character of the master."""

    # ------------------------------------------------------------------ time

    def run(self, clk: int) -> None:
        """Advance the line and the stations in `listeners` by a number of cycles."""
        self.t += clk
        for one in self.listeners:
            one.run_until(self.t)
        sent = [(t, byte) for one in self.listeners for t, byte in one.pop_sent()]
        if sent:
            self._deliver(sorted(sent))

    def settle(self) -> None:
        """Simulate all stations up to the time of the line."""
        for one in self.stations:
            one.run_until(self.t)

    def run_seconds(self, seconds: float) -> None:
        """Advance by a time in s; if a character arrives at the master, stop at its end."""
        end = self.t + max(1, round(seconds * self.spec.clk_hz))
        step = round(BITS * self.bit)
        while self.t < end and not self._waiting:
            self.run(min(step, end - self.t))

    # ------------------------------------------------------------------ bytes

    def write(self, data: bytes) -> None:
        """Send characters of the master without gaps, after those that are still being sent."""
        begin = max(self.t, self._free)
        for place, byte in enumerate(data):
            if self.spec.echo:
                self._echo.append((begin, byte))
            changed = self._with_noise(byte)
            if changed is None:
                continue
            self.select_listeners(changed)
            at = begin + round((place * BITS + _STOP_MIDDLE) * self.bit)
            for one in self.listeners:
                one.on_char(at, changed)
        self._free = begin + round(len(data) * BITS * self.bit)
        self.run(self._free - self.t)
        self._waiting += bytes(byte for _, byte in self._echo)
        self._echo.clear()

    def read(self) -> bytes:
        """Return the characters that the master has received since the last call."""
        data = bytes(self._waiting)
        self._waiting.clear()
        return data

    def _deliver(self, received: Iterable[tuple[int, int]]) -> None:
        """Deliver characters to the master. Characters that overlap in time corrupt each other."""
        last, value = -(1 << 62), 0
        for t, byte in received:
            apart = (t - last) / self.bit
            if apart < BITS - 1:
                if apart > _CLEAN or byte != value:
                    value &= byte >> round(apart) % 8
                    self._waiting[-1:] = bytes([value])
                continue
            last, value = t, byte
            changed = self._with_noise(byte)
            if changed is not None:
                self._waiting.append(changed)

    def _with_noise(self, byte: int) -> int | None:
        """Return a character as it is received: unchanged, with a wrong bit, or None if it is lost."""
        if not self.spec.noise or self._random.randrange(self.spec.noise):
            return byte
        bit = self._random.randrange(9)
        return None if bit == 8 else byte ^ 1 << bit
