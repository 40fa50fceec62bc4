"""`make test MODEL=1` (pytest --model): directed tests on the golden model alone, without a simulator."""

from __future__ import annotations

import importlib
from functools import cache
from typing import Any

import pytest

from .collect import Item, all_tests
from .model_bench import OnModel, on_model


@cache
def _cases(module: str) -> dict[str, Any]:
    """Name -> cocotb test of a module, each case of a parametrized one."""
    tests = all_tests(importlib.import_module(module))
    return {case.name: case for test in tests for case in test.generate_tests()}


def run_on_model(item: Item, seed: int | None) -> None:
    """Run one directed test; skips it with the reason if it is for the RTL alone."""
    case = _cases(item.module)[item.test]
    if item.skipped:
        pytest.skip(item.skipped)
    if why := getattr(case.func, "_openppmc_rtl_only", ""):
        pytest.skip(f"RTL only: {why}")
    side = OnModel(item.config, item.seed if seed is None else seed)
    failed = None
    try:
        on_model(case.func(side, *case.args, **case.kwargs))
    except BaseException as error:
        if not (case.expect_fail or isinstance(error, case.expect_error or ())):
            raise
        failed = error
    if failed is not None:
        pytest.xfail(str(failed))
    if case.expect_fail or case.expect_error:
        pytest.fail("passed, but a failure was expected", pytrace=False)
