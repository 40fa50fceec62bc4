"""Words of script files that not all parts know, and what parts bring along (column `words`)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any, Protocol

from ... import parts
from ...host.kind import AUX, Kind
from .reading import Reader, Values, first, none_left, whole


@dataclass(frozen=True)
class OwnWord:
    """A word that not all parts know. lacks: why this kind of part cannot do it with these values, empty if
    it can. do: carries it out, only for a part that lacks nothing."""

    read: Reader
    lacks: Callable[[Kind, Values], str]
    do: Callable[[Any, Values], None]


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
    none_left(words)
    return {"on": text == "on"}


def _read_outputs(words: list[str]) -> Values:
    value = whole(first(words, "value"), "outputs", 0, 63)
    none_left(words)
    return {"value": value}


def _lacks_aux(kind: Kind, values: Values) -> str:
    if AUX in kind.has:
        return ""
    return f"a {kind} has no output AUX" + (": use auxo" if kind.outputs else "")


def _lacks_outputs(kind: Kind, values: Values) -> str:
    if not kind.outputs:
        return f"a {kind} has no auxiliary outputs"
    if values["value"] > kind.outputs:
        return f"outputs {values['value']} is outside 0 to {kind.outputs}"
    return ""


def _do_aux(part: _HasAux, values: Values) -> None:
    part.aux(values["on"])


def _do_outputs(part: _HasOutputs, values: Values) -> None:
    part.auxo(values["value"])


_SOME = {
    "aux": OwnWord(_read_aux, _lacks_aux, _do_aux),
    "auxo": OwnWord(_read_outputs, _lacks_outputs, _do_outputs),
}


@cache
def own_words() -> dict[str, OwnWord]:
    """Words that not all parts know, with those that parts bring along (column `words`)."""
    own = dict(_SOME)
    for row in parts.folders():
        if row.words:
            more: dict[str, OwnWord] = row.load("words")
            assert not own.keys() & more.keys(), f"{row.name}: a word that another part has, too"
            own |= more
    return own
