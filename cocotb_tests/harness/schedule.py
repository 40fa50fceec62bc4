"""Decides which pytest items share a simulator process; makes xdist send such a group to one worker.

Tests with the same mark `xdist_group` also run in one worker, which builds their common data once. Groups are
formed from the tests that remain to run (`-k`, a node's id, --lf), in their order. Each worker determines the
groups from the tests that it collects. The controller collects no tests; it reads the groups from a file
whose path it passes to its workers.
"""

from __future__ import annotations

import json
import os
from collections.abc import Hashable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from .collect import Item
from .paths import BUILD
from .runner import SimOptions, groups_of

_SCOPES = "openppmc_scopes"


def params_of(test: pytest.Item) -> dict[str, Any]:
    """Return the parameters of a pytest item."""
    callspec = getattr(test, "callspec", None)
    return callspec.params if callspec else {}


def item_of(test: pytest.Item) -> Item | None:
    """Return the simulation of a pytest item; None if it is not a simulation."""
    item = params_of(test).get("item")
    return item if isinstance(item, Item) else None


def group_key(test: pytest.Item) -> Hashable:
    """Return a key that is equal for tests that may share a process: same test function, same build.

    None if the test may not share a process. A directed test is simulated in the design of its test function,
    so tests of several modules may share a process. For other tests the design may also depend on the module,
    so the key contains the module.
    """
    item = item_of(test)
    if item is None or not item.together or len(params_of(test)) > 1:
        return None
    module = item.module if item.shared else ""
    return (test.nodeid.partition("[")[0], module, item.part, item.config.name, item.seed, item.probes)


class Groups:
    """Groups of a session; used in a worker of xdist, or in a session without workers."""

    def __init__(self, options: SimOptions) -> None:
        self._options = options
        self._group: dict[str, tuple[Item, ...]] = {}

    def options(self, test: pytest.Item) -> SimOptions:
        """Return the options for `run_item` of a test."""
        return replace(self._options, group=self._group.get(test.nodeid, ()))

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Form the groups; with waves, each group is a single test."""
        key = (lambda test: None) if self._options.waves else group_key
        scopes = {}
        for tests in groups_of(session.items, key):
            items = tuple(item for test in tests if (item := item_of(test)))
            for test in tests:
                mark = test.get_closest_marker("xdist_group")
                scopes[test.nodeid] = mark.args[0] if mark else tests[0].nodeid
                if len(tests) > 1:
                    self._group[test.nodeid] = items
        path = getattr(session.config, "workerinput", {}).get(_SCOPES)
        if path:
            written = Path(f"{path}.{os.getpid()}")
            written.write_text(json.dumps(scopes), encoding="utf-8")
            written.replace(path)


class Sender:
    """Controller of xdist: sends each group as a whole to one worker, and all other tests one by one."""

    def __init__(self) -> None:
        self._file = BUILD / f"scopes-{os.getpid()}.json"

    def pytest_configure_node(self, node: Any) -> None:
        """Pass the path of the file for the groups to a worker."""
        self._file.parent.mkdir(parents=True, exist_ok=True)
        node.workerinput[_SCOPES] = str(self._file)

    def pytest_xdist_make_scheduler(self, config: pytest.Config, log: Any) -> Any:
        """Return a scheduler of xdist whose scopes are the groups; None if the user selects a scheduler."""
        from xdist.scheduler import LoadScopeScheduling

        if config.getoption("dist") != "load":
            return None
        file = self._file

        class Scheduler(LoadScopeScheduling):  # type: ignore[misc]
            _scopes: dict[str, str] | None = None

            def _split_scope(self, nodeid: str) -> str:
                if self._scopes is None:
                    self._scopes = json.loads(file.read_text(encoding="utf-8"))
                return self._scopes[nodeid]

        return Scheduler(config, log)

    def pytest_sessionfinish(self) -> None:
        """Remove the file with the groups."""
        self._file.unlink(missing_ok=True)
