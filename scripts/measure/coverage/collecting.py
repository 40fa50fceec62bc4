"""A pytest plugin (`-p … --collect-only`) that writes the groups of tests to OUT, as JSON.

A group contains the tests that `make test` runs in one simulator process, or one test with its own process.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from cocotb_tests.harness.runner import groups_of
from cocotb_tests.harness.schedule import group_key

OUT = "OPENPPMC_GROUPS"


def pytest_collection_finish(session: pytest.Session) -> None:
    """Write the names of the collected tests, one list for each group."""
    groups = [[test.nodeid for test in tests] for tests in groups_of(session.items, group_key)]
    Path(os.environ[OUT]).write_text(json.dumps(groups), encoding="utf-8")
