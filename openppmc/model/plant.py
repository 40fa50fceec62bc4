"""A machine around a motor controller: one axis with limit, slow-down, origin and alarm switches.

The same text describes it for the virtual board and for the model: `start=4000,cw=40000,alarm=100..200`.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

FARTHEST = 1 << 31


@dataclass(frozen=True)
class Plant:
    """Where the switches are, in pulses, CW positive; positions are -2^31 .. 2^31-1.

    cw, ccw: hard limits L1 (active at positions >= cw) and L2 (<= ccw). slow_cw, slow_ccw: slow-down limits
    L3 (>=) and L4 (<=). origin: CNP is active at positions <= origin. alarm: ALM is active from the first to
    the last of the two positions.
    """

    start: int = 4000
    cw: int = 40000
    ccw: int = -400
    slow_cw: int = 38000
    slow_ccw: int = 600
    origin: int = 0
    alarm: tuple[int, int] | None = None

    def levels(self, position: int) -> dict[str, int]:
        """Levels of the input pins at a position, 0 = active."""
        alarm = self.alarm is not None and self.alarm[0] <= position <= self.alarm[1]
        return {
            "l1_n": int(position < self.cw),
            "l2_n": int(position > self.ccw),
            "l3_n": int(position < self.slow_cw),
            "l4_n": int(position > self.slow_ccw),
            "cnp_n": int(position > self.origin),
            "alm_n": int(not alarm),
        }


PLANT_WORDS = tuple(field.name for field in fields(Plant))


def parse_plant(text: str) -> tuple[Plant, dict[str, str]]:
    """Plant and the words that are not about it, from `word=value,word=value`; empty text: the defaults.

    Raises ValueError with the offending word.
    """
    plant, others = Plant(), {}
    for item in filter(None, (part.strip() for part in text.split(","))):
        word, equals, value = (part.strip() for part in item.partition("="))
        if not equals or not value:
            raise ValueError(f"{item!r} is not of the form word=value")
        if word == "alarm":
            plant = replace(plant, alarm=_span(value))
        elif word in PLANT_WORDS:
            plant = replace(plant, **{word: _position(word, value)})
        else:
            others[word] = value
    return plant, others


def _position(word: str, value: str) -> int:
    try:
        position = int(value)
    except ValueError:
        raise ValueError(f"{word}={value}: {value!r} is not a whole number of pulses") from None
    if not -FARTHEST <= position < FARTHEST:
        raise ValueError(f"{word}={value} is outside {-FARTHEST} to {FARTHEST - 1} pulses")
    return position


def _span(value: str) -> tuple[int, int]:
    first, dots, last = value.partition("..")
    if not dots:
        raise ValueError(f"alarm={value} is not of the form alarm=100..200")
    span = _position("alarm", first), _position("alarm", last)
    if span[0] > span[1]:
        raise ValueError(f"alarm={value}: the first position is behind the last one")
    return span
