"""`model_tests`: the cocotb tests of a module as pytest tests of the golden model alone.

# tests/ppmc104/model/test_acceptance.py
globals().update(model_tests(__name__, "cocotb_tests.ppmc104", "tb_acceptance_moves"))

`p104_ac_09_trapezoid` becomes `test_ac_09_trapezoid`, with the same rules, in each of its builds. So a check
stands once, and holds for both sides to the same clk.
"""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import Any

import pytest

from .collect import all_tests, configs_of
from .config import Config
from .model_bench import OnModel, on_model
from .verifies import rules_of, verifies


def model_tests(module: str, package: str, *names: str, builds: Sequence[Config] = ()) -> dict[str, Any]:
    """The tests of `package`'s modules on the golden model, by name, as globals of the module `module`.

    builds: instead of those that the tests name. Raises ValueError if two tests share a name.
    """
    made: dict[str, Any] = {}
    for name in names:
        for test in all_tests(importlib.import_module(f"{package}.{name}")):
            if hasattr(test.func, "_openppmc_rtl_only"):
                continue
            run = _test(test, builds or configs_of(test))
            run.__name__ = run.__qualname__ = "test_" + test.func.__name__.partition("_")[2]
            run.__doc__, run.__module__ = test.func.__doc__, module
            if run.__name__ in made:
                raise ValueError(f"{package}.{name}: second test called {run.__name__}")
            made[run.__name__] = run
    return made


def _test(test: Any, builds: Sequence[Config]) -> Any:
    cases = {
        "-".join([*case.name.split("/")[1:], *([build.name] if len(builds) > 1 else [])]): (
            build,
            case.kwargs,
        )
        for case in test.generate_tests()
        for build in builds
    }

    def run(build: Config, arguments: dict[str, Any]) -> None:
        on_model(test.func(OnModel(build), **arguments))

    def run_alone() -> None:
        run(*next(iter(cases.values())))

    if len(cases) > 1:
        mark = pytest.mark.parametrize(("build", "arguments"), cases.values(), ids=cases.keys())
        whole: Any = mark(run)
    else:
        whole = run_alone
    return verifies(*rules)(whole) if (rules := rules_of(test)) else whole
