"""Turns the cocotb tests of tb_* modules into pytest items: one item a test and build configuration.

# test_part.py
ITEMS = cocotb_items("cocotb_tests.ppmc104", "tb_bus", "tb_status", part=PPMC104)

@pytest.mark.parametrize("item", ITEMS)
def test_ppmc104(item, sim_options):
    run_item(item, sim_options)
"""

from __future__ import annotations

import importlib
from dataclasses import dataclass, replace
from types import ModuleType
from typing import Any

import pytest

from .config import F16, Config
from .inside import inside_of
from .part import Part
from .verifies import rules_of


@dataclass(frozen=True)
class Item:
    """One simulation to run: a cocotb test of a module under one configuration.

    `target` is the make target that runs it, for the line that repeats it. `inside`: inner signals that it
    reads. `skipped`: why it does not run.
    `uncompared`: why a directed test is not compared with the golden model ("" if it is), None for others.
    `shared`: it may share a process with others of its module, though it is no directed test.
    """

    module: str
    test: str
    config: Config
    part: str
    rules: tuple[str, ...]
    seed: int = 1
    tag: str = ""
    target: str = "test"
    inside: tuple[str, ...] = ()
    skipped: str = ""
    uncompared: str | None = None
    shared: bool = False

    @property
    def together(self) -> bool:
        """Whether it may share a process with others of its build: directed tests begin with a reset."""
        return self.shared or self.uncompared is not None

    @property
    def full_name(self) -> str:
        """cocotb's name of the test."""
        return f"{self.module}.{self.test}"

    @property
    def id(self) -> str:
        """ID within the pytest parametrization; also what `make test T=` (pytest -k) takes."""
        tag = f"-{self.tag}" if self.tag else ""
        return f"{self.test}-{self.config.name}{tag}".replace("/", ".").replace("=", ".")

    def with_seed(self, seed: int) -> Item:
        """The same simulation under another seed."""
        return replace(self, seed=seed)


def cocotb_items(package: str, *modules: str, part: Part, shared: bool = False) -> list[Any]:
    """pytest.param list of every cocotb test in `package`'s modules, under the configs each one names.

    shared: tests of a module run in one process for each build. Each must begin with a reset.
    Raises ValueError if a module has no cocotb test or two tests share a name.
    """
    params, seen = [], set()
    for name in modules:
        module = importlib.import_module(f"{package}.{name}")
        for test in all_tests(module):
            for case in test.generate_tests():
                for config in configs_of(test):
                    item = Item(
                        module.__name__,
                        case.name,
                        config,
                        part.name,
                        rules_of(test),
                        inside=inside_of(test),
                        skipped="skip=True of cocotb.test()" if case.skip else "",
                        uncompared=getattr(test.func, "_openppmc_uncompared", None),
                        shared=shared,
                    )
                    if item.id in seen:
                        raise ValueError(f"{package}.{name}: second test called {item.id}")
                    seen.add(item.id)
                    params.append(pytest.param(item, id=item.id))
    return params


def all_tests(module: ModuleType) -> list[Any]:
    """The cocotb tests that a module defines, in order; ValueError if it has none."""
    found = [
        obj
        for obj in vars(module).values()
        if hasattr(obj, "generate_tests") and hasattr(obj, "func") and obj.func.__module__ == module.__name__
    ]
    if not found:
        raise ValueError(f"{module.__name__} holds no cocotb test")
    return found


def configs_of(test: Any) -> tuple[Config, ...]:
    """The build configurations that a cocotb test names, or the default one."""
    wanted: tuple[Config, ...] = getattr(test.func, "_openppmc_configs", (F16,))
    return wanted
