"""Turns the cocotb tests of tb_* modules into pytest items: one item per test and build configuration.

    # test_part.py
    ITEMS = cocotb_items("cocotb_tests.ppmc104", "tb_bus", "tb_status", part=PPMC104)

    @pytest.mark.parametrize("item", ITEMS)
    def test_ppmc104(item, sim_options):
        run_item(item, sim_options)

`@verifies("P104-CMD-07", "AC-04")` names the rules that a test checks. It works on pytest functions and on
cocotb tests. The pytest plugin records the outcome of each marked test for the traceability pages. A test
with an ID that the manual does not list fails. `@probe("u_axis.rate")` names inner signals that a test reads.
"""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from types import ModuleType
from typing import Any, TypeVar

import pytest

from openppmc import parts

from .config import F16, Config
from .jitter import reason_against
from .part import Part
from .paths import ROOT

F = TypeVar("F")

PREFIXES = {prefix: row.name for row in parts.folders() for prefix in row.rules}
"""First word of a rule ID -> the device to which the rule belongs."""

# IDs with the first prefix of a device contain a subject (P104-CMD-07); IDs with another prefix contain only
# a number (J105-07).
_SUBJECTS = "|".join(row.rules[0] for row in parts.folders() if row.rules)
_NUMBERS = "|".join(prefix for row in parts.folders() for prefix in row.rules[1:]) or "(?!)"
RULE_ID = re.compile(
    rf"^(?:(?P<prefix>(?:{_SUBJECTS})(?=-[A-Z])|(?:{_NUMBERS})(?=-\d))(?:-[A-Z]+)?-\d\d"
    # IDs of rules about an instruction of the PPMC-312 contain its code; IDs of rules about free curves
    # contain a number.
    r"|(?P<code>P312)-CMD-(?:(?!FC)[0-9A-F]{2}|8L|8V|FC-\d{1,2})|AC-\d\d)$"
)
_ID = r"[A-Z0-9]+(?:-[A-Z]+)?-\d\d|P312-CMD-[0-9A-Z]{2}(?:-\d{1,2})?"
_ROW = re.compile(rf"^\|\s*(?:\*\*|`)?(?P<id>{_ID})(?:\*\*|`)?\s*\|\s*(?P<text>.*?)\s*\|\s*$")


def verifies(*ids: str) -> Callable[[F], F]:
    """Mark a test as a test of these rules.

    Raises ValueError at import time unless each ID has the form P104-ABC-NN (with the prefix of any device),
    J105-NN or AC-NN.
    """
    if not ids:
        raise ValueError("verifies() needs at least one rule ID")
    for rule in ids:
        if not RULE_ID.match(rule):
            raise ValueError(f"verifies(): {rule!r} is not a rule ID (P104-ABC-NN or AC-NN)")

    def mark(test: F) -> F:
        target: Any = getattr(test, "func", test)
        earlier: tuple[str, ...] = getattr(target, "_openppmc_rules", ())
        target._openppmc_rules = tuple(dict.fromkeys((*ids, *earlier)))
        return test

    return mark


def rules_of(test: Any) -> tuple[str, ...]:
    """Return the rule IDs that `verifies` put on a test function (or cocotb test object)."""
    return tuple(getattr(getattr(test, "func", test), "_openppmc_rules", ()))


def part_of_rule(rule: str) -> str | None:
    """Return the device to which a rule ID belongs, or None for AC-NN.

    Every device numbers its AC-NN rules separately.
    """
    match = RULE_ID.match(rule)
    prefix = match and (match["prefix"] or match["code"])
    return PREFIXES[prefix] if prefix else None


@cache
def manual_rules(part: str) -> dict[str, str]:
    """Return rule ID -> short text, from the tables of docs/<part>/README.md; empty if there is no manual.

    A rule is a table row of two cells whose first cell is an ID. Raises ValueError if an ID occurs twice.
    """
    manual = ROOT / "docs" / part / "README.md"
    rules: dict[str, str] = {}
    if not manual.is_file():
        return rules
    for line in manual.read_text(encoding="utf-8").splitlines():
        match = _ROW.match(line)
        if match and RULE_ID.match(match["id"]):
            if match["id"] in rules:
                raise ValueError(f"docs/{part}/README.md lists {match['id']} twice")
            rules[match["id"]] = match["text"]
    return rules


def unknown_rules(ids: tuple[str, ...], part: str) -> list[str]:
    """Return the IDs that the manual of their device does not list.

    Without a manual, every ID counts as listed.
    """
    bad = []
    for rule in ids:
        known = manual_rules(part_of_rule(rule) or part)
        if known and rule not in known:
            bad.append(rule)
    return bad


