"""Serial line of the PMC006B4 with its timing: receiver, gaps between characters, replies.

Rules: P006-UART-01..05, P006-FRM-04, -07.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from itertools import groupby
from math import ceil
from typing import NamedTuple

from ..chip import Phase
from ..uart import Receiver
from .pins import Services

# Frames of the PMC006B4: eight bytes with address and checksum (P006-FRM-01..08). This section does not model
# time.

HEAD, ANSWER, SIZE = 0xA5, 0x7A, 8


class Command(NamedTuple):
    """Frame with a valid checksum. Its data are a signed 32-bit number."""

    address: int
    code: int
    data: int


def checked(*parts: int, data: int) -> bytes:
    """Return a frame: byte 0xA5, bytes 1 and 2, the data and the checksum."""
    body = bytes((HEAD, *parts)) + (data & 0xFFFF_FFFF).to_bytes(4, "little")
    return body + bytes([sum(body) % 256])


def command(address: int, code: int | str, data: int = 0) -> bytes:
    """Return a frame of a host.

    Args:
        code: instruction code, as a number or as the letter of the instruction.
    """
    return checked(address, ord(code) if isinstance(code, str) else code, data=data)


def reply(address: int, data: int) -> bytes:
    """Return a frame of a controller."""
    return checked(ANSWER, address, data=data)


class Assembler:
    """Receiver that converts bytes to commands."""

    def __init__(self) -> None:
        self._open = b""

    @property
    def unfinished(self) -> bool:
        """True if a frame has begun but is not complete."""
        return bool(self._open)

    def drop(self) -> None:
        """Discard a frame that has begun."""
        self._open = b""

    def take(self, byte: int) -> Command | None:
        """Process a byte; return the command if this byte completes it."""
        if not self._open and byte != HEAD:
            return None
        self._open += bytes([byte])
        if len(self._open) < SIZE:
            return None
        whole, self._open = self._open, b""
        if sum(whole[:-1]) % 256 != whole[-1]:
            return None
        return Command(whole[1], whole[2], int.from_bytes(whole[3:7], "little", signed=True))


STOP = Fraction(163, 2)
"""Bit times from the last sample of a frame to the middle of the last stop bit of its reply.

