"""The sending half of a script's UART: characters with a wrong bit time, noise, gaps, breaks on `rxd`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import ceil
from typing import Any


class SerialLine:
    """For hosts of scripts (`Script`), beside them.

    bit: bit time of the line in clk. error: of the host's own, 0.02 = 2 % too long. middle: the middle of the
    last stop bit as a receiver with the right bit time has it, from the pin's change on.
    """

    model: Any
    t: int
    bit: Fraction
    error: Fraction
    middle: Fraction
    _free: Fraction

    def open_line(self, bit: Fraction, error: float | Fraction = 0) -> None:
        """The line is idle."""
        self.bit, self.error = bit, Fraction(error)
        self.middle = self._free = Fraction(0)

    def character(
        self, byte: int, stop: int = 1, spikes: Sequence[tuple[float, int]] = (), bits: float = 10
    ) -> None:
        """One character; stop: level of its stop bit. spikes: (place in bits, clk) where the line has the
        wrong level. bits: how many of it are sent before the line rests."""
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
        for at, level in sorted(changes):
            self._drive(ceil(at), level)
        if not stop or bits < 10:
            self._drive(ceil(end), 1)
            end += bit
        self.t, self._free = ceil(end), end

    def _drive(self, t: int, level: int) -> None:
        if self.model.inputs["rxd"] != level:
            self.model.pins(max(t, self.model.now + 1), rxd=level)

    def send(self, line: Iterable[int], gap: float = 0) -> None:
        """Characters as they are; gap: idle time between two of them in bits."""
        for byte in line:
            self.character(byte)
            if gap:
                self._free += Fraction(gap) * self.bit
        self.t = ceil(self._free)

    def raw(self, text: str) -> None:
        """The same from hexadecimal text."""
        self.send(bytes.fromhex(text))

    def back_to(self, t: int) -> None:
        """The next character begins on edge t, which may lie before the end of the last stop bit's rest."""
        self.t, self._free = t, Fraction(0)

    def low(self, bits: float) -> None:
        """Break: the line is low for so long, then high for a bit time."""
        self._drive(self.t, 0)
        self.t += ceil(Fraction(bits) * self.bit)
        self._drive(self.t, 1)
        self.t += ceil(self.bit)


def characters(
    edges: Sequence[tuple[int, int]], start: Fraction, bit: Fraction, count: int, within: int = 0
) -> bytes:
    """The bytes that a transmitter sends without a gap, the first start bit from `start` on.

    edges: changes (t, level) of the line since then, which is high before. AssertionError where one is not
    within so many clk behind the place where it belongs (or before it, too, if `within` is not 0), or where a
    start or stop bit is missing.
    """
    for t, _ in edges:
        number = round((t - start) / bit)
        late = t - ceil(start + number * bit)
        assert -within <= late <= within, f"edge {t} is {late} clk away from its place"

    def level(number: int) -> int:
        middle = start + (number + Fraction(1, 2)) * bit
        return next((value for t, value in reversed(edges) if t <= middle), 1)

    line = bytearray()
    for first in range(0, 10 * count, 10):
        assert not level(first) and level(first + 9), "no start or stop bit"
        line.append(sum(level(first + 1 + place) << place for place in range(8)))
    return bytes(line)
