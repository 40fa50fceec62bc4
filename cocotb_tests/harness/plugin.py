"""pytest side of the harness: --seed, --clk-hz, rule IDs of every test, build/trace/results.jsonl.

Loaded by the conftest.py at the project root, so it also sees the plain Python tests below tests/.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from . import native
from .build import locked
from .paths import TRACE
from .runner import SimOptions
from .verifies import PREFIXES, part_of_rule, rules_of, unknown_rules

RESULTS = TRACE / "results.jsonl"


def pytest_addoption(parser: pytest.Parser) -> None:
    """--seed N repeats random stimuli, --clk-hz HZ keeps only simulations at that core clock."""
    group = parser.getgroup("openppmc")
    group.addoption("--seed", type=int, default=None, help="seed of all simulations and random tests")
    group.addoption("--clk-hz", type=int, default=None, help="run only simulations with this CLK_HZ")


@pytest.fixture(scope="session")
def sim_options(pytestconfig: pytest.Config) -> SimOptions:
    """Options for `run_item`."""
    return SimOptions(seed=pytestconfig.getoption("--seed"))


def _params_of(test: pytest.Item) -> dict[str, Any]:
    callspec = getattr(test, "callspec", None)
    return callspec.params if callspec else {}


def _item_of(test: pytest.Item) -> Any:
    return _params_of(test).get("item")


def _rules_and_part(test: pytest.Item) -> tuple[tuple[str, ...], str]:
    sim = _item_of(test)
    rules = tuple(dict.fromkeys((*rules_of(getattr(test, "function", None)), *getattr(sim, "rules", ()))))
    part = getattr(sim, "part", None)
    part = part or next((found for rule in rules if (found := part_of_rule(rule))), None)
    part = part or next((name for name in PREFIXES.values() if name in test.nodeid), "")
    return rules, part


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Apply --clk-hz: plain Python tests and simulations at other clocks are left out."""
    clk_hz = config.getoption("--clk-hz")
    if clk_hz is None:
        return
    keep = [
        test for test in items if getattr(getattr(_item_of(test), "config", None), "clk_hz", None) == clk_hz
    ]
    config.hook.pytest_deselected(items=[test for test in items if test not in keep])
    items[:] = keep


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Note the rules of the test for the report; a rule the manual does not list fails it."""
    rules, part = _rules_and_part(item)
    sim = _item_of(item)
    item.user_properties.append(("rules", list(rules)))
    item.user_properties.append(("part", part))
    item.user_properties.append(("config", sim.config.name if sim else ""))
    item.user_properties.append(("runs", len(_params_of(item).get("seeds", "1").split())))
    item.user_properties.append(("name", sim.test if sim else getattr(item, "originalname", item.name)))
    if bad := unknown_rules(rules, part):
        pytest.fail(f"@verifies names rules that docs/ does not list: {', '.join(bad)}", pytrace=False)


class _Recorder:
    """Collects outcomes in the controlling process only (xdist forwards every report to it)."""

    def __init__(self, config: pytest.Config) -> None:
        self.records: dict[str, dict[str, Any]] = {}
        self.whole_files = not (
            config.option.keyword or config.option.markexpr or config.getoption("--clk-hz")
        )
        self.whole_files &= not any("::" in arg for arg in config.args)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep the worst phase of each test that names rules."""
        known = dict(report.user_properties)
        if not known.get("rules"):
            return
        record = self.records.setdefault(
            report.nodeid,
            {
                "test": report.nodeid,
                "name": known["name"],
                "part": known["part"],
                "config": known["config"],
                "runs": known["runs"],
                "rules": known["rules"],
                "outcome": "passed",
            },
        )
        if report.outcome != "passed":
            record["outcome"] = report.outcome
        elif report.when == "call":
            record["ran"] = True

    def pytest_sessionfinish(self, session: pytest.Session, exitstatus: int) -> None:
        """Merge into build/trace/results.jsonl; files that ran as a whole replace their old records."""
        for record in self.records.values():
            if not record.pop("ran", False) and record["outcome"] == "passed":
                record["outcome"] = "failed"
        if not self.records:
            return
        ended_itself = exitstatus in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED)
        complete = self.whole_files and ended_itself and not session.shouldstop and not session.shouldfail
        ran_files = {record["test"].split("::")[0] for record in self.records.values()} if complete else set()
        with locked(TRACE / "lock"):
            merged = {}
            if RESULTS.is_file():
                for line in RESULTS.read_text(encoding="utf-8").splitlines():
                    old = json.loads(line)
                    path = old["test"].split("::")[0]
                    if path not in ran_files and (Path(session.config.rootpath) / path).is_file():
                        merged[old["test"]] = old
            merged.update(self.records)
            text = "".join(json.dumps(merged[test], sort_keys=True) + "\n" for test in sorted(merged))
            RESULTS.write_text(text, encoding="utf-8")


def pytest_configure(config: pytest.Config) -> None:
    """Only the controller records; xdist workers have `workerinput`."""
    native.collect_seldom()
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(_Recorder(config), "openppmc-trace")
