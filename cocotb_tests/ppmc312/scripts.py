"""Scripts: test functions whose hosts are `Host312` or `Serial312`, run on the model and played on the RTL.

A script module is a plain pytest module. Its functions build hosts and check answers, pulses and levels;
`cases` are all of them with their parameters, `parameters_of` the build that a tape belongs to.
"""

from __future__ import annotations

import importlib
import importlib.util
import inspect
import itertools
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from cocotb_tests.common.config import Config
from cocotb_tests.common.paths import ROOT
from cocotb_tests.common.tape import Tape
from cocotb_tests.common.verifies import rules_of

DEFAULTS: dict[str, object] = {
    "CLK_HZ": 16_000_000,
    "XTAL_HZ": 16_000_000,
    "TIMING": "FAST",
    "VERSION": 0x12,
    "SUM_MODE": "BINARY",
}


class Case(NamedTuple):
    """One call of a test function."""

    name: str
    call: Callable[[], None]


def load(path: str) -> ModuleType:
    """The module in a file, named from the project's root; the model's own tests are in no package."""
    if path.startswith("cocotb_tests/"):
        return importlib.import_module(path.removesuffix(".py").replace("/", "."))
    name = Path(path).stem
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, ROOT / path)
        assert spec and spec.loader
        sys.modules[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[name])
    return sys.modules[name]


def functions(module: ModuleType) -> list[Any]:
    """The test functions of a script module, in order."""
    return [
        obj
        for name, obj in vars(module).items()
        if name.startswith("test_") and inspect.isfunction(obj) and obj.__module__ == module.__name__
    ]


def rules(path: str) -> tuple[str, ...]:
    """All rules that the scripts of a module check."""
    return tuple(dict.fromkeys(rule for function in functions(load(path)) for rule in rules_of(function)))


def cases(path: str, word: str = "") -> Iterator[Case]:
    """Every call that pytest would make, those with `word` in their name."""
    for function in functions(load(path)):
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
            name = f"{Path(path).stem}.{function.__name__}" + (f"[{number}]" if sets else "")
            if word in name:
                yield Case(name, lambda f=function, a=arguments: f(**a))  # type: ignore[misc]


def _names(names: str | tuple[str, ...]) -> list[str]:
    return names.split(",") if isinstance(names, str) else list(names)


def build_of(params: dict[str, object]) -> tuple[object, ...]:
    """Comparable parameters of a build; what is not named has its default."""
    return tuple({**DEFAULTS, **params}.get(name) for name in DEFAULTS)


def fits(tape: Tape, config: Config) -> bool:
    """Whether a tape was made for a build."""
    return build_of(tape.params) == build_of(config.params)
