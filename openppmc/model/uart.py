"""UART with exact timing: a bit time may be a fraction of a cycle (P312-SER-01, -15, -18)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import pairwise
from math import ceil
from typing import Protocol

from .chip import Context, Phase
from .clock import Callback, Event, Scheduler

BITS = 10
"""Number of bits of a character: start bit, eight data bits, stop bit."""


class Queued(Protocol):
    """Object that provides the event queue of a part."""

    @property
    def queue(self) -> Scheduler:
        """Event queue."""
        ...


class Receiver:
    """Receiver of a UART.

    Args:
        bit: bit time in cycles.
        on_char: on_char(t, byte) is called at edge t, which samples the stop bit of a character; byte is
            `None` if the stop bit is low.
    """

    def __init__(self, context: Queued, bit: Fraction, on_char: Callable[[int, int | None], None]) -> None:
        self._queue, self._bit, self._on_char = context.queue, bit, on_char
        self._level = 1
        self._history: list[tuple[int, int]] = []
        self._start: int | None = None
        self._wait_for_high = False
        self._event: Event | None = None

    def abort(self) -> None:
        """Discard an incomplete character, and ignore the line until it is high."""
        if self._event:
            self._event.cancel()
        self._start, self._wait_for_high = None, True

    def on_level(self, t: int, level: int) -> None:
        """Process a level of the synchronised line from edge t on."""
        self._level = level
        if self._start is not None:
            self._history.append((t, level))
        elif level:
            self._wait_for_high = False
        elif not self._wait_for_high:
            self._start, self._history = t, [(t, level)]
            self._event = self._queue.at(self._middle(0), Phase.BUS, self._verify)

    def _middle(self, number: int) -> int:
        """Return the edge that samples bit `number`, 0 for the start bit."""
        assert self._start is not None
        return self._start + ceil((number + Fraction(1, 2)) * self._bit) - 1

    def _verify(self, t: int) -> None:
        """Sample the start bit in its middle; a shorter low level is a glitch."""
        if self._level:
            self._start = None
        else:
            self._event = self._queue.at(self._middle(BITS - 1), Phase.BUS, self._stop)

    def _at(self, t: int) -> int:
        """Return the level that was sampled at edge t."""
        return next(level for since, level in reversed(self._history) if since <= t)

    def _stop(self, t: int) -> None:
        """Process the middle of the stop bit.

        At this time, the levels of all earlier bits are known.
        """
        byte = sum(self._at(self._middle(number + 1)) << number for number in range(8))
        self._start, self._wait_for_high = None, not self._level
        self._on_char(t, byte if self._level else None)


class Transmitter:
    """Transmitter, which drives txd and snd.

    Attributes:
        bit: duration of a bit in cycles.
        sent: list to which (edge in the middle of the stop bit, character) of each character is appended.
        lead: number of bits from the rising edge of snd to the first start bit.
    """

    def __init__(self, context: Context, bit: Fraction, sent: list[tuple[int, int]], lead: int = 1) -> None:
        self._queue, self._log, self._bit, self._sent = context.queue, context.log, bit, sent
        self._lead = lead

    def send(self, t: int, message: bytes, ended: Callable[[int], None]) -> None:
        """Send characters without gaps.

        snd rises at edge t, and the first start bit begins `lead` bits later. ended(t) is called when snd has
        fallen.
        """
        self._log.set(t, "snd", 1)
        levels = [1] * self._lead
        for byte in message:
            levels += [0, *(byte >> place & 1 for place in range(8)), 1]
        steps: list[tuple[Fraction, Callback]] = []
        for number, (before, level) in enumerate(pairwise(levels), 1):
            if level != before:
                steps.append((Fraction(number), self._level(level)))
        for number, byte in enumerate(message, 1):
            middle = self._lead + BITS * number - Fraction(1, 2)
            steps.append((middle, self._character(byte)))
        steps.append((Fraction(len(levels)), lambda now: self._end(now, ended)))
        steps.sort(key=lambda step: step[0])
        self._next([(t + ceil(bits * self._bit), action) for bits, action in steps], 0)

    def _level(self, level: int) -> Callback:
        return lambda now: self._log.set(now, "txd", level)

    def _character(self, byte: int) -> Callback:
        return lambda now: self._sent.append((now, byte))

    def _next(self, steps: Sequence[tuple[int, Callback]], number: int) -> None:
        if number < len(steps):
            self._queue.at(steps[number][0], Phase.PIN, lambda now: self._do(now, steps, number))

    def _do(self, t: int, steps: Sequence[tuple[int, Callback]], number: int) -> None:
        steps[number][1](t)
        self._next(steps, number + 1)

    def _end(self, t: int, ended: Callable[[int], None]) -> None:
        self._log.set(t, "snd", 0)
        ended(t)
