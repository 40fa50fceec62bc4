"""Up to sixteen PPMC-312 with their motors on one line, as RTL or as models in virtual time.

The text after `sim:` or `model:` is, for example, `stations=4,start=2000,alarm3=100..200,speed=max`. A word
of the machine model with a number at its end applies to the station with this number; a word without a number
applies to all stations. The characters after a control code are delivered only to the models that the code
addresses. All other stations would ignore them, and thus they need no computing time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ...model.carrier.carrier import Plant
from ...model.ppmc312.carrier import Carrier
from ...model.ppmc312.part import Ppmc312
from ..common.char_line import CharLine, LineStation
from ..common.lines import LineCapabilities, one_of, parse_speed, positive, split_words, whole
from ..common.machine import PLANT_WORDS, parse_machine
from ..common.spec import PLACES

PART = "ppmc312-serial"
STATIONS = 16
SPEEDS = {19_200: 5, 38_400: 6, 83_333: 7}
"""Levels of the pins MOD for each line rate in bit/s."""
OPTIONS = (
    "part",
    "stations",
    "twin",
    "baud",
    "sum",
    "echo",
    "noise",
    "seed",
    "speed",
    "clk",
    "xtal",
    "timing",
)
LAST = ("unplug",)
KNOWN = ", ".join((*(f"{word}[N]" for word in PLANT_WORDS), *OPTIONS, *LAST))


@dataclass(frozen=True)
class LineSpec:
    """Requested virtual line.

    Attributes:
        plants: positions of the switches of each station, by its number.
        twin: (number, plant) of an additional station with the number of another station, or None.
        baud: line rate in bit/s with a 16 MHz crystal.
        sum_mode: BINARY or CHARS.
        echo: True if the master receives its own characters.
        noise: average number of characters, in both directions, of which one is corrupted; 0 for no noise.
        speed: multiple of real time; None for as fast as possible.
        unplug: time in s after which the port disappears.
    """

    plants: dict[int, Plant]
    twin: tuple[int, Plant] | None = None
    baud: int = 19_200
    sum_mode: str = "BINARY"
    echo: bool = False
    noise: int = 0
    seed: int = 1
    speed: float | None = 1.0
    clk_hz: int = 8_000_000
    xtal_hz: int = 16_000_000
    timing: str = "FAST"
    unplug: float = float("inf")

    @property
    def rate(self) -> float:
        """Line rate in bit/s with the crystal frequency `xtal_hz`."""
        return self.baud * self.xtal_hz / 16_000_000


def at_rate(text: str, rate: int) -> str:
    """Return the text of a port; unless it names a line speed, append the speed of the host.

    Raises ValueError if no speed matches the rate.

    Args:
        rate: line rate of the host in bit/s.

    >>> at_rate("stations=2,xtal=8000000", 9600)
    'stations=2,xtal=8000000,baud=19200'
    """
    if "baud=" in text:
        return text
    requested = rate * 16_000_000 / parse_line(text).xtal_hz
    nearest = min(SPEEDS, key=lambda speed: abs(speed - requested))
    return ",".join(filter(None, [text, f"baud={nearest}"]))


def parse_line(text: str) -> LineSpec:
    """Parse `word=value,word=value`. Raise ValueError, which names the word that is wrong."""
    words = split_words(text, PLANT_WORDS, (*OPTIONS, *LAST), _station)
    options = words.options
    numbers = _numbers(options.get("stations", str(STATIONS)))
    for number, own in words.own.items():
        if number not in numbers:
            word = "=".join(next(iter(own.items())))
            raise ValueError(f"{word}: there is no station {number} (stations={options.get('stations')})")
    if options.get("part", PART) != PART:
        raise ValueError(f"part={options['part']}: a line has part={PART}")
    plants = {number: _plant(words.shared | words.own.get(number, {})) for number in numbers}
    twin = _twin(options, numbers, words.shared)
    return LineSpec(
        plants,
        twin,
        int(one_of("baud", options.get("baud", "19200"), [str(speed) for speed in SPEEDS])),
        one_of("sum", options.get("sum", "binary").upper(), ("BINARY", "CHARS")),
        one_of("echo", options.get("echo", "off"), ("on", "off")) == "on",
        whole("noise", options.get("noise", "0"), 0, 10**9),
        whole("seed", options.get("seed", "1"), 0, 1 << 32),
        parse_speed(options.get("speed", "1")),
        whole("clk", options.get("clk", "8000000"), 8_000_000, 200_000_000),
        whole("xtal", options.get("xtal", "16000000"), 1_000_000, 16_000_000),
        one_of("timing", options.get("timing", "FAST").upper(), ("FAST", "DATASHEET")),
        positive("unplug", options.get("unplug", "inf")),
    )


def _plant(words: dict[str, str]) -> Plant:
    text = ",".join(f"{word}={value}" for word, value in words.items())
    plant = parse_machine(f"part=ppmc312,{text}").plants[0]
    if plant.ccw >= plant.cw:
        raise ValueError(f"cw={plant.cw},ccw={plant.ccw}: the CW limit must lie above the CCW limit")
    return plant


def _twin(
    options: dict[str, str], numbers: Sequence[int], shared: dict[str, str]
) -> tuple[int, Plant] | None:
    if "twin" not in options:
        return None
    number = _station(f"twin={options['twin']}", options["twin"])
    if number not in numbers:
        raise ValueError(f"twin={number}: there is no station {number} to share the number with")
    return number, _plant(shared)


def _numbers(text: str) -> range:
    """Parse station numbers: `4` means 0 to 3, `3..5` means 3 to 5.

    Raise ValueError for any other text.
    """
    first, dots, last = text.partition("..")
    try:
        numbers = range(int(first), int(last) + 1) if dots else range(int(first))
    except ValueError:
        numbers = range(0)
    if not numbers or numbers[0] < 0 or numbers[-1] >= STATIONS:
        raise ValueError(f"stations={text}: a number from 1 to {STATIONS}, or FIRST..LAST within 0..15")
    return numbers


def _station(item: str, text: str) -> int:
    if not text.isdigit() or int(text) >= STATIONS:
        raise ValueError(f"{item}: stations have numbers from 0 to {STATIONS - 1}")
    return int(text)


class Station(Carrier, LineStation[Ppmc312]):
    """Station with its motor and encoder. The method `straps` sets RUN and the event inputs."""

    def __init__(self, plant: Plant, number: int, spec: LineSpec) -> None:
        straps = {"mode": 0, "mod": SPEEDS[spec.baud], "adr": number}
        part = Ppmc312(spec.clk_hz, spec.xtal_hz, spec.timing, sum_mode=spec.sum_mode, straps=straps)
        super().__init__(plant, part=part)
        self.number = number

    def watched_register(self) -> object:
        return None

    def status_text(self) -> str:
        """Return number, position of the motor and state as text."""
        return f"{self.number}:{self.position}:{self.part.state.name}"


class StationLine(CharLine[Station]):
    """Line of PPMC-312.

    Only the station that was addressed last is simulated together with the line.
    """

    def __init__(self, spec: LineSpec) -> None:
        numbered = [*spec.plants.items(), *([spec.twin] if spec.twin else [])]
        stations = [Station(plant, number, spec) for number, plant in numbered]
        super().__init__(spec, stations, spec.clk_hz * 16_000_000 / (spec.baud * spec.xtal_hz))
        self.listeners = []

    def select_listeners(self, byte: int) -> None:
        if byte & 0x80:
            self.listeners = [one for one in self.stations if one.number == byte & 15]


def parameters(spec: LineSpec) -> dict[str, int | str]:
    """Return the parameters of tb/ppmc312/line/line_node.sv."""
    times: dict[str, int | str] = {"CLK_HZ": spec.clk_hz, "XTAL_HZ": spec.xtal_hz}
    return {**times, "TIMING": spec.timing, "SUM_MODE": spec.sum_mode}


def arguments(spec: LineSpec, files: Path) -> list[str]:
    """Return the arguments of the program in tb/line with tb/ppmc312/line/node.h."""
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


MACHINE = LineCapabilities(parse_line, at_rate, KNOWN, StationLine, parameters, arguments)
