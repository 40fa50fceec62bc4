"""Sixteen PPMC-312 with their motors on one line: the RTL, or modelled in virtual time.

Of modelled ones only those that a control code names get the characters after it, as all others ignore them
anyway; so idle stations cost nothing.
"""

from __future__ import annotations

from pathlib import Path

from ...model.carrier.carrier import Plant
from ...model.ppmc312.carrier import Carrier
from ...model.ppmc312.part import Ppmc312
from ..common.char_line import CharLine, LineStation
from ..common.lines import LineKind
from ..common.spec import PLACES
from .line_spec import KNOWN, SPEEDS, LineSpec, at_rate, parse_line


class Station(Carrier, LineStation[Ppmc312]):
    """A station with motor and encoder; `straps` sets RUN and the event inputs."""

    def __init__(self, plant: Plant, number: int, spec: LineSpec) -> None:
        straps = {"mode": 0, "mod": SPEEDS[spec.baud], "adr": number}
        part = Ppmc312(spec.clk_hz, spec.xtal_hz, spec.timing, sum_mode=spec.sum_mode, straps=straps)
        super().__init__(plant, part=part)
        self.number = number

    def shown(self) -> object:
        return None

    def words(self) -> str:
        """Number, position of the motor, state."""
        return f"{self.number}:{self.position}:{self.part.state.name}"


class StationLine(CharLine[Station]):
    """The line. Only the station that was addressed last runs with it."""

    def __init__(self, spec: LineSpec) -> None:
        numbered = [*spec.plants.items(), *([spec.twin] if spec.twin else [])]
        stations = [Station(plant, number, spec) for number, plant in numbered]
        super().__init__(spec, stations, spec.clk_hz * 16_000_000 / (spec.baud * spec.xtal_hz))
        self.hearing = []

    def heard(self, byte: int) -> None:
        if byte & 0x80:
            self.hearing = [one for one in self.stations if one.number == byte & 15]


def parameters(spec: LineSpec) -> dict[str, int | str]:
    """Of tb/ppmc312/line/line_node.sv."""
    times: dict[str, int | str] = {"CLK_HZ": spec.clk_hz, "XTAL_HZ": spec.xtal_hz}
    return {**times, "TIMING": spec.timing, "SUM_MODE": spec.sum_mode}


def arguments(spec: LineSpec, files: Path) -> list[str]:
    """Of the program in tb/line with tb/ppmc312/line/node.h."""
    del files
    numbered = [*spec.plants.items(), *([spec.twin] if spec.twin else [])]
    words = [f"stations={len(numbered)}", f"mod={SPEEDS[spec.baud]}", f"xtal={spec.xtal_hz}"]
    for place, (number, plant) in enumerate(numbered):
        known: dict[str, int | None] = {"number": number, "index": plant.index, "block": plant.block}
        known |= {name: getattr(plant, name) for name in PLACES}
        if plant.alarm is not None:
            known |= {"alarm_from": plant.alarm[0], "alarm_to": plant.alarm[1]}
        words += [f"{name}{place}={value}" for name, value in known.items() if value is not None]
    return words


MACHINE = LineKind(parse_line, at_rate, KNOWN, StationLine, parameters, arguments)
