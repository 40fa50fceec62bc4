"""Text that describes the machine model of a motor controller: `start=4000,cw=40000,alarm=100..200`.

The virtual board and the golden model use the same text. It consists of words with values
(docs/virtual_board.md, Words). Words of axis 2 end in 2 (`cw2=30000`), and so on. The column `machine` of the
table of parts names a module that defines the differences of a part.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, field, fields

from ... import parts
from ...model.carrier.carrier import FARTHEST, Carrier, Plant
from ...model.chip import Chip

PLANT_WORDS = tuple(one.name for one in fields(Plant) if one.name != "origin_from")
ENCODER_WORDS = ("index", "block")
"""Words of a port's text that only a machine with an encoder supports."""
_OF_AXIS = re.compile(r"([a-z_]+?)([2-9]|[1-9][0-9])")


@dataclass(frozen=True)
class Setup:
    """Parameters of a modelled carrier.

    Attributes:
        clk_hz, xtal_hz: clock and crystal of the part in Hz.
        timing: FAST or DATASHEET.
        own: values of the options in the port text (docs/virtual_board.md, Words) that only this part has.
        on_interrupt: called when the interrupt begins.
    """

    plants: Sequence[Plant]
    clk_hz: int
    xtal_hz: int
    timing: str
    own: Mapping[str, str]
    on_interrupt: Callable[[], None]


@dataclass(frozen=True)
class MachineKind:
    """Machine model of a part that is accessed through the UART bridge.

    Attributes:
        called: name of the part for messages.
        carrier: function that creates the carrier model of the part.
        axes: number of axes; the word `axes`, if the part has it, overrides this number.
        plant: default positions of the switches.
        encoder: True if the machine has an encoder.
        own: words that only this part supports, with their possible values; the default is first.
        xtal_max: highest crystal frequency in Hz.
        alarm: name of the alarm switch.
        check: function that raises ValueError for an impossible set-up.
        timed: True if the part has the parameter TIMING.
        counters: True if the carrier counts pulses.
    """

    called: str
    carrier: Callable[[Setup], Carrier[Chip]]
    axes: int = 1
    plant: Plant = Plant()
    encoder: bool = False
    own: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    xtal_max: int = 16_000_000
    alarm: str = "ALM"
    check: Callable[[Setup], None] = lambda setup: None
    timed: bool = True
    counters: bool = True


def machine_parts() -> tuple[str, ...]:
    """Return the possible values of the word `part`."""
    return tuple(row.name for row in parts.having("number", "machine"))


def machine_kind(part: str) -> MachineKind:
    """Return the machine model of a part."""
    kind: MachineKind = parts.part(part).load("machine")
    return kind


def own_words() -> tuple[str, ...]:
    """Return the words of a port's text that only one part supports."""
    return tuple(word for part in machine_parts() for word in machine_kind(part).own)


@dataclass(frozen=True)
class Machine:
    """Parsed text of a machine model.

    Attributes:
        part: name of the part.
        plants: positions of the switches, one entry for each axis.
        own: values of words that only this part supports.
        others: all other words.
    """

    part: str
    plants: tuple[Plant, ...]
    own: dict[str, str]
    others: dict[str, str]


def parse_machine(text: str, known: Collection[str] = ()) -> Machine:
    """Parse `word=value,word=value`; an empty text selects the defaults.

    Raises ValueError, which names the word that is wrong.

    Args:
        known: further words that are accepted; the caller processes them, because no part supports them.
    """
    words: dict[int, dict[str, int | tuple[int, int]]] = {}
    others: dict[str, str] = {}
    part, last, last_item, encoder = "ppmc104", 1, "", ""
    for item in filter(None, (piece.strip() for piece in text.split(","))):
        word, equals, value = (piece.strip() for piece in item.partition("="))
        if not equals or not value:
            raise ValueError(f"{item!r} is not of the form word=value")
        numbered = _OF_AXIS.fullmatch(word)
        name, axis = word, 1
        if numbered and numbered[1] in PLANT_WORDS:
            name, axis = numbered[1], int(numbered[2])
        if word == "part":
            part = value.lower()
            if part not in machine_parts():
                raise ValueError(f"part={value}: there are {', '.join(machine_parts())}")
        elif name in PLANT_WORDS:
            words.setdefault(axis, {}).update(_plant_fields(name, word, value))
            if axis > last:
                last, last_item = axis, item
            encoder = item if name in ENCODER_WORDS else encoder
        else:
            others[word] = value
    kind = machine_kind(part)
    own = _own(kind, others, known)
    axes = int(own.get("axes", kind.axes))
    if last > axes == 1:
        other, _ = _first(lambda one: one.axes > 1)
        raise ValueError(f"{last_item}: {kind.called} has one axis; add part={other}")
    if last > axes:
        raise ValueError(f"{last_item}: {kind.called} has {axes} axes")
    if encoder and not kind.encoder:
        other, its = _first(lambda one: one.encoder)
        raise ValueError(f"{encoder}: only {its.called} has an encoder; add part={other}")
    plants = tuple(_plant(kind.plant, words.get(axis, {})) for axis in range(1, axes + 1))
    return Machine(part, plants, own, others)


def _first(condition: Callable[[MachineKind], bool]) -> tuple[str, MachineKind]:
    """Return the first part whose machine model satisfies the condition."""
    kinds = ((part, machine_kind(part)) for part in machine_parts())
    return next((part, kind) for part, kind in kinds if condition(kind))


def _own(kind: MachineKind, others: dict[str, str], known: Collection[str]) -> dict[str, str]:
    """Remove the words of this part from `others` and return them.

    Raises ValueError for a word of another part and for an unknown value.
    """
    unknown = others.keys() - kind.own.keys() - set(known)
    for its in map(machine_kind, machine_parts() if unknown else ()):
        for word in its.own:
            if word in others and word not in kind.own:
                raise ValueError(f"{word}={others[word]}: only {its.called} has it")
    own = {}
    for word, known in kind.own.items():
        value = others.pop(word, known[0])
        own[word] = value.upper()
        if own[word] not in known:
            raise ValueError(f"{word}={value}: neither {' nor '.join(known)}")
    return own


def _plant(plant: Plant, words: Mapping[str, int | tuple[int, int]]) -> Plant:
    values = asdict(plant)
    values.update(words)
    return Plant(**values)


def _plant_fields(name: str, word: str, value: str) -> dict[str, int | tuple[int, int]]:
    """Return the fields of a plant that a word of the text sets."""
    if name == "alarm":
        return {name: _span(word, value)}
    if name == "origin":
        first, last = _span(word, value) if ".." in value else (-FARTHEST, _position(word, value))
        return {"origin_from": first, "origin": last}
    number = _position(word, value)
    if name == "index" and number < 0:
        raise ValueError(
            f"{word}={value}: must not be negative; use the pulses of a turn, or 0 without index"
        )
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
        raise ValueError(f"{word}={value}: the first position must not exceed the last one")
    return span
