"""Scripts: test functions whose hosts are at work on a golden model; their tapes are played on the RTL.

A script module is a plain pytest module. Its functions build hosts and check answers, pulses and levels;
`cases` are all of them with their parameters, `build_of` the build that a tape belongs to. Hosts that name no
parameters may ask for those of the build that is simulated (`parameters`).
"""

from __future__ import annotations

import importlib
import inspect
import itertools
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from types import ModuleType
from typing import Any, NamedTuple, TypeVar

from .config import Config
from .part import PARTS, Part
from .tape import Tape
from .verifies import rules_of

F = TypeVar("F")

_builds: list[Config] = []


class Case(NamedTuple):
    """One call of a test function."""

    name: str
    call: Callable[[], None]


def functions(module: ModuleType) -> list[Any]:
    """The test functions of a script module, in order."""
    return [
        obj
        for name, obj in vars(module).items()
        if name.startswith("test_") and inspect.isfunction(obj) and obj.__module__ == module.__name__
    ]


def rules(module: str) -> tuple[str, ...]:
    """All rules that the scripts of a module check, which is named as in an import."""
    scripts = functions(importlib.import_module(module))
    return tuple(dict.fromkeys(rule for function in scripts for rule in rules_of(function)))


def model_only(why: str) -> Callable[[F], F]:
    """Mark a script that is not played on the RTL, for the reason given."""

    def mark(function: F) -> F:
        function._openppmc_model_only = why  # type: ignore[attr-defined]
        return function

    return mark


def cases(module: str, word: str = "") -> Iterator[Case]:
    """Every call that pytest would make of what is played of a module, those with `word` in their name."""
    for function in functions(importlib.import_module(module)):
        if hasattr(function, "_openppmc_model_only"):
            continue
        sets = [
            ([name.strip() for name in _names(mark.args[0])], mark.args[1])
            for mark in getattr(function, "pytestmark", [])
            if mark.name == "parametrize"
        ]
        for number, chosen in enumerate(itertools.product(*(values for _, values in sets))):
            arguments: dict[str, Any] = {}
            for (names, _), value in zip(sets, chosen, strict=True):
                row = getattr(value, "values", value) if not isinstance(value, dict) else value
                arguments |= zip(names, row if len(names) > 1 else (row,), strict=True)
            name = f"{module.rpartition('.')[2]}.{function.__name__}" + (f"[{number}]" if sets else "")
            if word in name:
                yield Case(name, lambda f=function, a=arguments: f(**a))  # type: ignore[misc]


def _names(names: str | tuple[str, ...]) -> list[str]:
    return names.split(",") if isinstance(names, str) else list(names)


@contextmanager
def building(config: Config) -> Iterator[None]:
    """Inside, `parameters` are those of this build."""
    _builds.append(config)
    try:
        yield
    finally:
        _builds.pop()


def simulating() -> bool:
    """Whether the tape will be played: scripts may then be shorter than on the model alone."""
    return bool(_builds)


def parameters(part: Part, given: Mapping[str, object]) -> dict[str, object]:
    """Parameters of a model, in lower case: those of the build that is simulated, then the given ones.

    Outside of a simulation those not given have the part's defaults.
    """
    own = {name.lower(): value for name, value in part.defaults.items()}
    if _builds:
        own |= {name.lower(): value for name, value in part.params(_builds[-1]).items()}
    return {**own, **given}


def build_of(part: Part, params: Mapping[str, object]) -> tuple[object, ...]:
    """Comparable parameters of a build; what is not named has its default."""
    return tuple({**part.defaults, **params}.get(name) for name in part.defaults)


def fits(tape: Tape, config: Config) -> bool:
    """Whether a tape was made for a build."""
    part = PARTS[tape.part]
    return build_of(part, tape.params) == build_of(part, config.params)
