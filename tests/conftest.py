"""Hypothesis profiles: fixed examples by default, new examples with OPENPPMC_EXPLORE=1.

If a new example fails, the line that repeats it is printed; `--hypothesis-seed=N` repeats a whole run.
"""

from __future__ import annotations

import os

import pytest
from hypothesis import HealthCheck, settings

from .common.board.fixtures import board, openppmc, start_board, until  # noqa: F401
from .common.cli.fixtures import run  # noqa: F401

_COMMON = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow, HealthCheck.data_too_large]}
settings.register_profile("fixed", derandomize=True, database=None, max_examples=150, **_COMMON)
settings.register_profile("explore", print_blob=True, max_examples=1000, **_COMMON)
settings.load_profile("explore" if os.environ.get("OPENPPMC_EXPLORE") else "fixed")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Let `T=quick` select every test that is not marked slow."""
    for item in items:
        if item.get_closest_marker("slow") is None:
            item.extra_keyword_matches.add("quick")
