"""Several equal parts on one line in one module: ports with one bit for each station."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from cocotb_tests.harness.part import Part


@dataclass(frozen=True)
class Stations:
    """Stations of a line.

    Attributes:
        count: number of stations, at most 32.
        number: input with the number of the station.
        levels: levels of the other inputs that do not change.
        hidden: outputs that do not change.
        states: registers that are 0 in an idle station.
        period: cycles after which an idle station has the same state, except for counters without an effect.
    """

    count: int
    number: str
    levels: Mapping[str, int]
    hidden: tuple[str, ...]
    states: tuple[str, ...]
    period: int

    def bits(self, one: Part, pins: Iterable[str]) -> Iterator[tuple[str, str, int]]:
        """Yield (name, port, bit) of each pin of a station: `auxo3_n` is bit 3 of the port `auxo_n`."""
        for port in pins:
            if port in self.levels or port == self.number or port in self.hidden:
                continue
            stem, low = port.removesuffix("_n"), "_n" if port.endswith("_n") else ""
            for bit in range(one.width(port)):
                yield (port if one.width(port) == 1 else f"{stem}{bit}{low}", port, bit)

    def pins(self, one: Part) -> Part:
        """Return the pins of all stations; bit 5 of a port is the pin of station 5."""

        def every(level: int, bit: int) -> int:
            return (1 << self.count) - 1 if level >> bit & 1 else 0

        inputs = {name: every(one.inputs[port], bit) for name, port, bit in self.bits(one, one.inputs)}
        outputs = {
            name: (self.count, every(one.outputs[port][1], bit))
            for name, port, bit in self.bits(one, one.watched)
        }
        widths = dict.fromkeys(inputs, self.count)
        return Part(one.name, inputs, outputs, widths, one.parameters, styles=())