From this time on, a host may send.
"""
SYNC = 2
"""Number of cycles from the edge that samples a level to its effect."""
SILENCE = 192
"""Time without a start bit after which an incomplete frame is dropped, in bit times."""


def changes_of(frame: bytes) -> list[tuple[int, str, int]]:
    """Return the changes of the pins during a reply as (time, pin, level).

    A time is in bit times after the sample of the last stop bit of the frame.
    """
    levels = [1]
    for byte in frame:
        levels += [0, *(byte >> place & 1 for place in range(8)), 1]
    edges = [(2 + k, "txd", level) for k, level in enumerate(levels[1:]) if level != levels[k]]
    return [(1, "de", 1), *edges, (2 + 10 * SIZE, "de", 0)]


class Line:
    """Serial line. The receiver is closed until `listen` is called.

    Args:
        take: take(t, command) is called when a frame with a valid checksum is complete. Edge t samples its
            last stop bit. take returns True if the frame is for this controller (P006-FRM-02).
        replies: list to which (edge at which de rises, frame) of each reply is appended.
        sent: list to which (edge in the middle of the stop bit, byte) of each byte sent is appended.
    """

    def __init__(
        self,
        services: Services,
        baud: int,
        take: Callable[[int, Command], bool],
        replies: list[tuple[int, bytes]],
        sent: list[tuple[int, int]],
    ) -> None:
        self._services, self._take = services, take
        self._bit = Fraction(services.clk_hz, baud)
        self._receiver = Receiver(services, self._bit, self._on_received)
        self._assembler = Assembler()
        self._silence = ceil((SILENCE + Fraction(19, 2)) * self._bit)
        self._last_char_at = 0
        self._pin = self._level = 1
        self._open = False
        self._muted = True
        self._e = 0
        self._replies, self._sent = replies, sent

    # ------------------------------------------------------------------ from the host

    def sample(self, t: int, level: int, other: int) -> None:
        """Sample the pin at edge t.

        Args:
            level: level that the receiver samples.
            other: level that decides when a receiver opens; it may differ from `level` for a cycle.
        """
        self._pin = level
        self._services.queue.at(t + SYNC, Phase.PINS, lambda now: self._on_level(now, other))
        if self._open:
            self._on_receiver_level(t + SYNC, level)

    def _on_level(self, t: int, level: int) -> None:
        """Process a synchronised level that is present from edge t on.

        A high level opens an enabled receiver.
        """
        self._level = level
        if level and not self._muted and not self._open:
            self._services.queue.at(t, Phase.BUS, self._open_up)

    def listen(self, t: int, on: bool) -> None:
        """Enable or close the receiver after edge t. An enabled receiver opens once the line is high."""
        self._muted = not on
        if not on:
            self._open = False
            self._receiver.abort()
            self._receiver.on_level(t, 1)
        elif self._level:
            self._services.queue.at(t + 1, Phase.BUS, self._open_up)

    def _open_up(self, t: int) -> None:
        """Open the receiver if it is enabled and the line was high before edge t.

        The next edge is the first to sample the pin.
        """
        if not self._muted and not self._open and self._level:
            self._open = True
            self._services.queue.at(
                t + 1, Phase.BUS, lambda now: self._on_receiver_level(now + SYNC, self._pin)
            )

    def _on_receiver_level(self, t: int, level: int) -> None:
        self._services.queue.at(
            t, Phase.PINS, lambda now: self._receiver.on_level(now, level if self._open else 1)
        )

    def _on_received(self, t: int, byte: int | None) -> None:
        """Process a character whose stop bit was sampled at edge t."""
        self._services.queue.at(t, Phase.BUS, lambda now: self.on_char(now, byte))

    def on_char(self, t: int, byte: int | None) -> None:
        """Process a character at edge t; `byte` is `None` if its stop bit was low."""
        if self._muted:
            return
        if byte is None or t - self._last_char_at >= self._silence:
            self._assembler.drop()
        self._last_char_at = t
        command = None if byte is None else self._assembler.take(byte)
        if command and self._take(t, command):
            self._e = t
            self.listen(t, False)

    # ------------------------------------------------------------------ to the host

    def answer(self, frame: bytes) -> None:
        """Send the reply to the last command that `take` accepted."""
        origin = self._e + self._services.core_timing.answer
        timed = [(origin + ceil(bits * self._bit), pin, level) for bits, pin, level in changes_of(frame)]
        self._replies.append((timed[0][0], frame))
        over = origin + ceil(STOP * self._bit)
        self._services.queue.at(over, Phase.PIN, lambda now: self.listen(now, True))
        self._next([list(group) for _, group in groupby(timed, key=lambda change: change[0])])
        self._count(origin, frame)

    def _count(self, origin: int, rest: bytes) -> None:
        """Record each byte as sent, at the time of its stop bit."""
        if rest:
            at = origin + ceil((2 + 10 * (SIZE - len(rest)) + Fraction(19, 2)) * self._bit)
            self._services.queue.at(at, Phase.PIN, lambda now: self._byte_sent(now, origin, rest))

    def _byte_sent(self, t: int, origin: int, rest: bytes) -> None:
        self._sent.append((t, rest[0]))
        self._count(origin, rest[1:])

    def _next(self, changes: list[list[tuple[int, str, int]]]) -> None:
        if changes:
            self._services.queue.at(changes[0][0][0], Phase.PIN, lambda now: self._do(now, changes))

    def _do(self, t: int, changes: list[list[tuple[int, str, int]]]) -> None:
        for _, pin, level in changes[0]:
            self._services.log.set(t, pin, level)
        self._next(changes[1:])
