"""Serial line on two pins: `UartBfm` drives pins of a simulator, `SerialLine` a `DutBench`."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import ceil, floor
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, Timer

from .dut_bench import DutBench

BITS = 8


class UartBfm:
    """An 8N1 line: `rxd` is the receive pin of the board, `txd` its transmit pin.

    `rate` in baud may be changed between characters.
    """

    def __init__(self, rxd: Any, txd: Any, rate: float) -> None:
        self.rate = rate
        self._out, self._in = rxd, txd
        self._out.value = 1

    def listen(self) -> None:
        """Begin to receive; call it after the reset, when txd is idle."""
        cocotb.start_soon(self._receive())

    def _time(self, bits: float) -> Timer:
        return Timer(round(bits * 1e12 / self.rate), "ps")

    async def send(self, data: bytes) -> None:
        """Send bytes back to back."""
        for byte in data:
            # A character is sent as one word with start and stop bit, least significant bit first.
            word = 1 << BITS + 1 | byte << 1
            for bit in range(BITS + 2):
                self._out.value = word >> bit & 1
                await self._time(1)

    async def _receive(self) -> None:
        while True:
            await FallingEdge(self._in)
            await self._time(0.5)
            if self._in.value != 0:
                continue
            byte = 0
            for bit in range(BITS):
                await self._time(1)
                byte |= int(self._in.value) << bit
            await self._time(1)
            assert int(self._in.value) == 1, f"the line is low in the stop bit of {byte:#04x}"
            self.on_char(byte)

    def on_char(self, byte: int) -> None:
        """Process a received character; `listen` calls it in the middle of the stop bit."""
        raise NotImplementedError


Changes = list[tuple[int, int]]
"""Pairs (first edge that samples the level, level), in order of time."""


class LineTimes:
    """Calculation of the times at which the line changes its level.

    Attributes:
        t: first edge at which the next character may begin.
        bit: bit time of the line in cycles.
        error: relative error of the host's bit time, 0.02 = 2 % too long.
        middle: edge at the middle of the last stop bit, for a receiver that measures its bit times, without
            an error, from the change of the pin.
    """

    t: int
    bit: Fraction
    error: Fraction
    middle: Fraction
    _free: Fraction

    def open_line(self, bit: Fraction, error: float | Fraction = 0) -> None:
        """Set the bit time of the line and the relative error of the host; the line is idle."""
        self.bit, self.error = bit, Fraction(error)
        self.middle = self._free = Fraction(0)

    def back_to(self, t: int) -> None:
        """Let the next character begin on edge t, which may lie before the end of the last stop bit."""
        self.t, self._free = t, Fraction(0)

    def _character(self, byte: int, stop: int, spikes: Sequence[tuple[float, int]], bits: float) -> Changes:
        """Return the changes of one character; afterwards, `t` is the first edge after the character."""
        bit = self.bit * (1 + self.error)
        start = max(self._free, Fraction(self.t))
        levels = [0, *(byte >> place & 1 for place in range(8)), stop]
        changes = [(start + number * bit, level) for number, level in enumerate(levels) if number < bits]
        end = start + Fraction(bits) * bit
        self.middle = start + Fraction(19, 2) * self.bit
        for place, clk in spikes:
            begin = start + Fraction(place) * bit
            level = levels[int(place)]
            changes += [(begin, 1 - level), (begin + clk, level)]
        changes.sort()
        if not stop or bits < 10:
            changes.append((end, 1))
            end += bit
        self.t, self._free = ceil(end), end
        return [(ceil(at), level) for at, level in changes]

    def _idle(self, gap: float) -> None:
        """Keep the line idle for `gap` bit times."""
        self._free += Fraction(gap) * self.bit

    def _low(self, bits: float) -> Changes:
        """Return the changes of a break, which is followed by one bit time of idle line."""
        begin, self.t = self.t, self.t + ceil(Fraction(bits) * self.bit)
        changes = [(begin, 0), (self.t, 1)]
        self.t += ceil(self.bit)
        return changes


class SerialLine(LineTimes):
    """Sender for hosts on a `DutBench`.

    A character begins at `t`, where the previous one ended. A method returns at the last change of the pin,
    so that the test can act during the stop bit.
    """

    bench: DutBench

    async def character(
        self, byte: int, stop: int = 1, spikes: Sequence[tuple[float, int]] = (), bits: float = 10
    ) -> None:
        """Send one character.

        Args:
            stop: level of the stop bit.
            spikes: (position in bits, duration in cycles) of wrong levels on the line.
            bits: number of bits that are sent before the line becomes idle.
        """
        await self._drive(self._character(byte, stop, spikes, bits))

    async def _drive(self, changes: Changes) -> None:
        for edge, level in changes:
            if self.bench.pin("rxd") != level:
                await self.bench.until(max(edge, self.bench.now))
                self.bench.set(rxd=level)

    async def send(self, line: Iterable[int], gap: float = 0) -> None:
        """Send characters without errors.

        Args:
            gap: idle time after each character, in bit times.
        """
        for byte in line:
            await self.character(byte)
            self._idle(gap)
        self.t = ceil(self._free)

    async def raw(self, text: str) -> None:
        """Send the characters of a hexadecimal text."""
        await self.send(bytes.fromhex(text))

    async def low(self, bits: float) -> None:
        """Send a break: the line is low for `bits` bit times, then high for one bit time."""
        await self._drive(self._low(bits))


def characters(
    edges: Sequence[tuple[int, int]], start: Fraction, bit: Fraction, count: int, within: int = 0
) -> bytes:
    """Return the bytes that a transmitter sends without a gap; the first start bit begins at `start`.

    Raises AssertionError if a change is more than `within` cycles from its expected edge, or if a start or
    stop bit is missing.

    Args:
        edges: changes (t, level) of the line from `start` on; the line is high before them.
    """
    for t, _ in edges:
        number = round((t - start) / bit)
        late = t - ceil(start + number * bit)
        assert -within <= late <= within, f"edge {t} is {late} cycles from its expected time"

    def level(number: int) -> int:
        middle = floor(start + (number + Fraction(1, 2)) * bit)
        before = bisect_left(edges, (middle + 1, 0))
        return edges[before - 1][1] if before else 1

    line = bytearray()
    for first in range(0, 10 * count, 10):
        assert not level(first) and level(first + 9), "no start or stop bit"
        line.append(sum(level(first + 1 + place) << place for place in range(8)))
    return bytes(line)
