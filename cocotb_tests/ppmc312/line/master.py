"""Bit-level master of the line, on the RTL (`RtlPort`) or on golden models (`models.ModelLine`)."""

from __future__ import annotations

from collections.abc import Coroutine
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, TypeVar

from cocotb_tests.harness import RtlBench
from openppmc.model.ppmc312.front.serial import INSTRUCTION, POLL, checksum, frame

from .setting import BIT
from .wave import Wave, length, wave

T = TypeVar("T")
T_EXEC, T_INIT = 4096, 65_536
"""Maximum number of cycles from the end of the checksum's stop bit to the reply (P312-PRT-04).

T_INIT applies to instruction 00, T_EXEC to all other instructions.
"""
KINDS = {0x80: "busy", 0x90: "ready", 0xA0: "data", 0xB0: "specific"}


class Port(Protocol):
    """Interface of a master to a line: pins and time."""

    @property
    def now(self) -> int:
        """Next edge."""

    async def until(self, edge: int) -> int:
        """Run to just before an edge."""

    def set(self, **levels: int) -> int:
        """Set pins from edge `now` on."""

    async def fall(self, limit: int) -> int | None:
        """Return the edge at which the line falls; None if it does not fall within `limit` cycles."""

    def line_at(self, edge: int) -> int:
        """Return the level of the line just after an edge."""


class RtlPort:
    """Port of a master to the bench of `ppmc312_line`."""

    def __init__(self, bench: RtlBench) -> None:
        self.bench = bench

    @property
    def now(self) -> int:
        """Next edge."""
        return self.bench.now

    async def until(self, edge: int) -> int:
        """Run to just before an edge."""
        return await self.bench.until(max(edge, self.bench.now))

    def set(self, **levels: int) -> int:
        """Set pins from edge `now` on."""
        return self.bench.set(**levels)

    async def fall(self, limit: int) -> int | None:
        """Return the edge at which the line falls; None if it does not fall within `limit` cycles."""
        if self.bench.level("line"):
            try:
                return await self.bench.edge("line", 0, limit)
            except TimeoutError:
                await self.bench.align()
                return None
        return self.bench.falls("line")[-1]

    def line_at(self, edge: int) -> int:
        """Return the level of the line just after an edge."""
        return self.bench.level_at("line", edge)


def at_once(work: Coroutine[Any, Any, T]) -> T:
    """Return the result of a coroutine that never suspends, such as a coroutine on golden models."""
    try:
        work.send(None)
    except StopIteration as done:
        return done.value  # type: ignore[no-any-return]
    raise RuntimeError("it waits for something")


class Reply(NamedTuple):
    """A reply: kind ("busy", "ready", "data" or "specific"), number of the station, data."""

    kind: str
    station: int
    data: bytes

    def __str__(self) -> str:
        return f"{self.station} {self.kind} {self.data.hex(' ')}".strip()


@dataclass(frozen=True)
class SentCharacters:
    """Characters on the line, from the start of the first start bit to the end of the last stop bit."""

    begin: int
    end: int
    data: bytes


class NoFrameError(AssertionError):
    """Error: the received characters are not a frame."""


def understood(data: bytes, mode: str = "BINARY") -> Reply:
    """Decode a reply frame; raise NoFrameError if the characters are not a reply (P312-SER-02, -13)."""
    text = data[1:-1]
    good = len(data) >= 2 and data[0] & 0xC0 == 0x80 and not len(text) % 2
    if not good or not all(character in b"0123456789abcdef" for character in text):
        raise NoFrameError(f"no frame: {data.hex(' ')}")
    content = bytes.fromhex(text.decode())
    if checksum(data[0], content, mode) != data[-1]:
        raise NoFrameError(f"wrong checksum: {data.hex(' ')}")
    return Reply(KINDS[data[0] & 0xF0], data[0] & 0x0F, content)


class Master:
    """Master of the line. `said` and `heard` record the characters on the line.

    Args:
        bit: bit time in cycles.
    """

    def __init__(self, port: Port, bit: float = BIT, mode: str = "BINARY") -> None:
        self.port, self.bit, self.mode = port, bit, mode
        self.said: list[SentCharacters] = []
        self.heard: list[SentCharacters] = []

    # ------------------------------------------------------------------ characters

    async def drive(self, levels: Wave) -> None:
        """Drive these levels on the line."""
        for t, level in levels:
            await self.port.until(t)
            self.port.set(master=level)

    async def send(self, data: bytes, gap: float = 0.0) -> None:
        """Send characters, each followed by `gap` idle bits; return in the middle of the last stop bit."""
        begin = self.port.now
        end = begin + length(data, self.bit, gap)
        await self.drive(wave(data, begin, self.bit, gap))
        await self.port.until(round(end - (gap + 0.5) * self.bit))
        self.said.append(SentCharacters(begin, round(end), data))

    async def hear(self, limit: int) -> bytes:
        """Receive characters until the line is high for two bits.

        Return b"" if no character begins within `limit` cycles.
        """
        data, begin, wait = bytearray(), 0, limit
        while (start := await self.port.fall(wait)) is not None:
            begin = begin or start
            middles = [round(start + (number + 0.5) * self.bit) for number in range(10)]
            await self.port.until(middles[-1] + 1)
            data.append(sum(self.port.line_at(t) << place for place, t in enumerate(middles[1:-1])))
            if not self.port.line_at(middles[-1]):
                break  # a break or a collision
            wait = round(2.5 * self.bit)
        if data:
            self.heard.append(
                SentCharacters(begin, round(start_end(begin, len(data), self.bit)), bytes(data))
            )
        return bytes(data)

    async def quiet(self, bits: float = 20) -> None:
        """Send nothing until the line has been high for `bits` bits."""
        while await self.port.fall(round(bits * self.bit)) is not None:
            await self.rest(1)

    async def rest(self, bits: float) -> None:
        """Send nothing for `bits` bits."""
        await self.port.until(self.port.now + round(bits * self.bit))

    # ------------------------------------------------------------------ frames

    def frame(self, control: int, data: bytes = b"") -> bytes:
        """Return a frame with its checksum."""
        return frame(control, data, self.mode)

    async def exchange(self, message: bytes, limit: int = T_EXEC) -> Reply | None:
        """Send characters and return the reply, or None if there is no reply.

        Raises NoFrameError if the reply is not a frame.
        """
        await self.send(message)
        data = await self.hear(limit + round(1.2 * self.bit))
        return understood(data, self.mode) if data else None

    async def ask(self, station: int, text: str) -> Reply:
        """Send an instruction (hexadecimal text) and return its reply.

        Raises NoFrameError if there is no reply.
        """
        data = bytes.fromhex(text)
        reply = await self.exchange(self.frame(INSTRUCTION | station, data), T_EXEC if data[0] else T_INIT)
        if reply is None or reply.station != station:
            raise NoFrameError(f"{text} to station {station}: {reply or 'no reply'}")
        return reply

    async def poll(self, station: int) -> Reply | None:
        """Poll a station once; return its reply, or None if there is no reply."""
        return await self.exchange(self.frame(POLL | station))


def start_end(begin: int, count: int, bit: float) -> float:
    """Return the duration of characters without a gap, up to the end of the last stop bit."""
    return begin + 10 * count * bit
