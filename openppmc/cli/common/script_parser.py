"""Parser for lines of script files: common commands, and commands of parts (column `script_commands`)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple, Protocol

from ... import parts
from ...host.capabilities import AUX, Capabilities
from .options import MOST_AXES, Direction, Logic, SetupValues


@dataclass(frozen=True)
class PartCommand:
    """A command of script files that only some parts support.

    Attributes:
        unsupported_reason: function that returns why a part does not support the command with these operands,
            as text; empty if the part supports it.
        execute: function that executes the command. It is called only if `unsupported_reason` returns an
            empty text.
    """

    parse: Reader
    unsupported_reason: Callable[[Capabilities, Values], str]
    execute: Callable[[Any, Values], None]


class _HasAux(Protocol):
    def aux(self, on: bool) -> None:
        """Switch the output AUX."""


class _HasOutputs(Protocol):
    def auxo(self, value: int) -> None:
        """Set the auxiliary outputs."""


def _read_aux(words: list[str]) -> Values:
    text = first(words, "on or off")
    if text not in ("on", "off"):
        raise ValueError(f"{text!r} is neither on nor off")
    check_no_more_words(words)
    return {"on": text == "on"}


def _read_outputs(words: list[str]) -> Values:
    value = whole(first(words, "value"), "outputs", 0, 63)
    check_no_more_words(words)
    return {"value": value}


def _unsupported_aux(kind: Capabilities, values: Values) -> str:
    if AUX in kind.has:
        return ""
    return f"a {kind} has no output AUX" + ("; use auxo" if kind.outputs else "")


def _unsupported_outputs(kind: Capabilities, values: Values) -> str:
    if not kind.outputs:
        return f"a {kind} has no auxiliary outputs"
    if values["value"] > kind.outputs:
        return f"outputs {values['value']} is outside 0 to {kind.outputs}"
    return ""


def _execute_aux(part: _HasAux, values: Values) -> None:
    part.aux(values["on"])


def _execute_outputs(part: _HasOutputs, values: Values) -> None:
    part.auxo(values["value"])


_SOME = {
    "aux": PartCommand(_read_aux, _unsupported_aux, _execute_aux),
    "auxo": PartCommand(_read_outputs, _unsupported_outputs, _execute_outputs),
}


@cache
def part_commands() -> dict[str, PartCommand]:
    """Return the commands that only some parts support, also the commands of column `script_commands`."""
    own = dict(_SOME)
    for row in parts.folders():
        if row.script_commands:
            more: dict[str, PartCommand] = row.load("script_commands")
            assert not own.keys() & more.keys(), f"{row.name}: a word that another part also defines"
            own |= more
    return own


MOST_TURNS = 1_000_000
Values = dict[str, Any]
"""Operands of a script line, by the names that `ScriptRunner` uses."""
Reader = Callable[[list[str]], Values]
"""Function that parses and removes the words after the first one. Raises ValueError for an invalid word."""


def check_no_more_words(words: list[str]) -> None:
    """Raise ValueError if the line has more words."""
    if words:
        raise ValueError(f"{words[0]!r} does not belong here")


def number(text: str, what: str, low: float, high: float) -> float:
    """Return the text as a number from low to high. Raise ValueError for any other text."""
    try:
        value = float(text)
    except ValueError:
        raise ValueError(f"{what} {text!r} is not a number") from None
    if not low <= value <= high:
        raise ValueError(f"{what} {text} is outside {low:g} to {high:g}")
    return value


def whole(text: str, what: str, low: int, high: int) -> int:
    """Return the text as a whole number from low to high. Raise ValueError for any other text."""
    try:
        value = int(text)
    except ValueError:
        raise ValueError(f"{what} {text!r} is not a whole number") from None
    if not low <= value <= high:
        raise ValueError(f"{what} {text} is outside {low} to {high}")
    return value


def first(words: list[str], what: str) -> str:
    """Remove and return the next word. Raise ValueError if it is missing."""
    if not words:
        raise ValueError(f"{what} is missing")
    return words.pop(0)


def _direction(words: list[str]) -> int:
    text = first(words, "direction (cw or ccw)")
    if text.lower() not in ("cw", "ccw"):
        raise ValueError(f"{text!r} is neither cw nor ccw")
    return Direction(text.lower()).code


def _pairs(words: Iterable[str]) -> dict[str, str]:
    pairs = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not equals or not value:
            raise ValueError(f"{word!r} is not of the form name=value")
        pairs[name.replace("-", "_").lower()] = value
    return pairs


def read_speed(words: list[str]) -> float | None:
    """Return the speed if the next word is `speed=PPS`, else None."""
    if words and words[0].startswith("speed="):
        return number(words.pop(0)[6:], "speed", 1e-6, 1e6)
    return None


class Numbered(NamedTuple):
    """Name and range of the number that a line may end with."""

    name: str = "axis"
    low: int = 1
    high: int = MOST_AXES


AXES = Numbered()


def read_axis(words: list[str], numbered: Numbered = AXES) -> int | None:
    """Return the number in `axis=2` at the end of the line, else None."""
    if words and words[-1].startswith(f"{numbered.name}="):
        return whole(words.pop()[len(numbered.name) + 1 :], *numbered)
    return None


def read_repeat(words: list[str]) -> Values:
    """Return the number of repetitions."""
    turns = whole(first(words, "number of repetitions"), "count", 1, MOST_TURNS)
    check_no_more_words(words)
    return {"turns": turns}


_YES = {"yes": True, "on": True, "1": True, "no": False, "off": False, "0": False}


def _init(words: list[str]) -> Values:
    values: Values = {}
    for name, text in _pairs(words).items():
        if name in ("start", "high", "stop", "base_clock", "external_clock"):
            values[name] = number(text, name, 1e-6, 1e7)
        elif name in ("ramp", "down"):
            values[name] = whole(text, name, 0, 0xFFFFFF)
        elif name == "phases":
            values[name] = whole(text, name, 0, 65535)
        elif name in ("half_step", "chop", "long_intervals", "sigmoid"):
            if text.lower() not in _YES:
                raise ValueError(f"{name} {text!r} is neither yes nor no")
            values[name] = _YES[text.lower()]
        elif name == "logic":
            if text not in ("positive", "negative"):
                raise ValueError(f"logic {text!r} is neither positive nor negative")
            values[name] = Logic(text).value
        else:
            values[name] = text
    SetupValues().merged(values)
    return values


def _move(words: list[str]) -> Values:
    most = 1 << 24
    pulses = whole(first(words, "number of pulses"), "pulses", -most, most)
    second = whole(words.pop(0), "pulses", -most, most) if words and "=" not in words[0] else None
    values = {"pulses": pulses, "second": second, "speed": read_speed(words)}
    check_no_more_words(words)
    return values


def _move_to(words: list[str]) -> Values:
    ends = -(1 << 31), (1 << 31) - 1
    values = {"position": whole(first(words, "position"), "position", *ends), "second": None}
    if words:
        values["second"] = whole(words.pop(0), "position", *ends)
    check_no_more_words(words)
    return values


def _jog(words: list[str]) -> Values:
    side = _direction(words)
    ramped = bool(words) and words[0] == "ramped" and bool(words.pop(0))
    speed = None if ramped else read_speed(words)
    if first(words, "for SECONDS") != "for":
        raise ValueError("jog needs: jog cw|ccw [ramped | speed=PPS] for SECONDS")
    seconds = number(first(words, "seconds"), "seconds", 0, 86_400)
    check_no_more_words(words)
    return {"side": side, "ramped": ramped, "speed": speed, "seconds": seconds}


def _home(words: list[str]) -> Values:
    side = _direction(words) if words and words[0].lower() in ("cw", "ccw") else Direction.CCW.code
    approach = words.pop(0) if words and words[0] in ("fast", "to-limit") else ""
    values = {"side": side, "approach": approach, "speed": read_speed(words)}
    check_no_more_words(words)
    return values


def _wait(words: list[str]) -> Values:
    seconds = number(first(words, "seconds"), "seconds", 0, 86_400)
    check_no_more_words(words)
    return {"seconds": seconds}


def _step(words: list[str]) -> Values:
    values = {"side": _direction(words)}
    check_no_more_words(words)
    return values


def _plain(words: list[str]) -> Values:
    check_no_more_words(words)
    return {}


READERS: dict[str, Reader] = {
    "init": _init,
    "move": _move,
    "goto": _move_to,
    "step": _step,
    "jog": _jog,
    "home": _home,
    "wait": _wait,
    "stop": _plain,
    "zero": _plain,
    "off": _plain,
    "position": _plain,
}
"""Commands that all parts support."""
