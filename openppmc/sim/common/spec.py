"""Text after `sim:`: words of the plant (machine model), and words of the virtual board itself.

The words (docs/virtual_board.md, Words) are checked before a build.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

from ...model.carrier.carrier import Plant
from .machine import PLANT_WORDS, Setup, machine_kind, own_words, parse_machine

OPTIONS = ("part", "speed", "clk", "xtal", "timing", "record")
FILES = ("vcd", "vcd_from", "vcd_for", "log")
PLACES = ("start", "cw", "ccw", "slow_cw", "slow_ccw", "origin", "origin_from")


def suffixes() -> Iterator[str]:
    """Yield the suffix that the words of each axis have; it is empty for axis 1."""
    return ("" if number == 1 else str(number) for number in count(1))


def known_words() -> str:
    """Return all words that a port's text may contain, as text for messages."""
    return ", ".join((*PLANT_WORDS, *OPTIONS, *own_words(), *FILES))


class SpecError(ValueError):
    """The text of a virtual board is invalid; the message is one line that lists the known words."""


@dataclass(frozen=True)
class Spec:
    """Requested virtual board.

    Attributes:
        part: name of a part that is accessed through the UART bridge.
        plants: positions of the switches, one entry for each axis.
        speed: multiple of real time; None for as fast as possible.
        clk_hz: clock of the board, 8e6 … 200e6 Hz (real time is not possible far above 8e6).
        xtal_hz: crystal of the emulated chip, 1e6 Hz or more.
        timing: FAST or DATASHEET.
        record: the recorder stores 2**record records of the pins; 0 for no recorder.
        own: values of words that only this part supports. Each word sets a parameter of the top module.
        vcd: waveform file or None; vcd_from and vcd_for are in ms of board time.
        log: file that receives a line for each pulse, or None.
    """

    part: str = "ppmc104"
    plants: tuple[Plant, ...] = (Plant(),)
    speed: float | None = 1.0
    clk_hz: int = 8_000_000
    xtal_hz: int = 16_000_000
    timing: str = "FAST"
    record: int = 0
    own: Mapping[str, str] = field(default_factory=dict)
    vcd: Path | None = None
    vcd_from: float = 0.0
    vcd_for: float = 20.0
    log: Path | None = None

    @property
    def parameters(self) -> dict[str, int | str]:
        """Parameters of the top module of the board."""
        own = {word.upper(): int(value) if value.isdigit() else value for word, value in self.own.items()}
        timing = {"TIMING": self.timing} if machine_kind(self.part).timed else {}
        record = {"RECORD": self.record} if self.record else {}
        return {"CLK_HZ": self.clk_hz, "XTAL_HZ": self.xtal_hz, **timing, **record, **own}

    def arguments(self) -> list[str]:
        """Return the arguments of the program in tb/board."""
        words = []
        for plant, suffix in zip(self.plants, suffixes(), strict=False):
            words += [f"{word}{suffix}={getattr(plant, word)}" for word in PLACES]
            if machine_kind(self.part).encoder:
                words.append(f"index={plant.index}")
            if plant.block is not None:
                words.append(f"block={plant.block}")
            if plant.alarm is not None:
                words.append(f"alarm{suffix}={plant.alarm[0]}..{plant.alarm[1]}")
        words.append(f"speed={'max' if self.speed is None else self.speed}")
        if self.vcd is not None:
            words += [f"vcd={self.vcd}", f"vcd_from={self.vcd_from}", f"vcd_for={self.vcd_for}"]
        if self.log is not None:
            words.append(f"log={self.log}")
        return words


def parse_spec(text: str = "", **options: object) -> Spec:
    """Parse `word=value,word=value`; options have priority over the text.

    Raise SpecError if a value is invalid.
    """
    words = [text, *(f"{name}={value}" for name, value in options.items() if value is not None)]
    try:
        machine = parse_machine(",".join(words), (*OPTIONS, *FILES))
    except ValueError as error:
        raise SpecError(f"{error} (there are {known_words()})") from None
    rest = machine.others
    for word in rest:
        if word not in (*OPTIONS, *FILES):
            raise SpecError(f"unknown word {word!r} (there are {known_words()})")
    for plant, suffix in zip(machine.plants, suffixes(), strict=False):
        if plant.ccw >= plant.cw:
            limits = f"cw{suffix}={plant.cw},ccw{suffix}={plant.ccw}"
            raise SpecError(f"{limits}: the CW limit must lie above the CCW limit")
    timing = rest.get("timing", "FAST").upper()
    if timing not in ("FAST", "DATASHEET"):
        raise SpecError(f"timing={rest['timing']}: neither FAST nor DATASHEET")
    if "vcd" not in rest and ("vcd_from" in rest or "vcd_for" in rest):
        raise SpecError("vcd_from and vcd_for need a waveform file; add vcd=FILE")
    speed = rest.get("speed", "1")
    kind = machine_kind(machine.part)
    clk_hz = _whole("clk", rest.get("clk", "8000000"), 8_000_000, 200_000_000)
    xtal_hz = _whole("xtal", rest.get("xtal", "16000000"), 1_000_000, kind.xtal_max)
    try:
        kind.check(Setup(machine.plants, clk_hz, xtal_hz, timing, machine.own, lambda: None))
    except ValueError as error:
        raise SpecError(str(error)) from None
    return Spec(
        machine.part,
        machine.plants,
        None if speed == "max" else _number("speed", speed, 0.001, 1000, "or max"),
        clk_hz,
        xtal_hz,
        timing,
        _record(rest.get("record", "0")),
        machine.own,
        _file("vcd", rest),
        _number("vcd_from", rest.get("vcd_from", "0"), 0, 1e9, "ms"),
        _number("vcd_for", rest.get("vcd_for", "20"), 0.001, 1e6, "ms"),
        _file("log", rest),
    )


def _number(word: str, text: str, low: float, high: float, unit: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not low <= value <= high:
        raise SpecError(f"{word}={text}: expected {low:g} to {high:g} {unit}")
    return value


def _record(text: str) -> int:
    if text not in ("0", *map(str, range(4, 17))):
        raise SpecError(f"record={text}: not supported; use 0 (no recorder) or 4 to 16 (2**record records)")
    return int(text)


def _whole(word: str, text: str, low: int, high: int) -> int:
    value = _number(word, text, low, high, "Hz")
    if value != int(value):
        raise SpecError(f"{word}={text}: expected a whole number of Hz")
    return int(value)


def _file(word: str, rest: dict[str, str]) -> Path | None:
    if word not in rest:
        return None
    path = Path(rest[word]).absolute()
    if path.is_dir() or not path.parent.is_dir():
        raise SpecError(f"{word}={rest[word]}: not a file that can be written")
    return path
