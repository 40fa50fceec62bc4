"""The text of a virtual line of PMC006B4: `address=1..3,start=2000,high3=9000,speed=max`.

Words of a controller with a number at their end are those of the one with that address, without one of all.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from ..common.line_words import one_of, pace, positive, split_words, whole

PART = "pmc006"
FACTORY, LAST = 255, 120
FARTHEST = 1 << 27
UNIT = 16
"""Positions in words are in 1/16 full steps, the steps of a factory-new controller."""
OWN = ("start", "low", "high", "gpi", "eeprom", "program")
OPTIONS = ("part", "address", "twin", "baud", "ack", "echo", "noise", "seed", "speed", "clk", "unplug")
KNOWN = ", ".join((*(f"{word}[N]" for word in OWN), *OPTIONS))


@dataclass(frozen=True)
class Carriage:
    """What a controller drives, in 1/16 full steps, forward positive. start: where it is. EXT1 is at level 0
    at and below `low`, EXT2 at and above `high`. gpi: levels of GPI5 to GPI1. eeprom: a file that keeps the
    EEPROM, None: it is new each time, with the address in it. no_eeprom: there is none. program: a text that
    is assembled into the EEPROM and starts by itself, None for none."""

    start: int = 4000
    low: int = 0
    high: int = 40_000
    gpi: int = 0x1F
    eeprom: Path | None = None
    no_eeprom: bool = False
    program: Path | None = None

    def levels(self, position: float) -> dict[str, int]:
        """Levels of the switches at a position."""
        return {"ext1": int(position > self.low), "ext2": int(position < self.high)}


@dataclass(frozen=True)
class LineSpec:
    """A virtual line as it was asked for.

    carriages: of each controller, by its address. twin: an address that a second controller has too, or None.
    baud: line rate. step_ack: MANUAL or ECHO. echo: the master hears itself. noise: one character in so many
    is damaged, either way; 0: none. speed: times real time, None: as fast as it goes. unplug: seconds after
    which the port goes away.
    """

    carriages: dict[int, Carriage] = field(default_factory=lambda: {FACTORY: Carriage()})
    twin: int | None = None
    baud: int = 9600
    step_ack: str = "MANUAL"
    echo: bool = False
    noise: int = 0
    seed: int = 1
    speed: float | None = 1.0
    clk_hz: int = 8_000_000
    unplug: float = float("inf")

    @property
    def rate(self) -> float:
        """Line rate in bit/s."""
        return self.baud


def at_rate(text: str, rate: int) -> str:
    """The text with the rate of a host, unless it names one.

    >>> at_rate("address=5", 19200)
    'address=5,baud=19200'
    """
    return text if "baud=" in text else ",".join(filter(None, [text, f"baud={rate}"]))


def parse_line(text: str) -> LineSpec:
    """From `word=value,word=value`. Raises ValueError with the offending word."""
    words = split_words(text, OWN, OPTIONS, _address)
    options = words.options
    if options.get("part", PART) != PART:
        raise ValueError(f"part={options['part']}: this line has part={PART}")
    addresses = _addresses(options.get("address", str(FACTORY)))
    for address, own in words.own.items():
        if address not in addresses:
            there = ", ".join(map(str, addresses))
            raise ValueError(
                f"{next(iter(own))}{address}: no such controller, there is {there}: see address="
            )
    carriages = {address: _carriage(words.shared | words.own.get(address, {})) for address in addresses}
    files = [one.eeprom for one in carriages.values() if one.eeprom is not None]
    if len(set(files)) < len(files):
        raise ValueError(f"eeprom={files[0]}: each controller needs a file of its own, as eeprom1=…")
    twin = _address("twin", options["twin"]) if "twin" in options else None
    if twin is not None and twin not in addresses:
        raise ValueError(f"twin={twin}: there is no controller {twin} to share the address with")
    return LineSpec(
        carriages,
        twin,
        whole("baud", options.get("baud", "9600"), 1200, 115_200),
        one_of("ack", options.get("ack", "manual").upper(), ("MANUAL", "ECHO")),
        one_of("echo", options.get("echo", "off"), ("on", "off")) == "on",
        whole("noise", options.get("noise", "0"), 0, 10**9),
        whole("seed", options.get("seed", "1"), 0, 1 << 32),
        pace(options.get("speed", "1")),
        whole("clk", options.get("clk", "8000000"), 8_000_000, 200_000_000),
        positive("unplug", options.get("unplug", "inf")),
    )


def _carriage(words: dict[str, str]) -> Carriage:
    values = {word: _position(word, words[word]) for word in ("start", "low", "high") if word in words}
    eeprom = words.get("eeprom", "new")
    carriage = Carriage(
        **values,
        gpi=_levels(words.get("gpi", "11111")),
        eeprom=None if eeprom in ("new", "none") else _file("eeprom", eeprom, False),
        no_eeprom=eeprom == "none",
        program=_file("program", words["program"], True) if "program" in words else None,
    )
    if carriage.low >= carriage.high:
        raise ValueError(f"low={carriage.low},high={carriage.high}: EXT2 (high) must lie above EXT1 (low)")
    if carriage.program is not None and (carriage.no_eeprom or carriage.eeprom is not None):
        raise ValueError(f"program={carriage.program}: goes into a new EEPROM: leave the word eeprom out")
    return carriage


def _addresses(text: str) -> tuple[int, ...]:
    """`5`, `1..3` or `10+20`."""
    first, dots, last = text.partition("..")
    if dots:
        low, high = _address(text, first), _address(text, last)
        numbers = tuple(range(low, high + 1)) if high <= LAST else ()
    else:
        numbers = tuple(_address(text, piece) for piece in text.split("+"))
    if not numbers or len(set(numbers)) < len(numbers):
        raise ValueError(f"address={text}: write 5, 1..3 or 10+20, with addresses 1 to {LAST} or {FACTORY}")
    return numbers


def _address(item: str, text: str) -> int:
    if not text.isdigit() or not (1 <= int(text) <= LAST or int(text) == FACTORY):
        raise ValueError(f"{item}: controllers have addresses 1 to {LAST}, or {FACTORY}")
    return int(text)


def _position(word: str, text: str) -> int:
    try:
        position = int(text)
    except ValueError:
        raise ValueError(f"{word}={text}: not a whole number of 1/{UNIT} full steps") from None
    if abs(position) > FARTHEST:
        raise ValueError(f"{word}={text}: expected -{FARTHEST} to {FARTHEST}")
    return position


def _levels(text: str) -> int:
    """Levels of GPI5 to GPI1."""
    if len(text) != 5 or set(text) - {"0", "1"}:
        raise ValueError(f"gpi={text}: five levels of GPI5 to GPI1, as 11111")
    return int(text, 2)


def _file(word: str, text: str, there: bool) -> Path:
    path = Path(text)
    if path.is_dir() or not path.absolute().parent.is_dir() or (there and not path.is_file()):
        raise ValueError(f"{word}={text}: no such file")
    return path