def exact(reason: str) -> Callable[[F], F]:
    """Mark a cocotb test that does not run with JITTER=1, although other tests of its module do.

    Args:
        reason: reason for it, in a few words.
    """

    def mark(test: F) -> F:
        target: Any = getattr(test, "func", test)
        target._openppmc_exact = reason
        return test

    return mark


def probe(*paths: str) -> Callable[[F], F]:
    """Mark a cocotb test as a reader of these inner signals, which are paths below `dut`.

    The decorator may be placed above or below others. Raises ValueError if no path is listed or a path is
    invalid.
    """
    if not paths or not all(re.fullmatch(r"\w+(\[\d+\])?(\.\w+(\[\d+\])?)*", path) for path in paths):
        raise ValueError(f"probe(): expected paths such as 'u_axis.rate', got {paths}")

    def mark(test: F) -> F:
        target: Any = getattr(test, "func", test)
        target._openppmc_probes = (*paths, *getattr(target, "_openppmc_probes", ()))
        return test

    return mark


def probes_of(test: Any) -> tuple[str, ...]:
    """Return the inner signals that a test function (or cocotb test object) names."""
    return tuple(getattr(getattr(test, "func", test), "_openppmc_probes", ()))


@dataclass(frozen=True)
class Item:
    """One simulation to run: a cocotb test of a module under one configuration.

    `target` is the make target of the command that repeats the simulation.

    Attributes:
        probes: inner signals that the test reads.
        skipped: reason why the test does not run.
        uncompared: reason why a directed test is not compared with the golden model ("" if it is compared);
            None for other tests.
        exact: reason why the test does not run with JITTER=1.
        tolerant: True if its checks allow the extra cycle of JITTER=1, so that it needs no golden model.
        shared: True if it may share a process with other tests of its module, although it is not a directed
            test.
    """

    module: str
    test: str
    config: Config
    part: str
    rules: tuple[str, ...]
    seed: int = 1
    tag: str = ""
    target: str = "test"
    probes: tuple[str, ...] = ()
    skipped: str = ""
    uncompared: str | None = None
    exact: str = ""
    tolerant: bool = False
    shared: bool = False

    @property
    def together(self) -> bool:
        """Whether the test may share a process with other tests of its build, as directed tests may."""
        return self.shared or self.uncompared is not None

    @property
    def full_name(self) -> str:
        """Name of the test in cocotb."""
        return f"{self.module}.{self.test}"

    @property
    def id(self) -> str:
        """ID in the pytest parametrization, which is also the word for `make test T=` (pytest -k)."""
        tag = f"-{self.tag}" if self.tag else ""
        return f"{self.test}-{self.config.name}{tag}".replace("/", ".").replace("=", ".")

    def with_seed(self, seed: int) -> Item:
        """Return the same simulation with another seed."""
        return replace(self, seed=seed)


def cocotb_items(
    package: str, *modules: str, part: Part, shared: bool = False, tolerant: bool = False, exact: str = ""
) -> list[Any]:
    """Return a pytest.param for each test of `package`'s modules and each configuration that the test names.

    Raises ValueError if a module has no cocotb test, two tests share a name, or a test neither runs with
    JITTER=1 nor states why it does not.

    Args:
        shared: True if the tests of a module run in one process for each build. Each test must then begin
            with a reset.
        tolerant: see `Item`.
        exact: see `Item`; the decorator `exact` sets it for single tests.
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
                        probes=probes_of(test),
                        skipped="skip=True of cocotb.test()" if case.skip else "",
                        uncompared=getattr(test.func, "_openppmc_uncompared", None),
                        exact=exact or getattr(test.func, "_openppmc_exact", ""),
                        tolerant=tolerant,
                        shared=shared,
                    )
                    reason_against(item)  # raises ValueError for a test without a statement about JITTER=1
                    if item.id in seen:
                        raise ValueError(f"{package}.{name}: second test called {item.id}")
                    seen.add(item.id)
                    params.append(pytest.param(item, id=item.id))
    return params


def all_tests(module: ModuleType) -> list[Any]:
    """Return the cocotb tests that a module defines, in order; raise ValueError if it has no test."""
    found = [
        obj
        for obj in vars(module).values()
        if hasattr(obj, "generate_tests") and hasattr(obj, "func") and obj.func.__module__ == module.__name__
    ]
    if not found:
        raise ValueError(f"{module.__name__} holds no cocotb test")
    return found


def configs_of(test: Any) -> tuple[Config, ...]:
    """Return the build configurations that a cocotb test names, or the default one."""
    builds: tuple[Config, ...] = getattr(test.func, "_openppmc_configs", (F16,))
    return builds
