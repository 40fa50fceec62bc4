"""Script modules that are played on the RTL: each of them exists, and each that exists is played."""

from __future__ import annotations

import importlib
import pkgutil

import pytest

from cocotb_tests.harness import scripts
from cocotb_tests.harness.config import F16
from cocotb_tests.harness.part import PARTS
from cocotb_tests.harness.script_player import module_tests

WITH_SCRIPTS = ("pmc006",)


@pytest.mark.parametrize("part", WITH_SCRIPTS)
def test_every_module_with_scripts_is_played(part: str) -> None:
    """Given the folder of a part, then its script modules are all in its list, but for mere helpers."""
    folder = importlib.import_module(f"cocotb_tests.{part}")
    named = [f"{folder.__name__}.{info.name}" for info in pkgutil.iter_modules(folder.__path__)]
    found = {
        name
        for name in named
        if name.rpartition(".")[2].startswith("script_") and scripts.functions(importlib.import_module(name))
    }
    listed = set(importlib.import_module(f"cocotb_tests.{part}.modules").MODULES)
    assert found and found <= listed


@pytest.mark.parametrize("part", WITH_SCRIPTS)
def test_every_listed_module_has_scripts(part: str) -> None:
    """Given the list of a part, then there is something to play in each module."""
    for name in importlib.import_module(f"cocotb_tests.{part}.modules").MODULES:
        assert any(scripts.cases(name)), name


def test_a_module_that_is_gone_is_an_error_of_the_collection() -> None:
    """Given a list that names a module which was moved, when its tests are made, then that fails."""
    with pytest.raises(ModuleNotFoundError, match="script_gone"):
        module_tests(PARTS["ppmc312"], {"cocotb_tests.ppmc312.script_gone": (F16,)}, __name__)
