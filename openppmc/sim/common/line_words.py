"""Texts of virtual lines, word by word: `word=value`, those of a station with its number behind the word."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field


@dataclass
class Words:
    """A text taken apart. shared: values for all stations; own: by number of a station; options: the rest."""

    shared: dict[str, str] = field(default_factory=dict)
    own: dict[int, dict[str, str]] = field(default_factory=dict)
    options: dict[str, str] = field(default_factory=dict)


def split_words(
    text: str, stations: Sequence[str], options: Sequence[str], number: Callable[[str, str], int]
) -> Words:
    """Take a text apart. stations: words that a station may have of its own; options: words of the line.
    number: the station's number from word and text. Raises ValueError with the offending word."""
    words = Words()
    numbered = re.compile(rf"({'|'.join(stations)})(\d+)$")
    for item in filter(None, (piece.strip() for piece in text.split(","))):
        word, equals, value = (piece.strip() for piece in item.partition("="))
        if not equals or not value:
            raise ValueError(f"{item!r} is not of the form word=value")
        if match := numbered.match(word):
            words.own.setdefault(number(item, match[2]), {})[match[1]] = value
        elif word in stations:
            words.shared[word] = value
        elif word in options:
            words.options[word] = value
        else:
            known = ", ".join((*(f"{name}[N]" for name in stations), *options))
            raise ValueError(f"unknown word {word!r} (there are {known})")
    return words


def one_of(word: str, value: str, known: Sequence[str]) -> str:
    """The value if it is known."""
    if value not in known:
        raise ValueError(f"{word}={value}: there are {', '.join(known)}")
    return value


def whole(word: str, text: str, low: int, high: int) -> int:
    """A whole number, not negative."""
    if not text.isdigit() or not low <= int(text) <= high:
        raise ValueError(f"{word}={text}: expected {low} to {high}")
    return int(text)


def positive(word: str, text: str) -> float:
    """A number above 0."""
    try:
        value = float(text)
    except ValueError:
        value = 0
    if not value > 0:
        raise ValueError(f"{word}={text}: expected a positive number")
    return value


def pace(text: str) -> float | None:
    """Times real time, None for `max`."""
    return None if text == "max" else positive("speed", text)
