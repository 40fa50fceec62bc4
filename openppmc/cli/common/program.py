"""Script files: one command a line. Reading only; `player` carries them out."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from ...host import PpmcError
from ..ppmc312 import words
from .options import Logic, SetupValues, Side

DEEPEST = 20
MOST_TURNS = 1_000_000


class ScriptError(PpmcError):
    """A line that cannot be understood or carried out; the message begins with file:line."""


@dataclass(frozen=True)
class Step:
    """One line. `body` belongs to repeat. axis: as written, None if it names none."""

    line: int
    word: str
    values: dict[str, Any]
    body: tuple[Step, ...] = ()
    axis: int | None = None


def read_program(text: str, name: str) -> tuple[Step, ...]:
    """All steps of a script file. Raises ScriptError for the first bad line."""
    stack: list[tuple[int, dict[str, Any], list[Step]]] = [(0, {}, [])]
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split("#", 1)[0].split()
        if not words:
            continue
        word, rest = words[0].lower(), words[1:]
        try:
            if word == "end":
                _none_left(rest)
                if len(stack) == 1:
                    raise ValueError("end without repeat")
                start, values, body = stack.pop()
                if not body:
                    raise ValueError("nothing to repeat")
                stack[-1][2].append(Step(start, "repeat", values, tuple(body)))
            elif word == "repeat":
                if len(stack) > DEEPEST:
                    raise ValueError(f"repeat deeper than {DEEPEST}")
                stack.append((number, _repeat(rest), []))
            elif word in _WORDS:
                axis = _axis(rest) if word in OF_AXES else None
                step = Step(number, word, _WORDS[word](rest), axis=axis)
                if axis is not None and step.values.get("second") is not None:
                    raise ValueError("two numbers are for both axes: leave axis= out")
                stack[-1][2].append(step)
            else:
                known = ", ".join(sorted([*_WORDS, "repeat", "end"]))
                raise ValueError(f"unknown command {words[0]!r} (there are {known})")
        except (ValueError, PpmcError) as error:
            raise ScriptError(f"{name}:{number}: {error}") from error
    if len(stack) > 1:
        raise ScriptError(f"{name}:{stack[-1][0]}: repeat without end")
    if not stack[0][2]:
        raise ScriptError(f"{name}:1: there is no command in this file")
    return tuple(stack[0][2])


def _none_left(words: list[str]) -> None:
    if words:
        raise ValueError(f"{words[0]!r} does not belong here")


def _number(text: str, what: str, low: float, high: float) -> float:
    try:
        value = float(text)
    except ValueError:
        raise ValueError(f"{what} {text!r} is not a number") from None
    if not low <= value <= high:
        raise ValueError(f"{what} {text} is outside {low:g} to {high:g}")
    return value


def _whole(text: str, what: str, low: int, high: int) -> int:
    try:
        value = int(text)
    except ValueError:
        raise ValueError(f"{what} {text!r} is not a whole number") from None
    if not low <= value <= high:
        raise ValueError(f"{what} {text} is outside {low} to {high}")
    return value


def _first(words: list[str], what: str) -> str:
    if not words:
        raise ValueError(f"{what} is missing")
    return words.pop(0)


def _side(words: list[str]) -> int:
    text = _first(words, "direction (cw or ccw)")
    if text.lower() not in ("cw", "ccw"):
        raise ValueError(f"{text!r} is neither cw nor ccw")
    return Side(text.lower()).code


def _pairs(words: Iterable[str]) -> dict[str, str]:
    pairs = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not equals or not value:
            raise ValueError(f"{word!r} is not of the form name=value")
        pairs[name.replace("-", "_").lower()] = value
    return pairs


def _speed(words: list[str]) -> float | None:
    """`speed=PPS`, if it comes next."""
    if words and words[0].startswith("speed="):
        return _number(words.pop(0)[6:], "speed", 1e-6, 1e6)
    return None


def _axis(words: list[str]) -> int | None:
    """`axis=1` or `axis=2` at the end of the line."""
    if words and words[-1].startswith("axis="):
        return _whole(words.pop()[5:], "axis", 1, 2)
    return None


def _repeat(words: list[str]) -> dict[str, Any]:
    turns = _whole(_first(words, "how often"), "count", 1, MOST_TURNS)
    _none_left(words)
    return {"turns": turns}


_YES = {"yes": True, "on": True, "1": True, "no": False, "off": False, "0": False}


def _init(words: list[str]) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for name, text in _pairs(words).items():
        if name in ("start", "high", "stop", "base_clock", "external_clock"):
            values[name] = _number(text, name, 1e-6, 1e7)
        elif name in ("ramp", "down"):
            values[name] = _whole(text, name, 0, 0xFFFFFF)
        elif name == "phases":
            values[name] = _whole(text, name, 0, 65535)
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


def _move(words: list[str]) -> dict[str, Any]:
    most = 1 << 24
    pulses = _whole(_first(words, "number of pulses"), "pulses", -most, most)
    second = _whole(words.pop(0), "pulses", -most, most) if words and "=" not in words[0] else None
    values = {"pulses": pulses, "second": second, "speed": _speed(words)}
    _none_left(words)
    return values


def _move_to(words: list[str]) -> dict[str, Any]:
    ends = -(1 << 31), (1 << 31) - 1
    values = {"position": _whole(_first(words, "position"), "position", *ends), "second": None}
    if words:
        values["second"] = _whole(words.pop(0), "position", *ends)
    _none_left(words)
    return values


def _jog(words: list[str]) -> dict[str, Any]:
    side = _side(words)
    ramped = bool(words) and words[0] == "ramped" and bool(words.pop(0))
    speed = None if ramped else _speed(words)
    if _first(words, "for SECONDS") != "for":
        raise ValueError("jog needs: jog cw|ccw [ramped | speed=PPS] for SECONDS")
    seconds = _number(_first(words, "seconds"), "seconds", 0, 86_400)
    _none_left(words)
    return {"side": side, "ramped": ramped, "speed": speed, "seconds": seconds}


def _home(words: list[str]) -> dict[str, Any]:
    side = _side(words) if words and words[0].lower() in ("cw", "ccw") else Side.CCW.code
    approach = words.pop(0) if words and words[0] in ("fast", "to-limit") else ""
    values = {"side": side, "approach": approach, "speed": _speed(words)}
    _none_left(words)
    return values


def _wait(words: list[str]) -> dict[str, Any]:
    seconds = _number(_first(words, "seconds"), "seconds", 0, 86_400)
    _none_left(words)
    return {"seconds": seconds}


def _aux(words: list[str]) -> dict[str, Any]:
    text = _first(words, "on or off")
    if text not in ("on", "off"):
        raise ValueError(f"{text!r} is neither on nor off")
    _none_left(words)
    return {"on": text == "on"}


def _auxo(words: list[str]) -> dict[str, Any]:
    value = _whole(_first(words, "value"), "outputs", 0, 63)
    _none_left(words)
    return {"value": value}


def _step(words: list[str]) -> dict[str, Any]:
    values = {"side": _side(words)}
    _none_left(words)
    return values


def _plain(words: list[str]) -> dict[str, Any]:
    _none_left(words)
    return {}


OF_AXES = ("init", "move", "goto", "step", "jog", "home", "stop", "zero", "off", "position")
"""Commands that may end with axis=N; without it they are about axis 1."""
OF_ALL_AXES = ("stop", "off", "position")
"""Those that are about all axes without it."""
_WORDS: dict[str, Callable[[list[str]], dict[str, Any]]] = {
    "init": _init,
    "move": _move,
    "goto": _move_to,
    "step": _step,
    "jog": _jog,
    "home": _home,
    "wait": _wait,
    "stop": _plain,
    "zero": _plain,
    "aux": _aux,
    "auxo": _auxo,
    "off": _plain,
    "position": _plain,
    "at": words.read_at,
    "event": words.read_event,
    "pulse": words.read_pulse,
    "watch": words.read_watch,
}
