"""pytest plugin of the harness: options, rule IDs of each test, build/trace/results.jsonl.

The conftest.py in the project root loads it, so it also handles the plain Python tests in tests/.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from .build import locked
from .collect import PREFIXES, Item, part_of_rule, rules_of, unknown_rules
from .jitter import JITTER, reason_against
from .model_tests import run_on_model
from .paths import TRACE
from .runner import SimOptions, Summary, notes
from .schedule import Groups, Sender, item_of, params_of
from .sim_backend import collect_seldom
from .variants import mutant_present

RESULTS = TRACE / "results.jsonl"
_EXACT = pytest.StashKey[Counter[str]]()
_GROUPS = pytest.StashKey[Groups]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options of `make test`: SEED, CLK_HZ, WAVES, PROBE, MODEL and JITTER."""
    group = parser.getgroup("openppmc")
    group.addoption("--seed", type=int, default=None, help="seed of all simulations and random tests")
    group.addoption("--clk-hz", type=int, default=None, help="run only simulations with this CLK_HZ")
    group.addoption("--waves", action="store_true", help="keep the waveforms of each simulation")
    group.addoption("--probe", "--inside", action="store_true", help="show inner signals in every simulation")
    group.addoption("--model", action="store_true", help="run directed tests on the golden model alone")
    group.addoption("--jitter", action="store_true", help="sample each pin change one cycle late at random")


@pytest.fixture
def sim_options(request: pytest.FixtureRequest) -> SimOptions:
    """Return the options for `run_item`."""
    groups: Groups = request.config.stash[_GROUPS]
    return groups.options(request.node)


def _rules_and_part(test: pytest.Item) -> tuple[tuple[str, ...], str]:
    sim = item_of(test)
    rules = tuple(dict.fromkeys((*rules_of(getattr(test, "function", None)), *getattr(sim, "rules", ()))))
    part = getattr(sim, "part", None)
    part = part or next((found for rule in rules if (found := part_of_rule(rule))), None)
    part = part or next((name for name in PREFIXES.values() if name in test.nodeid), "")
    return rules, part


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Deselect tests that the options --clk-hz, --model and --jitter exclude.

    --clk-hz deselects plain Python tests and tests with other clocks; --model deselects all tests except
    directed ones; --jitter deselects plain Python tests and simulated tests that state a reason against it.
    """
    clk_hz, model = config.getoption("--clk-hz"), config.getoption("--model")
    keep = [test for test in items if _is_selected(item_of(test), clk_hz, model)]
    if config.getoption("--jitter"):
        reasons = {test: reason_against(item) for test in keep if (item := item_of(test))}
        config.stash[_EXACT] = Counter(reason for reason in reasons.values() if reason)
        keep = [test for test, reason in reasons.items() if not reason]
    if len(keep) < len(items):
        config.hook.pytest_deselected(items=[test for test in items if test not in set(keep)])
        items[:] = keep


def pytest_report_collectionfinish(config: pytest.Config) -> list[str]:
    """Return the reasons why simulated tests do not run with --jitter, each with its number of tests."""
    reasons = config.stash.get(_EXACT, Counter[str]())
    rows = [f"{count:>5} {reason}" for reason, count in reasons.most_common()]
    return [f"{reasons.total()} simulated tests do not run with JITTER=1:", *rows] if rows else []


def _is_selected(item: Item | None, clk_hz: int | None, model: bool) -> bool:
    """Return whether a test has the selected clock and, with --model, runs on the golden model."""
    if item is None:
        return clk_hz is None and not model
    return clk_hz in (None, item.config.clk_hz) and not (model and item.uncompared is None)


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run a directed test on the golden model in place of its simulation (--model)."""
    item = item_of(pyfuncitem)
    if item is None or not pyfuncitem.config.getoption("--model"):
        return None
    run_on_model(item, pyfuncitem.config.getoption("--seed"))
    return True


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Record the rules of the test for the report; fail the test if the manual does not list one of them."""
    rules, part = _rules_and_part(item)
    sim = item_of(item)
    item.user_properties.append(("rules", list(rules)))
    item.user_properties.append(("part", part))
    item.user_properties.append(("config", sim.config.name if sim else ""))
    item.user_properties.append(("runs", len(params_of(item).get("seeds", "1").split())))
    item.user_properties.extend(notes(sim))
    item.user_properties.append(("name", sim.test if sim else getattr(item, "originalname", item.name)))
    if bad := unknown_rules(rules, part):
        pytest.fail(f"@verifies names rules that docs/ does not list: {', '.join(bad)}", pytrace=False)


class _Recorder:
    """Collects outcomes, only in the controlling process, to which xdist forwards every report."""

    def __init__(self, config: pytest.Config) -> None:
        self.records: dict[str, dict[str, Any]] = {}
        self.whole_files = not (
            config.option.keyword or config.option.markexpr or config.getoption("--clk-hz")
        )
        self.whole_files &= not any("::" in arg for arg in config.args)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Record the outcome of each test that names rules: passed only if all its phases passed."""
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
        """Merge the outcomes into build/trace/results.jsonl.

        The old records of files that ran completely are removed.
        """
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
    """Register the grouping of tests in each collecting process, and the recorder in the controller only.

    A worker of xdist has the attribute `workerinput`; the controller does not.
    """
    collect_seldom()
    if config.getoption("--jitter"):
        os.environ[JITTER] = "1"
    options = SimOptions(
        seed=config.getoption("--seed"),
        waves=config.getoption("--waves"),
        probe=config.getoption("--probe"),
    )
    config.stash[_GROUPS] = Groups(options)
    config.pluginmanager.register(config.stash[_GROUPS], "openppmc-groups")
    if not hasattr(config, "workerinput"):
        if not config.getoption("--model") and not config.getoption("--jitter") and not mutant_present():
            config.pluginmanager.register(_Recorder(config), "openppmc-trace")
            config.pluginmanager.register(Summary(), "openppmc-summary")
        if config.pluginmanager.hasplugin("xdist"):
            config.pluginmanager.register(Sender(), "openppmc-sender")
