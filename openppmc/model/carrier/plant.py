"""A machine around a motor controller: axes with limit, slow-down, origin and alarm switches.

The same text describes it for the virtual board and for the model: `start=4000,cw=40000,alarm=100..200`;
words of axis 2 end in 2: `cw2=30000`.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

from ..stmc.codes import READ_MAPS

FARTHEST = 1 << 31
SWITCHES = ("limit_cw", "limit_ccw", "slow_cw", "slow_ccw", "origin", "alarm")
"""In the order of the bridge's PINS byte."""
PARTS = {"ppmc104": 1, "ppmc2104": 2, "stmc": 1, "ppmc312": 1}
"""Word `part`: its values, and how many axes they have."""
OWN_DEFAULTS: dict[str, dict[str, int]] = {
    "stmc": {"ccw": -1000, "slow_ccw": -200},
    "ppmc312": {"ccw": -4000, "slow_ccw": -3000, "origin_from": -50, "index": 400},
}
"""Where switches are by default on other parts than the PPMC-104. With a J105 STMC the reference point lies
between the deceleration limits, and a search for it ends at either of them. With a PPMC-312 the origin is a
cam well inside the limits, as its zero return wants it."""
INDEX_AT = -20
"""One of the places where an encoder has its index: on the cam, off its edge."""
ENCODER_WORDS = ("index", "block")
"""What only a machine with an encoder has."""


@dataclass(frozen=True)
class Plant:
    """Where the switches of an axis are, in pulses, CW positive; positions are -2^31 .. 2^31-1.

    cw, ccw: hard limits (active at positions >= cw and <= ccw). slow_cw, slow_ccw: slow-down limits (>= and
    <=). origin: active at positions <= origin and, with a cam, >= origin_from. alarm: active from the first
    to the last of the two positions. index: the encoder's index is active once in so many pulses, at -20;
    0: never. block: what the axle cannot pass CW, so that the encoder stands while pulses go on; None:
    nothing.
    """

    start: int = 4000
    cw: int = 40000
    ccw: int = -400
    slow_cw: int = 38000
    slow_ccw: int = 600
    origin: int = 0
    alarm: tuple[int, int] | None = None
    origin_from: int = -FARTHEST
    index: int = 0
    block: int | None = None

    def steps(self, position: int, ccw: int) -> bool:
        """Whether the axle follows a pulse."""
        return bool(ccw) or self.block is None or position < self.block

    def index_level(self, position: int) -> int:
        """Level of the encoder's index, 0 = active."""
        return int(not self.index or (position - INDEX_AT) % self.index != 0)

    def levels(self, position: int) -> dict[str, int]:
        """Levels of the switches at a position, 0 = active."""
        alarm = self.alarm is not None and self.alarm[0] <= position <= self.alarm[1]
        return {
            "limit_cw": int(position < self.cw),
            "limit_ccw": int(position > self.ccw),
            "slow_cw": int(position < self.slow_cw),
            "slow_ccw": int(position > self.slow_ccw),
            "origin": int(not self.origin_from <= position <= self.origin),
            "alarm": int(not alarm),
        }


PLANT_WORDS = tuple(field.name for field in fields(Plant) if field.name != "origin_from")


@dataclass(frozen=True)
class Machine:
    """A board's surroundings: part (a key of PARTS), one plant an axis, the words that are about neither."""

    part: str
    plants: tuple[Plant, ...]
    others: dict[str, str]


def parse_machine(text: str) -> Machine:
    """From `word=value,word=value`; empty text: the defaults. Raises ValueError with the offending word."""
    words: list[dict[str, object]] = [{}, {}]
    others, part, second, encoder = {}, "ppmc104", "", ""
    for item in filter(None, (piece.strip() for piece in text.split(","))):
        word, equals, value = (piece.strip() for piece in item.partition("="))
        if not equals or not value:
            raise ValueError(f"{item!r} is not of the form word=value")
        axis = int(word.endswith("2") and word[:-1] in PLANT_WORDS)
        name = word[:-1] if axis else word
        if word == "part":
            part = value.lower()
            if part not in PARTS:
                raise ValueError(f"part={value}: there are {', '.join(PARTS)}")
        elif name in PLANT_WORDS:
            words[axis] |= _where(name, word, value)
            second = item if axis else second
            encoder = item if name in ENCODER_WORDS else encoder
        else:
            others[word] = value
    if second and PARTS[part] == 1:
        article = "an" if part == "stmc" else "a"
        raise ValueError(f"{second}: {article} {part} has one axis: add part=ppmc2104")
    if encoder and part != "ppmc312":
        raise ValueError(f"{encoder}: only a ppmc312 has an encoder: add part=ppmc312")
    plant = Plant(**OWN_DEFAULTS.get(part, {}))
    return Machine(part, tuple(replace(plant, **own) for own in words[: PARTS[part]]), others)


def stmc_read_map(part: str, value: str | None) -> str:
    """Word `read_map`: SHEET or FAMILY, only for an stmc; SHEET if it is not given. ValueError."""
    if value is None:
        return "SHEET"
    if part != "stmc":
        raise ValueError(f"read_map={value}: only an stmc has it")
    if value.upper() not in READ_MAPS:
        raise ValueError(f"read_map={value}: neither {' nor '.join(READ_MAPS)}")
    return value.upper()


def _where(name: str, word: str, value: str) -> dict[str, object]:
    """Fields of a plant for a word."""
    if name == "alarm":
        return {name: _span(word, value)}
    if name == "origin":
        first, last = _span(word, value) if ".." in value else (-FARTHEST, _position(word, value))
        return {"origin_from": first, "origin": last}
    number = _position(word, value)
    if name == "index" and number < 0:
        raise ValueError(f"{word}={value}: the pulses of a turn, 0 for an encoder without index")
    return {name: number}


def _position(word: str, value: str) -> int:
    try:
        position = int(value)
    except ValueError:
        raise ValueError(f"{word}={value}: {value!r} is not a whole number of pulses") from None
    if not -FARTHEST <= position < FARTHEST:
        raise ValueError(f"{word}={value} is outside {-FARTHEST} to {FARTHEST - 1} pulses")
    return position


def _span(word: str, value: str) -> tuple[int, int]:
    first, dots, last = value.partition("..")
    if not dots:
        raise ValueError(f"{word}={value} is not of the form {word}=100..200")
    span = _position(word, first), _position(word, last)
    if span[0] > span[1]:
        raise ValueError(f"{word}={value}: the first position is behind the last one")
    return span
