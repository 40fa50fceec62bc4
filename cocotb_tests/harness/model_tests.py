"""Runs directed tests on the golden model alone, without a simulator: `make test MODEL=1`, and `model_tests`.

    # tests/ppmc104/model/test_acceptance.py
    globals().update(model_tests(__name__, "cocotb_tests.ppmc104", "tb_acceptance_moves"))

The cocotb test `p104_ac_09_trapezoid` becomes the pytest `test_ac_09_trapezoid`, with the same rules and
builds. Thus RTL and model pass the same checks, exact to the cycle.
"""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from functools import cache
from typing import Any

import pytest

from .collect import Item, all_tests, configs_of, rules_of, verifies
from .config import Config
from .model_bench import OnModel, on_model


@cache
def _cases(module: str) -> dict[str, Any]:
    """Return name -> cocotb test of a module, with an entry for each case of a parametrized test."""
    tests = all_tests(importlib.import_module(module))
    return {case.name: case for test in tests for case in test.generate_tests()}


def run_on_model(item: Item, seed: int | None) -> None:
    """Run one directed test; if the test is for the RTL only, skip it with the reason."""
    case = _cases(item.module)[item.test]
    if item.skipped:
        pytest.skip(item.skipped)
    if why := getattr(case.func, "_openppmc_rtl_only", ""):
        pytest.skip(f"RTL only: {why}")
    dut = OnModel(item.config, item.seed if seed is None else seed)
    failed = None
    try:
        on_model(case.func(dut, *case.args, **case.kwargs))
    except BaseException as error:
        if not (case.expect_fail or isinstance(error, case.expect_error or ())):
            raise
        failed = error
    if failed is not None:
        pytest.xfail(str(failed))
    if case.expect_fail or case.expect_error:
        pytest.fail("passed, but a failure was expected", pytrace=False)


def model_tests(module: str, package: str, *names: str, builds: Sequence[Config] = ()) -> dict[str, Any]:
    """Return pytest functions, by name, that run the tests of `package`'s modules on the golden model.

    The caller adds them to the globals of `module`. Raises ValueError if two tests share a name.

    Args:
        builds: builds to use instead of those that the tests name.
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
